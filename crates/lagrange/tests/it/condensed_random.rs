//! Hanging chains of all hard shapes at once: the condensed solver solves them all, and every
//! answer is an equilibrium by Newton's laws and the lowest by the stress matrix.

use lagrange::condensed::{Settings, solve};
use model::{Anchors, Bar, Chain, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::judge::judge;

/// Random chains of the test.
const CHAINS: u64 = 1000;
/// Lengths, closure, force and moment balance, in units of the largest force and the total length;
/// what the solver promises for any n. Measured over a million such chains: 5e-16, for the closure
/// 1e-13.
const BALANCE: f64 = 1e-12;

/// A number whose logarithm is uniform between the decades.
fn decades(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    10.0_f64.powf(rng.random_range(low..high))
}

/// Six orders of magnitude of lengths and of masses, massless bars, one mass, centres at the ends.
fn bars(rng: &mut ChaCha8Rng, n: usize) -> Vec<Bar> {
    let (lengths, masses, centres) =
        (rng.random_range(0..3), rng.random_range(0..6), rng.random_range(0..3));
    let (metre, kilogram) = (decades(rng, -9.0, 9.0), decades(rng, -6.0, 6.0));
    let only = rng.random_range(0..n);
    (0..n)
        .map(|i| {
            let length = metre
                * match lengths {
                    0 => 1.0,
                    1 => rng.random_range(0.2..2.0),
                    _ => decades(rng, -3.0, 3.0),
                };
            let mass = kilogram
                * match masses {
                    0 => 1.0,
                    1 => rng.random_range(0.2..2.0),
                    2 => decades(rng, -3.0, 3.0),
                    3 => f64::from(u8::from(i == only)),
                    4 => f64::from(u8::from(i == 0 || i + 1 == n)),
                    _ => f64::from(u8::from(rng.random_range(0..4) == 0)) * decades(rng, -3.0, 3.0),
                };
            let centre = length
                * match centres {
                    0 => 0.5,
                    1 => rng.random_range(0.0..1.0),
                    _ => f64::from(rng.random_range(0..3_u8)) / 2.0,
                };
            Bar::new(length, mass, centre, [0.0; 3]).unwrap()
        })
        .collect()
}

/// Generic, slack, nearly taut, nearly folded, vertical, nearly vertical, together.
fn anchors(rng: &mut ChaCha8Rng, bars: &[Bar]) -> Anchors {
    let total: f64 = model::sum(bars.iter().map(Bar::length_m));
    let longest = bars.iter().map(Bar::length_m).fold(0.0, f64::max);
    let least = (2.0 * longest - total).max(0.0);
    let distance = match rng.random_range(0..7) {
        0 => 0.0,
        1 => total * (1.0 - decades(rng, -13.0, -3.0)),
        2 => least + (total - least) * decades(rng, -13.0, -3.0),
        3 => total * 0.999_999,
        _ => least + (total - least) * rng.random_range(0.0..1.0),
    };
    let azimuth = rng.random_range(0.0..std::f64::consts::TAU);
    let slope: f64 = match rng.random_range(0..4) {
        0 => {
            std::f64::consts::FRAC_PI_2 * f64::from(rng.random_range(0..2_u8) * 2)
                - std::f64::consts::FRAC_PI_2
        }
        1 => std::f64::consts::FRAC_PI_2 - decades(rng, -12.0, -1.0),
        2 => 0.0,
        _ => rng.random_range(-1.5..1.5),
    };
    let vertical = slope.abs() >= std::f64::consts::FRAC_PI_2;
    let across = if vertical { 0.0 } else { distance * slope.cos() };
    let start: [f64; 3] = if rng.random_range(0..2) == 0 {
        [0.0; 3]
    } else {
        std::array::from_fn(|_| total * rng.random_range(-1.0..1.0))
    };
    let end = [
        start[0] + across * azimuth.cos(),
        start[1] + across * azimuth.sin(),
        start[2] + distance * slope.sin(),
    ];
    Anchors { start_m: start, end_m: end }
}

fn random_problem(seed: u64) -> Problem {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    rng.set_stream(seed);
    // Chains that cannot close, and weightless ones, are drawn again.
    loop {
        let n =
            if seed.is_multiple_of(3) { rng.random_range(2..8) } else { rng.random_range(2..=200) };
        let bars = bars(&mut rng, n);
        let anchors = anchors(&mut rng, &bars);
        let gravity = decades(&mut rng, -6.0, 6.0);
        let chain = Chain::new(format!("random {seed}"), gravity, anchors, bars).unwrap();
        if let Ok(problem) = Problem::new(chain) {
            return problem;
        }
    }
}

#[test]
fn a_thousand_random_chains_hang_at_their_lowest() {
    let mut failed = Vec::new();
    for seed in 0..CHAINS {
        let problem = random_problem(seed);
        let judged = solve(&problem, &Settings::default()).map(|solution| {
            let stable = solution.equilibrium.stability.index_in_space == 0;
            (judge(&problem, &solution.equilibrium), stable, solution.pull)
        });
        let good = matches!(&judged, Ok((j, true, _)) if j.within(BALANCE) && j.lowest);
        if !good {
            failed.push(format!("{seed}: {judged:?}"));
        }
    }
    assert!(failed.is_empty(), "{} of {CHAINS}:\n{}", failed.len(), failed.join("\n"));
}

/// A hundred thousand bars of unit length between anchors two metres apart: all but straight down
/// and up again, so that the chain made coarser says nothing of the bend. Both missed their anchor
/// by more than the settings allow, because the last pass was saved on its word.
#[test]
fn deep_chains_are_not_closed_on_the_word_of_a_coarser_chain() {
    for (n, end_m) in [(100_000, [2.0, 0.0, -1.0]), (99_999, [2.0, 0.0, 0.0])] {
        let bars = vec![Bar::homogeneous(1.0, 1.0).unwrap(); n];
        let anchors = Anchors { start_m: [0.0; 3], end_m };
        let problem = Problem::new(Chain::new("deep", 9.806_65, anchors, bars).unwrap()).unwrap();
        let answer = solve(&problem, &Settings::default()).unwrap().equilibrium;
        let judged = judge(&problem, &answer);
        assert!(judged.within(BALANCE) && judged.lowest, "{n}: {judged:?}");
    }
}
