//! Every printed number and statement, judged.

use paper::Reproduction;
use paper::claims::Claim;

use crate::block::{Block, Table, heading, text};
use crate::numbers::{counted, fixed, measured, signs, stable};

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    vec![
        heading(2, "claims", "Every printed number and statement"),
        text(
            "**Confirmed**: true as printed, to all printed digits. **Explained**: not true as printed, and a number shows where it \
             comes from. **Corrected**: wrong as printed, the corrected form holds. **Refuted**: false. Where a number is \
             printed the solvers' values follow with three more decimals; a dash means that the solver has nothing to say \
             on it.",
        ),
        Block::Table(Table {
            caption: "The claims in the order of the paper.".to_owned(),
            head: vec![
                "claim",
                "printed",
                "lagrange",
                "energy",
                "difference",
                "verdict",
                "the number behind it",
            ],
            rows: r.claims.iter().map(row).collect(),
            verdicts: Some(5),
        }),
    ]
}

fn row(claim: &Claim) -> Vec<String> {
    let p = &claim.printed;
    let difference = match (claim.lagrange, claim.energy) {
        (Some(lagrange), Some(energy)) if claim.printed.is_count() => {
            counted((lagrange - energy).abs())
        }
        (Some(lagrange), Some(energy)) => measured((lagrange - energy).abs(), 4),
        _ => "-".to_owned(),
    };
    vec![
        signs(&format!("{} ({})", p.says, p.place)),
        match &p.unit {
            Some(unit) if p.digits.is_some() => format!("{} {unit}", p.printed),
            _ => signs(&p.printed),
        },
        value(claim, claim.lagrange),
        value(claim, claim.energy),
        difference,
        format!("{}{}", claim.verdict, if claim.as_expected { "" } else { " (not expected)" }),
        number(claim),
    ]
}

/// A solver's value with three decimals more than are printed.
fn value(claim: &Claim, value: Option<f64>) -> String {
    /// Decimals more than printed.
    const MORE: usize = 3;
    match (value, claim.printed.digits) {
        (None, _) => "-".to_owned(),
        (Some(value), _) if claim.printed.is_count() => counted(value),
        (Some(value), Some(digits)) => fixed(value, digits + MORE),
        (Some(value), None) => measured(value, 6),
    }
}

/// What the verdict rests on.
fn number(claim: &Claim) -> String {
    let what = signs(&stable(&claim.number_is));
    match claim.number {
        None => what,
        Some(number) if claim.printed.is_count() => format!("{}: {what}", counted(number)),
        Some(number) => format!("{}: {what}", measured(number, 4)),
    }
}
