//! The field, judged: what others have published of cables and nets.

use model::number::Number;
use paper::Reproduction;
use validate::field::entry::{BothSolvers, Entry, FieldVerdict, HandCheck};

use crate::badge::{Badge, Tone};
use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    let (left, judged): (Vec<_>, Vec<_>) =
        r.field.iter().partition(|entry| entry.verdict() == FieldVerdict::NotJudged);
    vec![
        heading(2, "field", "The field, judged"),
        text(
            "Numbers that others have published of cables and nets, held against a closed form (the elastic catenary), against both \
             solvers, and where there is one against a law that anyone can check by hand. **Confirmed**: what is computed here, to the \
             tolerance of the source. **Corrected**: off by more, the right number stands beside it. **Refuted**: it breaks the law. \
             Forces of a line are those on its ends; a line as a run of members tends to the closed form with the square of \
             their number, and what it is off by is given in units of the largest of them.",
        ),
        Block::Table(Table::new(
            "What was judged.",
            "what|number|published|computed here|by hand|both solvers|verdict",
            judged.into_iter().map(row).collect(),
        )),
        Block::List(refutations(&r.field)),
        heading(3, "field-left", "What was not judged"),
        Block::List(left.iter().map(|entry| open(entry)).collect()),
        heading(3, "field-sources", "Sources"),
        Block::List(sources(&r.field)),
    ]
}

fn row(entry: &Entry) -> Vec<Cell> {
    let column = |of: &dyn Fn(usize) -> String| {
        (0..entry.numbers.len()).map(of).collect::<Vec<_>>().join("; ")
    };
    let number = |k: usize| &entry.numbers[k];
    let limit = |k: usize| if number(k).at_most { "at most " } else { "" };
    vec![
        entry.title.clone().into(),
        column(&|k| number(k).what.clone()).into(),
        column(&|k| format!("{}{}", limit(k), number(k).printed)).into(),
        column(&|k| format!("{:#}", Number::significant(number(k).ours, number(k).digits))).into(),
        entry.by_hand.as_ref().map(by_hand).into(),
        entry.solvers.as_ref().map(solvers).into(),
        badge(entry.verdict()).into(),
    ]
}

fn badge(verdict: FieldVerdict) -> Badge {
    let tone = match verdict {
        FieldVerdict::Confirmed => Tone::Good,
        FieldVerdict::Corrected => Tone::Mended,
        FieldVerdict::Refuted => Tone::Bad,
        FieldVerdict::NotJudged => Tone::Neutral,
    };
    Badge::new(tone, verdict.to_string())
}

/// What of the law is left over.
fn by_hand(check: &HandCheck) -> String {
    if check.broken_n <= check.allowed_n {
        return "kept".to_owned();
    }
    format!("broken by {:#} N", Number::significant(check.broken_n, 5))
}

fn solvers(both: &BothSolvers) -> String {
    /// Below this is rounding, or the digits of a file.
    const NOTHING: f64 = 1e-6;
    let small = |value: f64| {
        if value.abs() < NOTHING {
            "less than 10⁻⁶".to_owned()
        } else {
            format!("{:#}", Number::significant(value, 1))
        }
    };
    match both {
        BothSolvers::Run { members, off } => {
            let off: Vec<_> = off
                .iter()
                .map(|(solver, off)| match off {
                    Some(off) => format!("{solver} {}", small(*off)),
                    None => format!("{solver} has no answer"),
                })
                .collect();
            format!("{members} members are off by: {}", off.join(", "))
        }
        BothSolvers::Judged { finding, joints_m, rung } => {
            let rung = rung.map_or_else(|| "none".to_owned(), |rung| rung.to_string());
            let distance = small(*joints_m);
            format!("{finding}, {distance} m from the nearest equilibrium; evidence: {rung}")
        }
        BothSolvers::Least { apart_j, below_j } => format!(
            "apart by {} J; the published energy is {} J below what the lengths allow",
            small(*apart_j),
            small(*below_j)
        ),
    }
}

/// The refuted, each with the law that it breaks.
fn refutations(entries: &[Entry]) -> Vec<String> {
    let refuted = entries.iter().filter(|entry| entry.verdict() == FieldVerdict::Refuted);
    let told = |entry: &Entry| {
        let check = entry.by_hand.as_ref()?;
        let numbers: Vec<_> = entry
            .numbers
            .iter()
            .map(|number| format!("{} = {}", number.what, number.printed))
            .collect();
        Some(format!(
            "**{}** is refuted: {}. Published are {}; {:#} N are left over.",
            entry.title,
            check.law,
            numbers.join(", "),
            Number::significant(check.broken_n, 5)
        ))
    };
    let refuted: Vec<_> = refuted.filter_map(told).collect();
    if refuted.is_empty() { vec!["Nothing was refuted.".to_owned()] } else { refuted }
}

fn open(entry: &Entry) -> String {
    format!("{}: {}.", entry.title, entry.not_judged.unwrap_or("nothing to compare"))
}

/// Every source once, in the order of the record.
fn sources(entries: &[Entry]) -> Vec<String> {
    let mut sources: Vec<String> = Vec::new();
    for entry in entries {
        let source = format!("{}.", entry.source);
        if !sources.contains(&source) {
            sources.push(source);
        }
    }
    sources
}
