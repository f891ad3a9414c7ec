//! What a batch of seeds is held to, whoever solves it.

use std::f64::consts::TAU;

use model::{Ends, Problem};
use rand::RngExt;

use crate::{General, scaled_chain, stream};

fn bits(numbers: &[f64], factor: f64) -> Vec<u64> {
    numbers.iter().map(|x| (factor * x).to_bits()).collect()
}

/// Times these powers of two of lengths, masses and gravity every seed ends the same, digit for digit.
pub fn assert_batches_scale(factors: &[[f64; 3]], solve: impl Fn(&Problem, &[f64], &mut Ends)) {
    for bars in [2, 3, 6, 9, 16] {
        let mut random = stream(82, bars as u64);
        let base = General::default().problem(&mut random, bars);
        let angles: Vec<f64> = (0..24 * bars).map(|_| random.random_range(0.0..TAU)).collect();
        let (mut one, mut other) = (Ends::default(), Ends::default());
        solve(&base, &angles, &mut one);
        for factors in factors {
            solve(&scaled_chain(&base, *factors), &angles, &mut other);
            let energy = factors.iter().product();
            assert_eq!(bits(&one.energy_j, energy), bits(&other.energy_j, 1.0));
            assert_eq!(bits(&one.residual, 1.0), bits(&other.residual, 1.0));
            assert_eq!(
                (&one.finish, &one.iterations, &one.directions),
                (&other.finish, &other.iterations, &other.directions)
            );
        }
    }
}

/// A seed ends the same whatever its neighbours.
pub fn assert_seeds_are_alone(solve: impl Fn(&Problem, &[f64], &mut Ends)) {
    let mut random = stream(83, 0);
    for problem in [model::cases::paper(), General::default().problem(&mut random, 4)] {
        let bars = problem.chain().bars().len();
        let angles: Vec<f64> = (0..200 * bars).map(|_| random.random_range(0.0..TAU)).collect();
        let (mut together, mut alone) = (Ends::default(), Ends::default());
        solve(&problem, &angles, &mut together);
        for (seed, angles) in angles.chunks(bars).enumerate() {
            solve(&problem, angles, &mut alone);
            assert_eq!(alone.finish[0], together.finish[seed]);
            assert_eq!(alone.iterations[0], together.iterations[seed]);
            assert_eq!(alone.energy_j[0].to_bits(), together.energy_j[seed].to_bits());
            assert_eq!(alone.residual[0].to_bits(), together.residual[seed].to_bits());
        }
    }
}
