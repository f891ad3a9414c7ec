//! Chains that are hard in several ways at once, the same for every run.

use std::f64::consts::{FRAC_PI_2, TAU};

use model::{Anchors, Bar, Chain, Problem};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::shape::decades;
use crate::stream::stream;

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
            Bar::new(length, mass, centre, [0.0; 3]).expect("a valid bar")
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
    let azimuth = rng.random_range(0.0..TAU);
    let slope: f64 = match rng.random_range(0..4) {
        0 => FRAC_PI_2 * f64::from(rng.random_range(0..2_u8) * 2) - FRAC_PI_2,
        1 => FRAC_PI_2 - decades(rng, -12.0, -1.0),
        2 => 0.0,
        _ => rng.random_range(-1.5..1.5),
    };
    let vertical = slope.abs() >= FRAC_PI_2;
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

/// Chain number `seed` of those that are hard in several ways at once: lengths, masses and units
/// over many orders of magnitude, one mass alone, anchors in one place, next to one vertical, or a
/// ten-trillionth of the length nearer than the chain reaches; 2 to 200 bars.
///
/// ```
/// let problem = samples::extreme_chain(3);
/// assert!((2..8).contains(&problem.chain().bars().len()));
/// ```
pub fn extreme_chain(seed: u64) -> Problem {
    let mut rng = stream(1, seed);
    // Chains that cannot close, and weightless ones, are drawn again.
    loop {
        let n =
            if seed.is_multiple_of(3) { rng.random_range(2..8) } else { rng.random_range(2..=200) };
        let bars = bars(&mut rng, n);
        let anchors = anchors(&mut rng, &bars);
        let gravity = decades(&mut rng, -6.0, 6.0);
        let chain = Chain::new(format!("random {seed}"), gravity, anchors, bars);
        if let Ok(problem) = Problem::new(chain.expect("a valid chain")) {
            return problem;
        }
    }
}
