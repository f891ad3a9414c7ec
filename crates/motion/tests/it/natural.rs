//! The pieces of the equations in natural coordinates against dual numbers.

use model::Bar;
use motion::EndInertia;
use num_dual::{DualNum, HyperDual64};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Kinetic energy along one axis of point masses on a straight member with the end velocities `v`.
fn energy<D: DualNum<f64> + Copy>(masses: &[(f64, f64)], v: [D; 2]) -> D {
    masses.iter().fold(D::from(0.0), |sum, &(fraction, mass)| {
        let velocity = v[0] * (1.0 - fraction) + v[1] * fraction;
        sum + velocity * velocity * (0.5 * mass)
    })
}

#[test]
fn the_inertia_of_the_ends_is_the_second_derivative_of_the_kinetic_energy() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for _ in 0..100 {
        let length_m = rng.random_range(0.2..3.0);
        let masses: Vec<(f64, f64)> =
            (0..4).map(|_| (rng.random_range(0.0..1.0), rng.random_range(0.1..2.0))).collect();
        let mass: f64 = masses.iter().map(|(_, m)| m).sum();
        let centre: f64 = masses.iter().map(|(s, m)| s * m).sum::<f64>() / mass * length_m;
        let moment = |(s, m): &(f64, f64)| m * (s * length_m - centre).powi(2);
        let j: f64 = masses.iter().map(moment).sum();
        let bar = Bar::new(length_m, mass, centre, [0.0, j, j]).unwrap();
        let found = EndInertia::new(&bar);
        let second = |first: usize, other: usize| {
            let unit = |k: usize, wanted: usize| if k == wanted { 1.0 } else { 0.0 };
            let v = [0, 1].map(|k| HyperDual64::new(0.3, unit(k, first), unit(k, other), 0.0));
            energy(&masses, v).eps1eps2
        };
        for (found, told) in
            [(found.from, second(0, 0)), (found.between, second(0, 1)), (found.to, second(1, 1))]
        {
            assert!((found - told).abs() < 1e-13 * mass, "{found} {told}");
        }
    }
}
