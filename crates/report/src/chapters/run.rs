//! What differs from run to run: where, with what, how long, and the counts that hang on the last
//! bit.

use model::number::Number;
use paper::Reproduction;
use paper::seeds::Survey;

use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;
use crate::environment::Environment;
use crate::numbers::fixed;

pub(crate) fn blocks<'a>(r: &'a Reproduction, environment: &Environment) -> Vec<Block<'a>> {
    let e = environment;
    vec![
        heading(2, "this-run", "This run"),
        text(
            "Everything above is the same in every run; from processor to processor only what is drawn of rounding may differ, in the \
             last points of the residuals and on the ragged borders of the basins. What follows differs.",
        ),
        Block::Table(Table::new(
            "",
            "what|which",
            [
                ("command", format!("`{}`", e.command)),
                ("version", format!("funicular {}", e.version)),
                ("compiler", e.compiler.to_owned()),
                ("packages", e.packages.join(", ")),
                ("system", e.system.clone()),
                ("processor", format!("{}, {} threads", e.processor, e.threads)),
                ("time", format!("{} s", fixed(r.seconds, 1))),
            ]
            .map(|(what, which)| vec![what.into(), which.into()])
            .to_vec(),
        )),
        text(
            "Where random starts end. A start on the border of two basins may go either way with the last bit of a sine, which \
             processors round differently.",
        ),
        Block::Table(Table::new(
            "",
            "solver|starts|where to|without help|steps: median, 95 %, most",
            r.seeds.iter().map(survey).collect(),
        )),
    ]
}

fn survey(s: &Survey) -> Vec<Cell> {
    let steps = [s.median_iterations, s.most_iterations_of_95_percent, s.most_iterations];
    vec![
        s.solver.to_string().into(),
        format!("{} {}", s.seeds, word(&s.kind)).into(),
        s.led_to("′").into(),
        s.direct.map(|count| Number::count(count as f64)).into(),
        Cell::Numbers(steps.map(|count| Number::count(count as f64)).to_vec()),
    ]
}

/// The serialised name of a unit variant.
pub(crate) fn word(value: &impl serde::Serialize) -> String {
    serde_json::to_value(value).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
}
