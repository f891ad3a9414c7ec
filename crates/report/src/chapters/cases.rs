//! Both solvers on every case of the registry.

use paper::Reproduction;

use crate::block::{Block, Table, heading, text};
use crate::numbers::measured;

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    let rows = r.cases.iter().map(|case| {
        let numbers = case.scaled.map_or_else(
            || [(); 4].map(|()| "-".to_owned()),
            |scaled| scaled.map(|x| measured(x, 2)),
        );
        [case.case.clone(), case.bars.to_string()]
            .into_iter()
            .chain(numbers)
            .chain([
                case.rung.map_or_else(|| "-".to_owned(), |rung| rung.to_string()),
                match &case.failure {
                    Some(failure) => failure.clone(),
                    None if case.agrees() => "agreed".to_owned(),
                    None => "disagreed".to_owned(),
                },
            ])
            .collect()
    });
    vec![
        heading(2, "cases", "Both solvers on every case"),
        text(
            "The same comparison on all cases of the registry: large differences between the two would show here first. Differences \
             are in the units of their budgets in `validation/tolerances.toml` (total length, largest force, weight times \
             length); statics is the largest violation of Newton's laws.",
        ),
        Block::Table(Table {
            caption: "Largest differences, case by case.".to_owned(),
            head: vec![
                "case", "bars", "joints", "forces", "energy", "statics", "evidence", "verdict",
            ],
            rows: rows.collect(),
            verdicts: Some(7),
        }),
    ]
}
