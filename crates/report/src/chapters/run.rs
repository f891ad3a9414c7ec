//! What differs from run to run: where, with what, how long, and the counts that hang on the last bit.

use paper::Reproduction;
use paper::seeds::Survey;

use crate::block::{Block, Table, heading, text};
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
        Block::Table(Table {
            caption: String::new(),
            head: vec!["what", "which"],
            rows: vec![
                vec!["command".to_owned(), format!("`{}`", e.command)],
                vec!["version".to_owned(), format!("funicular {}", e.version)],
                vec!["compiler".to_owned(), e.compiler.to_owned()],
                vec!["packages".to_owned(), e.packages.join(", ")],
                vec!["system".to_owned(), e.system.clone()],
                vec!["processor".to_owned(), format!("{}, {} threads", e.processor, e.threads)],
                vec!["time".to_owned(), format!("{} s", fixed(r.seconds, 1))],
            ],
            verdicts: None,
        }),
        text(
            "Where random starts end. A start on the border of two basins may go either way with the last bit of a sine, which \
             processors round differently.",
        ),
        Block::Table(Table {
            caption: String::new(),
            head: vec!["solver", "starts", "where to", "without help", "steps: median, 95 %, most"],
            rows: r.seeds.iter().map(survey).collect(),
            verdicts: None,
        }),
    ]
}

fn survey(s: &Survey) -> Vec<String> {
    let mut reached: Vec<_> = s
        .reached
        .iter()
        .filter(|e| e.seeds > 0)
        .map(|e| format!("{} {}", e.seeds, e.equilibrium.replace('\'', "′")))
        .collect();
    if s.elsewhere > 0 {
        reached.push(format!("{} elsewhere", s.elsewhere));
    }
    reached.extend(s.lost.iter().map(|l| format!("{} lost: {}", l.seeds, l.why)));
    vec![
        s.solver.to_string(),
        format!("{} {}", s.seeds, word(&s.kind)),
        reached.join(", "),
        s.direct.map_or_else(|| "-".to_owned(), |d| d.to_string()),
        format!(
            "{}, {}, {}",
            s.median_iterations, s.most_iterations_of_95_percent, s.most_iterations
        ),
    ]
}

/// The serialised name of a unit variant.
pub(crate) fn word(value: &impl serde::Serialize) -> String {
    serde_json::to_value(value).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
}
