//! A sweep as text.

use std::fmt::{self, Write as _};

use ::sweep::{
    Comparison, Discovered, Failure, Manifest, Member, OutcomeTally, SCHEMA_VERSION, SolverTally,
    StoreSummary, Summary, rate_interval,
};
use serde_json::{Value, json};

use super::printable::Printable;
use super::tables::{Table, numbers_from, short, significant, table, word, wrapped};
use crate::sweep::SweepAnswer;

/// As `funicular sweep` prints it.
impl fmt::Display for SweepAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let proven = self.manifest.equilibria.len();
        let reached = StoreSummary {
            schema_version: SCHEMA_VERSION,
            outcomes: self.summary.clone(),
            discovered: Some(Discovered {
                equilibria: self.equilibria[proven..].to_vec(),
                below_j: self.listed_below_j,
            }),
            parts: vec![],
        };
        f.write_str(&summary(&self.manifest, &reached))
    }
}

/// Seeds named one by one in the terminal; `summary.json` has more.
const NAMED: usize = 20;

/// Everything about the outcomes.
pub fn summary(manifest: &Manifest, summary: &StoreSummary) -> String {
    let all = summary.outcomes.seeds();
    let shard = if manifest.shard.of > 1 {
        format!(" (shard {} of {} seeds)", manifest.shard, manifest.seeds)
    } else {
        String::new()
    };
    let kind = if manifest.source == Manifest::PLACES { "spatial" } else { &manifest.source };
    let mut text = format!(
        "{}: {all} {kind} seeds, seed number {}{shard}\n",
        Printable(&manifest.system.name),
        manifest.seed_number
    );
    let proof = if manifest.equilibria_complete {
        "the census proves that there are no others"
    } else {
        "there may be others: the census is not complete"
    };
    let lowest = summary.listed_below_j().map_or_else(String::new, |below_j| {
        format!(", the lowest of those reached: none from {} J on", short(below_j))
    });
    let listed = summary.equilibria(manifest).count();
    if let Some(release) = &manifest.release {
        let said = format!(
            "released at rest, followed for at most {} s in steps of {} s; damping {} 1/s, friction {} N m s",
            short(release.time_s),
            short(release.step_s),
            short(release.damping_1_s),
            short(release.friction_n_m_s)
        );
        let _ = writeln!(text, "{}", wrapped(&said, 2));
    }
    let listed = match listed {
        1 => "1 equilibrium".to_owned(),
        several => format!("{several} equilibria"),
    };
    let _ = writeln!(text, "{listed} in the list{lowest}; {proof}\n");
    let tally = summary.outcomes.tally();
    let codes = tally.solvers.iter().flat_map(|(_, solver)| solver.0.keys());
    let mut members = codes.filter_map(|code| summary.equilibrium(manifest, *code));
    let of =
        if members.any(|member| member.index_in_space.is_some()) { "space" } else { "the plane" };
    let falls = format!("index: directions of {of} in which the energy falls");
    for (name, solver) in &tally.solvers {
        let _ = writeln!(text, "{name} ({falls}):\n{}\n", outcomes(manifest, summary, solver));
    }
    if tally.both.is_some() {
        text += &comparisons(manifest, summary);
    }
    text
}

fn outcomes(manifest: &Manifest, summary: &StoreSummary, solver: &SolverTally) -> Table {
    let all = summary.outcomes.seeds();
    let release = manifest.release.as_ref();
    let [median, most] = if release.is_some() {
        ["median\ntime / s", "longest\n/ s"]
    } else {
        ["median\nsteps", "most\nsteps"]
    };
    // What is released is looked at after spans of time.
    let spans = |count: u16| match release {
        Some(release) => short(f64::from(count) * release.span_s),
        None => count.to_string(),
    };
    let mut table = table([
        "outcome", "energy / J", "index", "seeds", "rate\n/ %", "95 % interval", median, most,
    ]);
    // Equilibria first, then failures from the most harmless on.
    let (failed, reached): (Vec<_>, Vec<_>) = solver.0.iter().partition(|(code, _)| **code < 0);
    for (code, row) in reached.into_iter().chain(failed.into_iter().rev()) {
        let member = summary.equilibrium(manifest, *code);
        let (low, high) = rate_interval(row.count, all);
        let index = member.and_then(Member::index);
        table.add_row([
            outcome(manifest, *code),
            member.map_or_else(String::new, |member| short(member.energy_j)),
            index.map_or_else(String::new, |index| index.to_string()),
            row.count.to_string(),
            significant(percent(row.count, all), 4),
            // More digits than the interval is wide for would say nothing.
            format!("{} to {}", significant(100.0 * low, 4), significant(100.0 * high, 4)),
            spans(row.median_iterations()),
            spans(row.max_iterations()),
        ]);
    }
    numbers_from(&mut table, 1);
    table
}

