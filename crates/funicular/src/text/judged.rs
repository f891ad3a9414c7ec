//! A judgement, for people.

use std::fmt::{self, Write as _};

use super::answer::{line, mark};
use super::printable::Printable;
use super::tables::{table, wrapped};
use crate::judge::{Judged, Ruling};

/// Violations up to this many are printed.
const PRINTED: usize = 40;
/// Indent of what a paragraph needs beyond its first line.
const INDENT: usize = 2;

/// As `funicular judge` prints it.
impl fmt::Display for Ruling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(&self.judged, &self.finding(), &self.notes))
    }
}

/// As `funicular judge` prints it, for a system of our own.
impl fmt::Display for Judged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(self, &self.judgement().finding.to_string(), &[]))
    }
}

/// The whole judgement.
fn text(judged: &Judged, finding: &str, notes: &[String]) -> String {
    let (system, judgement) = (judged.system(), judged.judgement());
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
    text += &paragraph(&format!("Verdict: {}.", Printable(finding)));
    if let Some(sentence) = judgement.tolerance_sentence(system) {
        text += &paragraph(&sentence);
    }
    text += &paragraph(&judgement.forces_sentence());
    if let Some(weakest) = judged.weakest() {
        text += &paragraph(&Printable(&super::weakest(system, &weakest)).to_string());
    }
    text.push('\n');
    text += &broken(judged);
    for sentence in judgement.error_sentences(system) {
        text += &paragraph(&Printable(&sentence).to_string());
    }
    text += "\nEvidence for the answer:\n";
    for statement in judgement.ladder.statements() {
        let how = Printable(&statement.how).to_string();
        text += &line(mark(statement.reached), &statement.rung.to_string(), &how);
    }
    for note in notes {
        text += &paragraph(&format!("Note: {}.", Printable(note)));
    }
    text
}

fn paragraph(text: &str) -> String {
    wrapped(text, INDENT) + "\n"
}

/// What is broken, a line each.
fn broken(judged: &Judged) -> String {
    let (system, violations) = (judged.system(), &judged.judgement().violations);
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
