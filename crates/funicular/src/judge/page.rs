//! A judgement as a page that needs nothing else.

use std::fmt::Write as _;

use figures::Escaped;

use super::Judged;
use crate::picture::{self, Seen};
use crate::text;

/// Violations up to this many are listed; of more those that come first.
const LISTED: usize = 200;

const STYLE: &str = "\
:root { color-scheme: light dark; --good: #00664a; --bad: #a33d00; --open: #555; }
@media (prefers-color-scheme: dark) { :root { --good: #4fd1a5; --bad: #ff9d5c; --open: #aaa; } }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
.finding { font-size: 1.25rem; border-left: .4rem solid; padding: .5rem 1rem; }
.confirmed { border-color: var(--good); } .refuted { border-color: var(--bad); }
.undecided { border-color: var(--open); }
table { border-collapse: collapse; width: 100%; } caption { text-align: left; padding: .5rem 0; }
th, td { text-align: left; padding: .25rem .75rem .25rem 0; border-bottom: 1px solid #8886; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
figure { margin: 1rem 0; overflow-x: auto; background: #fff; } figure svg { max-width: 100%; height: auto; }
";

/// The page.
pub(super) fn html(judged: &Judged, notes: &[String], seen: Seen) -> String {
    let (system, judgement) = (judged.system(), judged.judgement());
    let finding = &judgement.finding;
    let title = format!("{}: {}", system.name(), finding.word());
    let mut body = format!(
        "<h1>{}</h1>\n<p class=\"finding {}\" role=\"status\"><strong>{}</strong></p>\n\
         <p>Judged: {} joints and {} members by {}, tolerance {:.0e} ({:.1e} m, {:.1e} N). {}</p>\n",
        Escaped(system.name()),
        finding.word(),
        Escaped(&finding.to_string()),
        system.joints().len(),
        system.members().len(),
        Escaped(judgement.source.as_str()),
        judgement.bounds.tolerance,
        judgement.bounds.position_m,
        judgement.bounds.force_n,
        Escaped(&judgement.forces_sentence()),
    );
    if let Some(sentence) = judgement.tolerance_sentence(system) {
        // Writing to a String cannot fail.
        let _ = writeln!(body, "<p>{}</p>", Escaped(&sentence));
    }
    if let Some(weakest) = judged.weakest() {
        // Writing to a String cannot fail.
        let _ = writeln!(body, "<p>{}</p>", Escaped(&text::weakest(system, &weakest)));
    }
    body += &broken(judged);
    body += "<h2>How large the error is</h2>\n";
    body += &list(&judgement.error_sentences(system));
    body += &rungs(judged);
    body += &drawing(judged, seen);
    if !notes.is_empty() {
        body += "<h2>How the system was read</h2>\n";
        body += &list(notes);
    }
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
         <link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{body}</main>\n\
         </body>\n</html>\n",
        Escaped(&title)
    )
}

fn list(items: &[String]) -> String {
    let mut text = String::new();
    for item in items {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "<li>{}</li>", Escaped(item));
    }
    format!("<ul>\n{text}</ul>\n")
}

/// What is broken, a row each.
fn broken(judged: &Judged) -> String {
    let (system, violations) = (judged.system(), &judged.judgement().violations);
    if violations.is_empty() {
        return "<h2>What is broken</h2>\n<p>Nothing beyond the tolerance.</p>\n".to_owned();
    }
    let mut rows = String::new();
    for violation in violations.iter().take(LISTED) {
        let unit = violation.law.unit();
        // Writing to a String cannot fail.
        let _ = writeln!(
            rows,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td class=\"number\">{:.3e} {unit}</td>\
             <td class=\"number\">{:.1e} {unit}</td></tr>",
            Escaped(&violation.place_in(system)),
            violation.law.word(),
            Escaped(&violation.what()),
            violation.value,
            violation.allowed,
        );
    }
    let more = match violations.len().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!("<p>And {more} more.</p>\n"),
    };
    format!(
        "<h2>What is broken</h2>\n<table>\n<caption>Laws broken by more than the tolerance explains.</caption>\n\
         <thead><tr><th scope=\"col\">where</th><th scope=\"col\">law</th><th scope=\"col\">what</th>\
         <th scope=\"col\">by</th><th scope=\"col\">tolerance explains</th></tr></thead>\n<tbody>\n{rows}</tbody>\n\
         </table>\n{more}"
    )
}

/// The rungs of the answer.
fn rungs(judged: &Judged) -> String {
    let statements = judged.judgement().ladder.statements();
    let mut rows = String::new();
    for statement in &statements {
        let reached = if statement.reached { "reached" } else { "not reached" };
        // Writing to a String cannot fail.
        let _ = writeln!(
            rows,
            "<tr><th scope=\"row\">{}</th><td>{reached}</td><td>{}</td></tr>",
            statement.rung,
            Escaped(&statement.how)
        );
    }
    format!(
        "<h2>How far the answer is proved</h2>\n<table>\n<thead><tr><th scope=\"col\">rung</th><th scope=\"col\"></th>\
         <th scope=\"col\">how, or why not</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n"
    )
}

/// The answer to scale. What cannot be drawn is said.
fn drawing(judged: &Judged, seen: Seen) -> String {
    let drawn = picture::of_system(judged.system(), &judged.judgement().answer, seen);
    let figure = match drawn {
        Ok(svg) => {
            let svg = svg.find("<svg").map_or(svg.as_str(), |at| &svg[at..]);
            format!(
                "<figure>{svg}<figcaption>The answer as given, to scale.</figcaption></figure>\n"
            )
        }
        Err(error) => format!("<p>No picture: {}.</p>\n", Escaped(&error.to_string())),
    };
    format!("<h2>The answer</h2>\n{figure}")
}