/// The words for an outcome; equilibria are counted from 1.
pub fn outcome(manifest: &Manifest, code: i16) -> String {
    let failures = [
        (Failure::IterationLimit, ["iteration limit", "not at rest in time"]),
        (Failure::Stalled, ["stalled", "no step possible"]),
        (Failure::NonFinite, ["a number overflowed"; 2]),
        (Failure::Unlisted, ["not listed", "at rest elsewhere"]),
    ];
    let released = usize::from(manifest.release.is_some());
    let failure = failures.into_iter().find(|(failure, _)| *failure as i16 == code);
    failure.map_or_else(
        || format!("equilibrium {}", i32::from(code) + 1),
        |(_, words)| words[released].to_owned(),
    )
}

/// Outcomes by solver, with rates and intervals; seeds by comparison, if both solvers were asked; and contradictions.
pub fn object(manifest: &Manifest, summary: &Summary) -> Value {
    let all = summary.seeds();
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
    let tally = summary.tally();
    let solvers = tally.solvers.iter().map(|(name, solver)| {
        (name.clone(), Value::from(solver.0.iter().map(row).collect::<Vec<_>>()))
    });
    let comparisons = summary.comparisons().filter(|_| tally.both.is_some());
    let comparisons = comparisons.map(|(comparison, count)| (word(&comparison), count.into()));
    json!({
        "solvers": Value::Object(solvers.collect()),
        "comparisons": Value::Object(comparisons.collect()),
        "disagreements": summary.named_disagreements().collect::<Vec<_>>(),
    })
}

fn percent(count: u64, all: u64) -> f64 {
    100.0 * count as f64 / all.max(1) as f64
}

fn comparisons(manifest: &Manifest, summary: &StoreSummary) -> String {
    let all = summary.outcomes.seeds();
    let mut table = table(["both solvers", "seeds", "rate / %", "as it should be"]);
    for (comparison, count) in summary.outcomes.comparisons().filter(|(_, count)| *count > 0) {
        table.add_row([
            words(comparison).to_owned(),
            count.to_string(),
            short(percent(count, all)),
            match comparison {
                gap if manifest.explains(gap) => "unknown: the list ends below",
                wrong if wrong.should_not_be() => "NO",
                _ => "yes",
            }
            .to_owned(),
        ]);
    }
    numbers_from(&mut table, 1);
    let mut text = format!("{table}\n\n");
    // A seed for which the list has no entry is no contradiction.
    let listed = summary.outcomes.disagreements().iter();
    let listed: Vec<_> = listed.filter(|seed| !manifest.explains(seed.comparison)).collect();
    let solvers: Vec<&str> = summary.outcomes.tally().names().collect();
    for disagreement in listed.iter().take(NAMED) {
        let said = solvers.iter().zip(disagreement.outcomes);
        let said: Vec<_> =
            said.map(|(name, code)| format!("{name}: {}", outcome(manifest, code))).collect();
        let (seed, what) = (disagreement.seed, words(disagreement.comparison));
        let _ = writeln!(text, "seed {seed}: {what} ({})", said.join("; "));
    }
    if listed.len() > NAMED {
        let _ = writeln!(text, "... summary.json lists {} of them", listed.len());
    }
    text
}

fn words(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Same => "the same equilibrium",
        Comparison::NoMinimum => "lagrange at a saddle or maximum, energy at a minimum",
        Comparison::OtherBasin => "different minima",
        Comparison::Unclassified => "different equilibria, one of unknown kind",
        Comparison::Failed => "one or both did not converge",
        Comparison::EnergyAtNoMinimum => "energy at no minimum",
        Comparison::EnergiesDiffer => "the same equilibrium with different energies",
        Comparison::NotListed => "one or both not listed",
    }
}
