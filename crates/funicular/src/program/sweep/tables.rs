//! What a sweep says in the end.

use ::sweep::{Manifest, OutcomeTally, SolverTally, StoreSummary, rate_interval};
use funicular::text::sweep::outcome;
use serde_json::{Value, json};

use crate::tables::{short, word};

/// How fast it was; nothing was computed if everything was there, or if there is nothing to
/// compute.
pub fn rate(computed: u64, all: u64, seconds: f64) -> String {
    if all == 0 {
        return "This shard is empty: there are more shards than parts.\n".to_owned();
    }
    if computed == 0 {
        return "Everything was there already.\n".to_owned();
    }
    let rate = computed as f64 / seconds.max(f64::MIN_POSITIVE);
    format!("{computed} seeds in {seconds:.1} s: {} a second, written\n", short(rate.round()))
}

/// Outcomes by solver, with rates and intervals.
pub fn solvers_json(manifest: &Manifest, summary: &StoreSummary) -> Value {
    let all = summary.outcomes.seeds();
    let tally = summary.outcomes.tally();
    let rows = |solver: &SolverTally| {
        let row = |(code, row): (&i16, &OutcomeTally)| {
            let (low, high) = rate_interval(row.count, all);
            json!({
                "outcome": code,
                "meaning": outcome(manifest, *code),
                "count": row.count,
                "rate": row.count as f64 / all.max(1) as f64,
                "rate_95": [low, high],
                "iterations": { "median": row.median_iterations(), "max": row.max_iterations() },
            })
        };
        Value::from(solver.0.iter().map(row).collect::<Vec<_>>())
    };
    Value::Object(tally.solvers.iter().map(|(name, solver)| (name.clone(), rows(solver))).collect())
}

/// Seeds by comparison, if both solvers were asked.
pub fn comparisons_json(summary: &StoreSummary) -> Value {
    let counts = summary.outcomes.comparisons().map(|(c, count)| (word(&c), count.into()));
    let both = summary.outcomes.tally().both.is_some();
    Value::Object(counts.filter(|_| both).collect())
}
