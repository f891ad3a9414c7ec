//! Time and memory of compact censuses of long chains.
//!
//! `cargo run --profile dist -p census --example large_census -- [BARS] [CHAINS]`
//!
//! The chains: equal bars between level anchors, at a slant and on one vertical; bars of 1, 2, 3
//! and 4 units in turns; and random ones, with lengths from 0.3 to 1, masses from 0.1 to 1 and
//! anchors 0.1 to 0.8 of the total length apart. Wall times of the search and of its check, and
//! processor time of both where the system tells; the memory is the most that the program has used
//! so far (`VmHWM`). The program fails if a check does.

use std::process::ExitCode;
use std::time::Instant;

use census::{CompactCensus, Settings};
use model::{Anchors, Bar, Chain, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::process::{peak_kb, processor_s};

fn problem(lengths: &[(f64, f64)], end_m: [f64; 3]) -> Option<Problem> {
    let bars: Result<Vec<Bar>, _> = lengths.iter().map(|(l, m)| Bar::homogeneous(*l, *m)).collect();
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    Problem::new(Chain::new("long", 9.81, anchors, bars.ok()?).ok()?).ok()
}

fn chains(bars: usize, random: usize) -> Vec<(String, Problem)> {
    let equal = vec![(1.0, 1.0); bars];
    let mixed: Vec<(f64, f64)> =
        [1.0, 2.0, 3.0, 4.0].into_iter().map(|l| (l, l)).cycle().take(bars).collect();
    let n = bars as f64;
    let mut chains = vec![
        ("equal, level".to_owned(), problem(&equal, [0.6 * n, 0.0, 0.0])),
        ("equal, close".to_owned(), problem(&equal, [0.25 * n, 0.0, 0.0])),
        ("equal, slanted".to_owned(), problem(&equal, [0.4 * n, 0.0, 0.2 * n])),
        ("equal, upright".to_owned(), problem(&equal, [0.0, 0.0, -0.3 * n])),
        ("1, 2, 3, 4, level".to_owned(), problem(&mixed, [n, 0.0, 0.0])),
    ];
    for seed in 0..random as u64 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let bars: Vec<(f64, f64)> =
            (0..bars).map(|_| (rng.random_range(0.3..1.0), rng.random_range(0.1..1.0))).collect();
        let total: f64 = bars.iter().map(|(length, _)| length).sum();
        let span = total * rng.random_range(0.1..0.8);
        let (sin, cos) = rng.random_range(0.0..std::f64::consts::TAU).sin_cos();
        chains.push((format!("random {seed}"), problem(&bars, [span * cos, 0.0, span * sin])));
    }
    chains.into_iter().filter_map(|(name, problem)| Some((name, problem?))).collect()
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let mut argument =
        |default| arguments.next().and_then(|text| text.parse().ok()).unwrap_or(default);
    let (bars, random) = (argument(16), argument(4));
    if !(3..=Settings::MAX_BARS).contains(&bars) {
        eprintln!("bars: from 3 to {}", Settings::MAX_BARS);
        return ExitCode::from(2);
    }
    let settings = Settings { max_bars: bars, ..Settings::default() };
    let mut good = true;
    println!(
        "{bars} bars: equilibria, undecided, cells, search / s, check / s, memory so far / MB"
    );
    for (name, problem) in chains(bars, random) {
        let (start, before) = (Instant::now(), processor_s());
        let census = match CompactCensus::take(&problem, &settings, &|_| {}) {
            Ok(census) => census,
            Err(error) => panic!("{error}"),
        };
        let taken_s = start.elapsed().as_secs_f64();
        let verdict = census.check(&problem);
        good &= verdict.is_ok();
        println!(
            "{name:>18}: {:8} {:4} {:9} {taken_s:7.2} {:7.2} {:7.2} {:6}{}",
            census.len(),
            census.besides().undecided.len(),
            census.besides().statistics.cells,
            start.elapsed().as_secs_f64() - taken_s,
            processor_s().zip(before).map_or(f64::NAN, |(after, before)| after - before),
            peak_kb().map_or_else(String::new, |kb| (kb / 1000).to_string()),
            verdict.err().map_or_else(String::new, |error| format!(" {error}")),
        );
    }
    ExitCode::from(u8::from(!good))
}
