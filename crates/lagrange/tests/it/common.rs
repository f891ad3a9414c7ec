//! Random chains, seeds and states for the tests.

use std::f64::consts::PI;

use lagrange::Seed;
use model::{Anchors, Chain, Problem};
use nalgebra::DVector;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use samples::{General, Line};

/// mg of the paper's example, N; mgl is the same number of J.
pub const MG: f64 = 9.806_65;

/// Random number stream `index` of a test.
pub fn stream(seed: u64, index: usize) -> ChaCha8Rng {
    samples::stream(seed, index as u64)
}

/// A chain of random bars with anchors anywhere, closed or not: for formulas, not for solves.
pub fn any_chain(random: &mut ChaCha8Rng, count: usize) -> Chain {
    let mut point = || std::array::from_fn(|_| random.random_range(-1.0..1.0));
    let anchors = Anchors { start_m: point(), end_m: point() };
    Chain::new("any", 9.81, anchors, General::default().bars(random, count)).unwrap()
}

/// A chain of random bars that closes; on one vertical if asked.
pub fn problem(random: &mut ChaCha8Rng, count: usize, vertical: bool) -> Problem {
    let line = if vertical { Line::Vertical } else { Line::Any };
    General { line, ..General::default() }.problem(random, count)
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
