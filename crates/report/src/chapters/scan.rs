//! How the paper obtained its numbers.

use model::number::Number;
use paper::Reproduction;

use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;
use crate::figures;

/// `view` is the interactive picture, a piece of HTML.
pub(crate) fn blocks(r: &Reproduction, view: String) -> Vec<Block<'_>> {
    vec![
        heading(2, "scan", "How the paper obtained its numbers"),
        text(
            "Take θ = 0.001, 0.002, 0.003, … rad; for each solve the quadratic (viii) for cos α, once on each of its two \
             branches; work out V by (vi); keep the smallest. This scan returns all eight printed numbers to their last \
             digit. On the first branch the result is the grid point next to the minimum. On the second it is the first point of \
             the grid, where the search began: V would go on falling at θ < 0, where the scan does not look.",
        ),
        Block::Table(returned(r)),
        Block::Figure(figures::valley(r)),
        heading(3, "view", "To try it"),
        Block::Slot {
            html: view,
            instead: "In `report.html` the chain can be turned about OD here and led along its closure curve, with V and \
                      its slope."
                .to_owned(),
        },
    ]
}

/// A difference of angles in deg, the short way round.
fn nearer(difference: f64) -> f64 {
    (difference + 180.0).rem_euclid(360.0) - 180.0
}

/// What the scan returns against what is printed and what is true.
fn returned(r: &Reproduction) -> Table {
    let printed = |id: String| {
        let claim = r.claims.iter().find(|claim| claim.printed.id == id);
        claim.and_then(|claim| Some(Number::decimals(claim.printed.value(), claim.printed.digits?)))
    };
    let truth = |name: &str, quantity: usize| {
        r.equilibria.iter().find(|p| p.name == name).map_or(f64::NAN, |p| match quantity {
            3 => p.lagrange_mgl,
            angle => p.lagrange_deg[angle].rem_euclid(360.0),
        })
    };
    let quantities =
        [("theta", "θ, deg"), ("alpha", "α, deg"), ("beta", "β, deg"), ("energy", "V, mgl")];
    let positions = [("ix", "(ix)", "E1", "(E1)", 0), ("x", "(x)", "E2", "(E2)", 1)];
    let rows = positions.into_iter().flat_map(|(id, number, name, equilibrium, result)| {
        quantities.into_iter().enumerate().map(move |(k, (quantity, symbol))| {
            let found = r.figures.scan_results[result][k];
            let found = if k < 3 { found.rem_euclid(360.0) } else { found };
            let true_value = truth(name, k);
            let off = if k < 3 { nearer(found - true_value) } else { found - true_value };
            vec![
                format!("{number} {symbol}").into(),
                printed(format!("{id}-{quantity}")).into(),
                Number::decimals(found, 5).into(),
                Cell::Number(Number::decimals(true_value, 8), equilibrium),
                Number::significant(off, 3).into(),
            ]
        })
    });
    Table::new(
        "The two results of the scan.",
        "|printed|returned by the scan|the equilibrium|scan less equilibrium",
        rows.collect(),
    )
}
