//! Random chains, seeds and states for the tests.

use std::f64::consts::PI;

use lagrange::Seed;
use model::{Anchors, Bar, Chain, Problem};
use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// mg of the paper's example, N; mgl is the same number of J.
pub const MG: f64 = 9.806_65;

/// Random number stream `index` of a test.
pub fn stream(seed: u64, index: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index as u64);
    random
}

/// Bars of lengths 0.5..2 m, masses 0.1..3 kg, centres anywhere on them.
pub fn bars(random: &mut ChaCha8Rng, count: usize) -> Vec<Bar> {
    let mut bar = || {
        let length = random.random_range(0.5..2.0);
        let centre = length * random.random_range(0.0..1.0);
        Bar::new(length, random.random_range(0.1..3.0), centre, [0.0; 3]).unwrap()
    };
    (0..count).map(|_| bar()).collect()
}

/// A chain of random bars with anchors anywhere, closed or not: for formulas, not for solves.
pub fn any_chain(random: &mut ChaCha8Rng, count: usize) -> Chain {
    let mut point = || std::array::from_fn(|_| random.random_range(-1.0..1.0));
    let anchors = Anchors { start_m: point(), end_m: point() };
    Chain::new("any", 9.81, anchors, bars(random, count)).unwrap()
}

/// A chain of random bars that closes; on one vertical if asked.
pub fn problem(random: &mut ChaCha8Rng, count: usize, vertical: bool) -> Problem {
    let bars = bars(random, count);
    let total: f64 = bars.iter().map(Bar::length_m).sum();
    let longest = bars.iter().map(Bar::length_m).fold(0.0, f64::max);
    let least = (2.0 * longest - total).max(0.0);
    let span = least + (total - least) * random.random_range(0.05..0.95);
    let azimuth: f64 = random.random_range(-PI..PI);
    let height: f64 = if vertical { -1.0 } else { random.random_range(-0.99..0.99) };
    let level = (1.0 - height * height).sqrt();
    let end_m = [span * level * azimuth.cos(), span * level * azimuth.sin(), span * height];
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    Problem::new(Chain::new("random", 9.81, anchors, bars).unwrap()).unwrap()
}

/// Three uniform angles for each bar.
pub fn spatial_seed(random: &mut ChaCha8Rng, bars: usize) -> Seed {
    Seed::spatial((0..bars).map(|_| [0; 3].map(|_| random.random_range(-PI..PI))).collect())
}

/// The paper's planar choice with uniform φ.
pub fn planar_seed(random: &mut ChaCha8Rng, bars: usize) -> Seed {
    Seed::planar(&(0..bars).map(|_| random.random_range(-PI..PI)).collect::<Vec<_>>())
}

/// A vector of numbers between −3 and 3.
pub fn vector(random: &mut ChaCha8Rng, size: usize) -> DVector<f64> {
    DVector::from_fn(size, |_, _| random.random_range(-3.0..3.0))
}

/// Largest difference of two lists of vectors.
pub fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |largest, next| if next <= largest { largest } else { next })
}
