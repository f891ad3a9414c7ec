//! Counts of a sweep as JSON, with the keys of `funicular sweep --json`.

use ::sweep::{OutcomeTally, Summary, rate_interval};
use serde_json::{Value, json};

/// Outcomes by solver, and both solvers held against each other.
pub fn outcomes(summary: &Summary) -> Value {
    let seeds = summary.seeds();
    let row = |(code, row): (&i16, &OutcomeTally)| {
        let (low, high) = rate_interval(row.count, seeds);
        json!({
            "outcome": code,
            "count": row.count,
            "rate_95": [low, high],
            "iterations": { "median": row.median_iterations(), "max": row.max_iterations() },
        })
    };
    let tally = summary.tally();
    let solvers = tally.solvers.iter().map(|(name, solver)| {
        (name.clone(), Value::from(solver.0.iter().map(row).collect::<Vec<_>>()))
    });
    // A comparison is a word in JSON.
    let comparisons =
        summary.comparisons().filter(|_| tally.both.is_some()).map(|(word, count)| {
            (json!(word).as_str().unwrap_or_default().to_owned(), Value::from(count))
        });
    json!({
        "solvers": Value::Object(solvers.collect()),
        "comparisons": Value::Object(comparisons.collect()),
        "disagreements": summary.named_disagreements().collect::<Vec<_>>(),
    })
}
