//! Are the bars cleared? `cargo run --profile dist -p benches --bin bars`
//!
//! Equal bars, together 1.5 times as long as the span, anchors (0, 0, 0) and (1, 0, -0.2). Nobody
//! solves the same chain twice: the solvers of chains that are long get a copy of it that no cache
//! holds. All is measured again and again, one after the other, for half a minute (or as many
//! seconds as the first argument says), and of each the least time counts: what else the machine
//! does can only add. On a busy machine even the least of some ten milliseconds has other programs
//! in it; on Linux the mean time that the thread itself had a processor is shown beside it, which
//! has not (but the misses of a cache that others fill). Exits with 1 when a bar is not cleared by
//! the clock.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::time::Instant;

use benches::equal_bars;
use lagrange::condensed::{Condensed, Settings, Solver};
use model::{Bar, Problem};

/// Seconds of measuring, unless told.
const SECONDS: f64 = 30.0;
/// Rounds at least: of fewer the least means nothing.
const ROUNDS: usize = 5;
/// Calls of what takes less than the clock can tell.
const SHORT_CALLS: u32 = 2_000;

/// Bytes of bars between two solutions of the same copy of a chain, more than caches hold.
const BEYOND_CACHES: usize = 100_000_000;
/// Bars of the shortest chain for which that matters.
const LONG: usize = 1_000;

/// Measurements of one thing in a row: the first finds the caches full of something else.
const IN_A_ROW: usize = 4;

/// The least time of something, s.
struct Timer {
    name: &'static str,
    bars: usize,
    calls: u32,
    run: Box<dyn FnMut()>,
    least: f64,
    /// On the processor, s, over all rounds; `None` where the system does not tell.
    processor: Option<f64>,
    rounds: u32,
}

/// Time that this thread has had a processor, s.
fn processor_s() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: u64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds as f64 * 1e-9)
}

impl Timer {
    fn new(name: &'static str, bars: usize, run: impl FnMut() + 'static) -> Self {
        let calls = if bars < 1_000 { SHORT_CALLS } else { 1 };
        let (least, processor) = (f64::INFINITY, Some(0.0));
        Self { name, bars, calls, run: Box::new(run), least, processor, rounds: 0 }
    }

    /// Mean time on the processor, s.
    fn on_processor(&self) -> Option<f64> {
        self.processor.map(|sum| sum / f64::from(self.rounds) / f64::from(self.calls))
    }

    fn round(&mut self) {
        for _ in 0..IN_A_ROW {
            self.measure();
        }
    }

    fn measure(&mut self) {
        let begun = processor_s();
        let clock = Instant::now();
        for _ in 0..self.calls {
            (self.run)();
        }
        let elapsed = clock.elapsed();
        self.rounds += 1;
        let spent = begun.zip(processor_s()).map(|(begun, ended)| ended - begun);
        self.processor = self.processor.zip(spent).map(|(sum, spent)| sum + spent);
        self.least = self.least.min(elapsed.as_secs_f64() / f64::from(self.calls));
    }
}

const SOLVE: &str = "lagrange: all joints and forces";
const AGAIN: &str = "  the same bars again and again";
const TWO: &str = "  the same on two processors";
const FRESH: &str = "  the same in fresh memory";
const PULL: &str = "  of it: the pull";
const MEMORY: &str = "reading the bars from memory, once";
const ENERGY: &str = "energy: all joints and forces";

/// Copies of a chain, so many that the caches have lost the first when the last is read.
fn copies(bars: usize) -> Vec<Problem> {
    let copies = if bars < LONG { 1 } else { 1 + BEYOND_CACHES / (bars * size_of::<Bar>()) };
    (0..copies).map(|_| equal_bars(bars)).collect()
}

fn solver(name: &'static str, problems: Vec<Problem>, processors: usize) -> Timer {
    let bars = problems[0].chain().bars().len();
    let processors = NonZeroUsize::new(processors).unwrap_or(NonZeroUsize::MIN);
    let mut solver = Solver::with_processors(processors);
    let mut turn = 0;
    Timer::new(name, bars, move || {
        turn = (turn + 1) % problems.len();
        let found = solver.solve(black_box(&problems[turn]), &Settings::default());
        solver.take_back(found.expect("a slack chain"));
    })
}

