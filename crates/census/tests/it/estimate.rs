//! What a census would take, against what it takes. Work is compared, not time: time depends on who
//! else uses the machine.

use census::{Census, Estimate, Settings};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::problem;

/// Processor time for each cell and bar that the seconds of an estimate stand for.
const CELL_S: f64 = 1e-6;

/// Lengths from 0.3 to 1, masses from 0.1 to 1, a span of 0.1 to 0.8 of the length in any
/// direction.
fn random(bars: usize, seed: u64) -> model::Problem {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(bars as u64);
    let list: Vec<_> = (0..bars)
        .map(|_| {
            let length = rng.random_range(0.3..1.0);
            (length, rng.random_range(0.1..1.0), length * rng.random_range(0.2..0.8))
        })
        .collect();
    let total: f64 = list.iter().map(|bar| bar.0).sum();
    let span = total * rng.random_range(0.1..0.8);
    let angle: f64 = rng.random_range(0.0..std::f64::consts::TAU);
    problem(&list, [span * angle.cos(), 0.0, span * angle.sin()])
}

/// Random chains of eleven and twelve bars are estimated to a factor of two. Measured: 0.6 to 1.3,
/// of thirteen bars too.
#[test]
fn cells_and_equilibria_are_estimated_from_a_sample() {
    let settings = Settings::default();
    let seeds = std::env::var("ESTIMATES").map_or(2, |n| n.parse().expect("a number"));
    for bars in 11..=12 {
        for seed in 0..seeds {
            let problem = random(bars, seed);
            let Estimate { seconds, equilibria, .. } = Census::estimate(&problem);
            let census = Census::take(&problem, &settings).unwrap();
            let work = CELL_S * bars as f64 * census.statistics.cells as f64;
            let found = census.equilibria.len() as f64;
            // A sample of a thousand patterns says nothing of the few equilibria of a taut chain.
            let ratios = [Some(work / seconds), (found > 300.0).then(|| found / equilibria)];
            for ratio in ratios.into_iter().flatten() {
                assert!((0.5..2.0).contains(&ratio), "{bars} bars, chain {seed}: {ratio}");
            }
        }
    }
}

/// Beyond the bars of any census: 2.1 times for each bar more than sixteen, whatever the chain.
#[test]
fn estimates_beyond_any_census_grow_by_the_bar() {
    let sixteen = Estimate { seconds: 13.0, gigabytes: 0.5, equilibria: 1e5 };
    for bars in [25, 40, 1000] {
        let times = 2.1_f64.powf((bars as f64 - 16.0).min(600.0));
        let found = Census::estimate(&crate::support::equal(bars, [2.0, 0.0, 0.5]));
        let parts = |estimate: Estimate| {
            let Estimate { seconds, gigabytes, equilibria } = estimate;
            [seconds, gigabytes, equilibria]
        };
        for (found, of_sixteen) in parts(found).into_iter().zip(parts(sixteen)) {
            assert!((found / (of_sixteen * times) - 1.0).abs() < 1e-12, "{bars}: {found}");
        }
    }
}

/// Where the sample is a part of the patterns the equilibria are in proportion to them, and memory
/// to the equilibria: 0.3 µGB for each and bar.
#[test]
fn memory_is_that_of_the_equilibria() {
    for bars in [4, 11] {
        let found = Census::estimate(&random(bars, 1));
        let equilibria = found.equilibria;
        assert!(equilibria > 0.0);
        assert!((found.gigabytes / (3e-7 * bars as f64 * equilibria) - 1.0).abs() < 1e-12);
    }
}
