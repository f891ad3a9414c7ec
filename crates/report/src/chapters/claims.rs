//! Every printed number and statement, judged.

use model::number::Number;
use paper::Reproduction;
use paper::claims::Claim;
use paper::sentence::Sentence;

use crate::badge::Badge;
use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;
use crate::symbols::signs;

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    vec![
        heading(2, "claims", "Every printed number and statement"),
        text(
            "**Confirmed**: true as printed, to all printed digits. **Explained**: not true as printed, and a number shows where it \
             comes from. **Corrected**: wrong as printed, the corrected form holds. **Refuted**: false. Where a number is \
             printed the solvers' values follow with three more decimals; a dash means that the solver has nothing to say \
             on it.",
        ),
        Block::Table(Table::new(
            "The claims in the order of the paper.",
            "claim|printed|lagrange|energy|difference|verdict|the number behind it",
            r.claims.iter().map(row).collect(),
        )),
    ]
}

fn row(claim: &Claim) -> Vec<Cell> {
    let p = &claim.printed;
    let both = claim.lagrange.zip(claim.energy);
    let difference = both.map(|(lagrange, energy)| behind(claim, (lagrange - energy).abs()));
    vec![
        signs(&format!("{} ({})", p.says, p.place)).into(),
        match &p.unit {
            Some(unit) if p.digits.is_some() => format!("{} {unit}", p.printed),
            _ => signs(&p.printed),
        }
        .into(),
        value(claim, claim.lagrange).into(),
        value(claim, claim.energy).into(),
        difference.into(),
        Badge::of_claim(claim.verdict, claim.as_expected).into(),
        number(claim).into(),
    ]
}

/// A solver's value with three decimals more than are printed.
fn value(claim: &Claim, value: Option<f64>) -> Option<Number> {
    /// Decimals more than printed.
    const MORE: usize = 3;
    /// Significant digits where none are printed.
    const DIGITS: usize = 6;
    value.map(|value| match claim.printed.digits {
        _ if claim.printed.is_count() => Number::count(value),
        Some(digits) => Number::decimals(value, digits + MORE),
        None => Number::significant(value, DIGITS),
    })
}

/// A number behind a verdict.
fn behind(claim: &Claim, number: f64) -> Number {
    /// Significant digits.
    const DIGITS: usize = 4;
    if claim.printed.is_count() {
        Number::count(number)
    } else {
        Number::significant(number, DIGITS)
    }
}

/// What the verdict rests on.
fn number(claim: &Claim) -> Sentence {
    let what = claim.number_is.clone().with_words(signs);
    match claim.number {
        None => what,
        Some(number) => what.after([behind(claim, number).into(), ": ".into()]),
    }
}
