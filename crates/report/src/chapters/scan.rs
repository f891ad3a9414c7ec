//! How the paper obtained its numbers.

use paper::Reproduction;

use crate::block::{Block, Table, heading, text};
use crate::figures;
use crate::numbers::{fixed, measured};

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
        claim.map_or_else(|| "-".to_owned(), |claim| claim.printed.printed.clone())
    };
    let truth = |name: &str, quantity: usize| {
        r.equilibria.iter().find(|p| p.name == name).map_or(f64::NAN, |p| match quantity {
            3 => p.lagrange_mgl,
            angle => p.lagrange_deg[angle].rem_euclid(360.0),
        })
    };
    let quantities =
        [("theta", "θ, deg"), ("alpha", "α, deg"), ("beta", "β, deg"), ("energy", "V, mgl")];
    let positions = [("ix", "(ix)", "E1", 0), ("x", "(x)", "E2", 1)];
    let rows = positions.into_iter().flat_map(|(id, number, name, result)| {
        quantities.into_iter().enumerate().map(move |(k, (quantity, symbol))| {
            let found = r.figures.scan_results[result][k];
            let found = if k < 3 { found.rem_euclid(360.0) } else { found };
            let true_value = truth(name, k);
            vec![
                format!("{number} {symbol}"),
                printed(format!("{id}-{quantity}")),
                fixed(found, 5),
                format!("{} ({name})", fixed(true_value, 8)),
                measured(if k < 3 { nearer(found - true_value) } else { found - true_value }, 3),
            ]
        })
    });
    Table {
        caption: "The two results of the scan.".to_owned(),
        head: vec![
            "",
            "printed",
            "returned by the scan",
            "the equilibrium",
            "scan less equilibrium",
        ],
        rows: rows.collect(),
        verdicts: None,
    }
}
