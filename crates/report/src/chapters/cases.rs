//! Both solvers on every case of the registry.

use model::number::Number;
use paper::Reproduction;

use crate::badge::{Badge, Tone};
use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    let rows = r.cases.iter().map(|case| {
        let numbers: [Cell; 4] = std::array::from_fn(|k| {
            case.scaled.map(|scaled| Number::significant(scaled[k], 2)).into()
        });
        let verdict = match &case.failure {
            Some(failure) => Badge::new(Tone::Bad, failure.clone()),
            None => Badge::of_agreement(case.agrees()),
        };
        [Cell::from(case.case.as_str()), Cell::count(case.bars)]
            .into_iter()
            .chain(numbers)
            .chain([case.rung.map(|rung| rung.to_string()).into(), verdict.into()])
            .collect()
    });
    vec![
        heading(2, "cases", "Both solvers on every case"),
        text(
            "The same comparison on all cases of the registry: large differences between the two would show here first. Differences \
             are in units of total length, largest force, weight times length (what each may be: `validation/tolerances.toml`); statics is the largest violation of Newton's laws.",
        ),
        Block::Table(Table::new(
            "Largest differences, case by case.",
            "case|bars|joints|forces|energy|statics|evidence|verdict",
            rows.collect(),
        )),
    ]
}
