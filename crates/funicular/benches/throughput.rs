//! Seeds per second of both solvers on the paper's chain, in memory, identified and counted, on one
//! thread and on two.
//!
//! `cargo bench -p funicular --bench throughput`
//!
//! The best of several runs, and the middle one: one thread, two threads, and two runs of one
//! thread each that know nothing of each other, in turn, so that other work on the machine falls on
//! all. The last is what two of the machine's processors give at all: they share memory, clock and
//! host.

use std::ops::Range;
use std::time::Instant;

use sweep::{Settings, Summary, Sweep, SweepError};

/// Seeds in a run.
const SEEDS: u64 = 1 << 20;
/// Runs of each kind.
const RUNS: u64 = 15;

/// How the seeds of a run are shared.
const KINDS: [&str; 3] = ["one thread", "two threads", "two runs apart"];

fn run(sweep: &Sweep, kind: usize, seeds: Range<u64>) -> Result<Vec<Summary>, SweepError> {
    if kind < 2 {
        return Ok(vec![sweep.run(seeds, kind + 1)?]);
    }
    let middle = u64::midpoint(seeds.start, seeds.end);
    std::thread::scope(|scope| {
        let other = scope.spawn(|| sweep.run(seeds.start..middle, 1));
        let here = sweep.run(middle..seeds.end, 1)?;
        let other = other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
        Ok(vec![other, here])
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let problem = model::cases::paper();
    println!("{SEEDS} uniform seeds a run, {RUNS} runs of each kind; million seeds/s");
    println!("                          best  middle  times one thread");
    for name in ["lagrange", "energy"] {
        let solvers = funicular::starts::solvers(&problem)?.only(&[name]);
        let sweep = Sweep::new(&problem, Settings::default(), solvers)?;
        let mut rates = [const { Vec::new() }; KINDS.len()];
        let (mut found, mut seeds) = (0, 0);
        for round in 0..RUNS {
            for (kind, rates) in rates.iter_mut().enumerate() {
                let first = round * SEEDS;
                let clock = Instant::now();
                let summaries = run(&sweep, kind, first..first + SEEDS)?;
                rates.push(SEEDS as f64 / clock.elapsed().as_secs_f64() / 1e6);
                for summary in &summaries {
                    let tally = summary.tally();
                    let rows = tally.solvers.iter().flat_map(|(_, rows)| &rows.0);
                    let listed = rows.filter(|(outcome, _)| **outcome >= 0);
                    found += listed.map(|(_, row)| row.count).sum::<u64>();
                }
                seeds += SEEDS;
            }
        }
        let figures = rates.map(|mut rates| {
            rates.sort_by(f64::total_cmp);
            [rates[rates.len() - 1], rates[rates.len() / 2]]
        });
        for (kind, [best, middle]) in KINDS.iter().zip(figures) {
            let times = [best / figures[0][0], middle / figures[0][1]];
            println!(
                "{name:8}  {kind:14} {best:6.3}  {middle:6.3}  {:.2}, {:.2}",
                times[0], times[1]
            );
        }
        println!("{name:8}  {found} of {seeds} seeds at an equilibrium of the census");
    }
    Ok(())
}
