//! A judgement, for people.

use std::fmt::Write as _;

use funicular::judge::Ruling;

use crate::printable::Printable;
use crate::tables::{table, wrapped};

/// Violations up to this many are printed.
const PRINTED: usize = 40;
/// Indent of what a paragraph needs beyond its first line.
const INDENT: usize = 2;

/// The whole judgement.
pub fn text(one: &Ruling) -> String {
    let (system, judgement) = (one.judged.system(), one.judged.judgement());
    let bounds = judgement.bounds;
    let mut text = format!(
        "{}: the answer of {}\n{} joints, {} members; tolerance {:.0e}: {:.1e} m, {:.1e} N\n\n",
        Printable(system.name()),
        Printable(judgement.source.as_str()),
        system.joints().len(),
        system.members().len(),
        bounds.tolerance,
        bounds.position_m,
        bounds.force_n,
    );
    text += &paragraph(&format!("Verdict: {}.", Printable(&one.finding())));
    if let Some(sentence) = judgement.tolerance_sentence(system) {
        text += &paragraph(&sentence);
    }
    text += &paragraph(&judgement.forces_sentence());
    text.push('\n');
    text += &broken(one);
    for sentence in judgement.error_sentences(system) {
        text += &paragraph(&Printable(&sentence).to_string());
    }
    text += "\nEvidence for the answer:\n";
    for statement in judgement.ladder.statements() {
        let mark = if statement.reached { "+" } else { "-" };
        let line = format!("  {mark} {:<10} {}", statement.rung.to_string(), statement.how);
        text += &wrapped(&Printable(&line).to_string(), 15);
        text.push('\n');
    }
    for note in &one.notes {
        text += &paragraph(&format!("Note: {}.", Printable(note)));
    }
    text
}

fn paragraph(text: &str) -> String {
    wrapped(text, INDENT) + "\n"
}

/// What is broken, a line each.
fn broken(one: &Ruling) -> String {
    let (system, violations) = (one.judged.system(), &one.judged.judgement().violations);
    if violations.is_empty() {
        return String::new();
    }
    let mut table = table(["where", "law", "what", "by"]);
    for violation in violations.iter().take(PRINTED) {
        table.add_row([
            Printable(&violation.place_in(system)).to_string(),
            violation.law.word().to_owned(),
            violation.what(),
            format!("{:.3e} {}", violation.value, violation.law.unit()),
        ]);
    }
    let mut text = format!("{table}\n");
    if violations.len() > PRINTED {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "and {} more: --json has them all", violations.len() - PRINTED);
    }
    text + "\n"
}
