//! What a changed system comes to rest in, as cells of a table.

use super::shape::percent;
use super::tables::short;
use crate::settled::{Outcome, Settled, Unsettled};
use crate::weakest::Weakest;

/// The head of a table of changed systems: these columns, and those of [`cells`].
pub fn head(names: &[&'static str], strong: bool) -> Vec<&'static str> {
    let used: &[_] = if strong { &["used", "bar"] } else { &[] };
    [names, &["moves / m", "tension / N", "bar"], used, &["evidence"]].concat()
}

/// The cells `moves / m`, `tension / N`, `bar`, where members have strengths `used` and `bar`, and
/// `evidence`.
pub fn cells(found: &Result<Settled, Unsettled>, strong: bool) -> Vec<String> {
    let empty = |count: usize| vec![String::new(); count];
    let Settled { extremes, moves_m, weakest, agrees, rung, .. } = match found {
        Ok(settled) => settled,
        Err(reason) => {
            let word = word(reason.outcome).to_owned();
            return [empty(if strong { 5 } else { 3 }), vec![word]].concat();
        }
    };
    let mut cells = vec![short((1e6 * moves_m).round() / 1e6)];
    let tension = extremes.tension_n.map(|(bar, n)| vec![short(n), (bar + 1).to_string()]);
    cells.extend(tension.unwrap_or_else(|| empty(2)));
    if strong {
        let used = weakest.map(|w| vec![percent(w.utilisation), (w.bar + 1).to_string()]);
        cells.extend(used.unwrap_or_else(|| empty(2)));
    }
    let rung = rung.as_ref().filter(|_| *agrees);
    cells.push(rung.map_or_else(|| "no agreement".to_owned(), ToString::to_string));
    cells
}

/// What becomes of a system in a word.
fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Falls => "falls",
        Outcome::Leaves => "leaves",
        Outcome::NoLoad => "no load",
        Outcome::Unknown => "no answer",
    }
}

/// How near to breaking it is, or how much it pulls.
pub fn severe(settled: &Settled) -> f64 {
    let tension_n = settled.extremes.tension_n.map_or(0.0, |(_, force_n)| force_n);
    settled.weakest.map_or(tension_n, |weakest| weakest.demand())
}

/// How much of its strength a member uses, in words behind its name.
pub fn used(weakest: &Weakest) -> String {
    if weakest.utilisation.is_finite() {
        format!("is at {} of its strength", percent(weakest.utilisation))
    } else {
        "has no bound to its force".to_owned()
    }
}
