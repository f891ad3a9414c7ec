//! Seeds per second of both solvers on the paper's chain, in memory, identified and counted, on one thread
//! and on two.
//!
//! `cargo run --release -p sweep --example throughput`
//!
//! The best of several runs, one and two threads in turn, so that other work on the machine falls on both.

use std::time::Instant;

use sweep::{Settings, Solvers, Sweep};

/// Seeds in a run.
const SEEDS: u64 = 1 << 20;
/// Runs, of which the best counts.
const RUNS: u64 = 9;

fn main() -> Result<(), sweep::SweepError> {
    let problem = model::cases::paper();
    println!("{SEEDS} uniform seeds a run, best of {RUNS} runs");
    for (name, solvers) in [("lagrange", Solvers::Lagrange), ("energy", Solvers::Energy)] {
        let sweep = Sweep::new(&problem, Settings { solvers, ..Settings::default() })?;
        let mut best = [f64::INFINITY; 2];
        let (mut found, mut seeds) = (0, 0);
        for run in 0..RUNS {
            for (threads, best) in [1, 2].into_iter().zip(&mut best) {
                let first = run * SEEDS;
                let clock = Instant::now();
                let summary = sweep.run(first..first + SEEDS, threads)?;
                *best = best.min(clock.elapsed().as_secs_f64());
                let tally = summary.tally();
                let rows = [&tally.lagrange, &tally.energy].into_iter().flatten();
                let listed = rows.flat_map(|rows| &rows.0).filter(|(outcome, _)| **outcome >= 0);
                found += listed.map(|(_, row)| row.count).sum::<u64>();
                seeds += SEEDS;
            }
        }
        let [one, two] = best.map(|seconds| SEEDS as f64 / seconds / 1e6);
        println!(
            "{name:8}  one thread {one:.3} million seeds/s, two {two:.3}, efficiency {:.2}; {found} of {seeds} \
             seeds at an equilibrium of the census",
            two / one / 2.0,
        );
    }
    Ok(())
}
