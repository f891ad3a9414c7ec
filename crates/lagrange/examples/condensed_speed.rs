//! Time of the condensed solver for equal bars, 1.5 times as long as the span, anchors (0, 0, 0)
//! and (1, 0, -0.2):
//!
//! ```text
//! cargo run --profile dist -p lagrange --example condensed_speed
//! ```
//!
//! For each number of bars the median and the least of many runs: reading the bars into arrays, the
//! pull alone, and `solve`, which does all. "Fresh" asks the system for memory in each run, "again" uses that of
//! the run before: for a million bars most of the time of a fresh run goes into the first touch of
//! 80 MB. "On two" is "solve again" on two processors. Medians are disturbed by whatever else the
//! machine does; the least are what it can do.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use lagrange::condensed::{Condensed, Settings, Solver, solve};
use model::{Anchors, Bar, Chain, Problem, STANDARD_GRAVITY_M_S2};

/// Time for all runs of one measurement.
const BUDGET_S: f64 = 1.0;
/// Runs of one measurement, at least and at most.
const RUNS: std::ops::Range<usize> = 7..10_001;
/// Short runs are repeated until they take this long together: the clock has a resolution.
const SHORTEST_S: f64 = 20e-6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let settings = Settings::default();
    let two = NonZeroUsize::MIN.saturating_add(1);
    println!("   bars  part                   median        least   per bar (least)");
    for n in [3, 10, 100, 1000, 10_000, 100_000, 1_000_000] {
        let problem = equal_bars(n)?;
        let chain = Condensed::new(&problem);
        let pull = chain.pull(&settings)?;
        measure(n, "prepare", || Condensed::new(&problem));
        measure(n, "pull", || chain.pull(&settings));
        measure(n, "solve, fresh", || solve(&problem, &settings));
        let mut solver = Solver::default();
        measure(n, "solve again", || {
            solver.solve(&problem, &settings).map(|solution| solver.take_back(solution))
        });
        let mut solver = Solver::with_processors(two);
        measure(n, "  on two", || {
            solver.solve(&problem, &settings).map(|solution| solver.take_back(solution))
        });
        println!("         passes over all bars: {}", pull.passes());
    }
    Ok(())
}

fn equal_bars(n: usize) -> Result<Problem, Box<dyn std::error::Error>> {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, -0.2] };
    let bar = Bar::homogeneous(1.5 * anchors.span_m() / n as f64, 1.0 / n as f64)?;
    Ok(Problem::new(Chain::new("equal bars", STANDARD_GRAVITY_M_S2, anchors, vec![bar; n])?)?)
}

fn measure<T>(n: usize, part: &str, mut run: impl FnMut() -> T) {
    let mut time = |repeat: usize| {
        let begun = Instant::now();
        for _ in 0..repeat {
            black_box(run());
        }
        begun.elapsed().as_secs_f64() / repeat as f64
    };
    let mut repeat = 1;
    while time(repeat) * (repeat as f64) < SHORTEST_S {
        repeat *= 2;
    }
    let begun = Instant::now();
    let mut times = Vec::new();
    while times.len() < RUNS.start
        || (begun.elapsed().as_secs_f64() < BUDGET_S && times.len() < RUNS.end)
    {
        times.push(time(repeat));
    }
    times.sort_by(f64::total_cmp);
    let (median, least) = (times[times.len() / 2], times[0]);
    println!(
        "{n:7}  {part:14} {:10.3} us {:10.3} us {:8.2} ns",
        median * 1e6,
        least * 1e6,
        least * 1e9 / n as f64
    );
}