fn pull(bars: usize) -> Timer {
    let chain = Condensed::new(&equal_bars(bars));
    Timer::new(PULL, bars, move || {
        black_box(black_box(&chain).pull(&Settings::default()).expect("a slack chain"));
    })
}

fn memory(bars: usize) -> Timer {
    let problem = equal_bars(bars);
    let sum = |problem: &Problem| -> f64 {
        // Four sums at once, or the time is that of adding.
        let mut lanes = [0.0; 4];
        for four in problem.chain().bars().chunks(4) {
            for (lane, bar) in lanes.iter_mut().zip(four) {
                *lane += bar.length_m() + bar.mass_kg() + bar.centre_m();
            }
        }
        lanes.iter().sum()
    };
    Timer::new(MEMORY, bars, move || {
        black_box(sum(black_box(&problem)));
    })
}

fn fresh(bars: usize) -> Timer {
    let problem = equal_bars(bars);
    Timer::new(FRESH, bars, move || {
        black_box(lagrange::condensed::solve(&problem, &Settings::default()).expect("slack"));
    })
}

fn minimiser(bars: usize) -> Timer {
    let problem = equal_bars(bars);
    Timer::new(ENERGY, bars, move || {
        black_box(energy::minimise(&problem, &energy::Settings::default()).expect("slack"));
    })
}

fn timers() -> Vec<Timer> {
    let mut timers = vec![pull(10), solver(SOLVE, copies(10), 1)];
    for bars in [100_000, 1_000_000] {
        timers.push(solver(SOLVE, copies(bars), 1));
        timers.push(solver(AGAIN, vec![equal_bars(bars)], 1));
        timers.push(pull(bars));
        timers.push(solver(TWO, copies(bars), 2));
        timers.push(fresh(bars));
        timers.push(memory(bars));
    }
    timers.push(minimiser(1_000));
    timers.push(minimiser(100_000));
    timers
}

fn main() -> ExitCode {
    let seconds = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(SECONDS);
    let mut timers = timers();
    let clock = Instant::now();
    let mut rounds = 0;
    while rounds < ROUNDS || clock.elapsed().as_secs_f64() < seconds {
        timers.iter_mut().for_each(Timer::round);
        rounds += 1;
    }
    println!("least of {rounds} rounds; one bar in memory is {} bytes", size_of::<Bar>());
    println!("{:54} least             a bar   mean on the processor", "");
    for timer in &timers {
        let Timer { name, bars, least, .. } = timer;
        let each = 1e9 * least / *bars as f64;
        let mean = timer.on_processor().map_or(String::new(), |s| format!("{:12.3} us", 1e6 * s));
        println!("  {name:36} n = {bars:<8} {:12.3} us  {each:8.2} ns  {mean}", 1e6 * least);
    }
    let of = |name: &str, bars: usize| {
        let found = timers.iter().find(|timer| timer.name == name && timer.bars == bars);
        let nan = [f64::NAN; 2];
        found.map_or(nan, |timer| [timer.least, timer.on_processor().unwrap_or(f64::NAN)])
    };
    let (large, small) = (of(SOLVE, 1_000_000), of(SOLVE, 100_000));
    let ratio = [large[0] / small[0], large[1] / small[1]];
    let bars = [
        ("lagrange, time(10^6) / time(10^5)", ratio, 1.0, 12.0, "times"),
        ("lagrange, n = 10^6, one processor", large, 1e3, 20.0, "ms"),
        ("lagrange, n = 10^5, one processor", small, 1e3, 2.0, "ms"),
        ("lagrange, n = 10, the pull", of(PULL, 10), 1e6, 0.6, "us"),
        ("energy, n = 10^5", of(ENERGY, 100_000), 1e3, 800.0, "ms"),
    ];
    println!("{:40} at most      least  mean on the processor", "");
    let mut cleared = true;
    for (what, times, scale, limit, unit) in bars {
        let [least, mean] = times.map(|time| scale * time);
        // NaN clears no bar.
        let pass = least <= limit;
        cleared &= pass;
        let verdict = if pass { "pass" } else { "FAIL" };
        println!("{verdict}  {what:34} {limit:7.1} {least:10.3} {mean:10.3} {unit}");
    }
    let reads = large[0] / of(MEMORY, 1_000_000)[0];
    println!("      a million bars take the time of reading them from memory {reads:.1} times");
    if cleared { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
