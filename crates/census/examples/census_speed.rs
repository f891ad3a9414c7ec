//! How long a census takes: the paper's chain and random ones.
//!
//! `cargo run --profile dist -p census --example census_speed -- [MAX_BARS] [CHAINS] [MIN_BARS]`
//!
//! Every line with a target says whether all chains met it; the program fails if one is incomplete
//! or slower. The last line is the growth of the mean time per bar, which the estimate of a refused
//! census rests on.
//!
//! Random chains with generic lengths: lengths from 0.3 to 1, masses from 0.1 to 1, centres from
//! 0.2 to 0.8 of the length, span from 0.1 to 0.8 of the total length in any direction; seeds are
//! fixed.

use std::process::ExitCode;

use census::{Census, Settings};
use model::{Anchors, Bar, Chain, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Targets: the paper's chain (median), and the worst of the random chains, s.
const PAPER_S: f64 = 2e-3;
const TARGETS: [(usize, f64); 4] = [(5, 0.1), (6, 0.5), (8, 10.0), (10, 120.0)];

/// Chains up to so many bars are taken several times, and the shortest time counts: others use the
/// processors too.
const SHORT: usize = 8;
const REPEATS: usize = 3;

fn random_problem(bars: usize, seed: u64) -> Problem {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(bars as u64);
    loop {
        let bars: Vec<Bar> = (0..bars)
            .filter_map(|_| {
                let length = rng.random_range(0.3..1.0);
                let mass = rng.random_range(0.1..1.0);
                let centre = length * rng.random_range(0.2..0.8);
                Bar::new(length, mass, centre, [0.0; 3]).ok()
            })
            .collect();
        let total: f64 = bars.iter().map(Bar::length_m).sum();
        let span = total * rng.random_range(0.1..0.8);
        let angle: f64 = rng.random_range(0.0..std::f64::consts::TAU);
        let end_m = [span * angle.cos(), 0.0, span * angle.sin()];
        let anchors = Anchors { start_m: [0.0; 3], end_m };
        let problem = Chain::new("random", 9.81, anchors, bars).map(Problem::new);
        if let Ok(Ok(problem)) = problem {
            return problem;
        }
    }
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let mut argument =
        |default| arguments.next().and_then(|text| text.parse().ok()).unwrap_or(default);
    let (max_bars, chains, min_bars) = (argument(10), argument(20), argument(2));
    if !(2..=max_bars).contains(&min_bars) || max_bars > Settings::MAX_BARS || chains == 0 {
        eprintln!("bars: from 2 to {}; at least one chain", Settings::MAX_BARS);
        return ExitCode::from(2);
    }
    let settings = Settings { max_bars: Settings::MAX_BARS, ..Settings::default() };
    let take = |problem: &Problem| match Census::take(problem, &settings) {
        Ok(census) => census,
        Err(error) => panic!("{error}"),
    };
    let paper = model::cases::paper();
    let mut seconds: Vec<f64> = (0..100).map(|_| take(&paper).statistics.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let verdict = |met: bool| if met { "met" } else { "NOT MET" };
    let mut good = seconds[50] < PAPER_S;
    println!(
        "paper: {:.3} ms median, {:.3} ms worst of 100; target {} ms {}",
        1e3 * seconds[50],
        1e3 * seconds[99],
        1e3 * PAPER_S,
        verdict(good)
    );

    println!(
        "bars chains complete equilibria(max) cells(max) mean_s median_s worst_s widest target"
    );
    let mut means = vec![];
    for bars in min_bars..=max_bars {
        let mut results: Vec<Census> = (0..chains)
            .map(|seed| {
                let problem = random_problem(bars, seed as u64);
                let mut census = take(&problem);
                if bars > SHORT {
                    let estimate = Census::estimate(&problem);
                    println!(
                        "seed {seed}: {:.2} s of one processor and {:.0} equilibria estimated; {:.2} s and {} found",
                        estimate.seconds,
                        estimate.equilibria,
                        census.statistics.seconds,
                        census.equilibria.len()
                    );
                }
                for _ in 1..if bars <= SHORT { REPEATS } else { 1 } {
                    let seconds = take(&problem).statistics.seconds;
                    census.statistics.seconds = census.statistics.seconds.min(seconds);
                }
                if !census.complete {
                    println!("seed {seed} of {bars} bars is incomplete: {:?}", census.topology);
                    for open in &census.undecided {
                        println!(
                            "  {:?} on {:?} at {:?}: {} patterns, first {:?}",
                            open.reason,
                            open.chart,
                            open.at,
                            open.signs.len(),
                            open.signs.first()
                        );
                    }
                }
                census
            })
            .collect();
        results.sort_by(|a, b| a.statistics.seconds.total_cmp(&b.statistics.seconds));
        let complete = results.iter().filter(|census| census.complete).count();
        let seconds = |k: usize| results[k].statistics.seconds;
        let mean =
            results.iter().map(|census| census.statistics.seconds).sum::<f64>() / chains as f64;
        means.push(mean);
        let worst = seconds(chains - 1);
        let target = TARGETS.iter().find(|(at, _)| *at == bars).map(|(_, target)| *target);
        good &= complete == chains && target.is_none_or(|target| worst < target);
        println!(
            "{bars:4} {chains:6} {complete:8} {:15} {:10} {mean:.4} {:8.4} {worst:7.4} {:6.0e} {}",
            results.iter().map(Census::count_in_plane).max().unwrap_or(0),
            results.iter().map(|census| census.statistics.cells).max().unwrap_or(0),
            seconds(chains / 2),
            results
                .iter()
                .flat_map(|census| census.equilibria.iter().map(census::ProvenEquilibrium::width))
                .fold(0.0, f64::max),
            target.map_or_else(String::new, |target| format!(
                "{target} s {}",
                verdict(worst < target)
            )),
        );
    }
    if let (Some(first), Some(last)) = (means.first(), means.last()) {
        let growth = (last / first).powf(1.0 / (means.len() as f64 - 1.0).max(1.0));
        println!("growth of the mean per bar: {growth:.2}");
    }
    ExitCode::from(u8::from(!good))
}
