//! Lengths, masses and gravity times powers of two: not a digit of an answer changes. So a number
//! in some unit that is added to one in another is noticed, whatever its size.

use lagrange::batch::{Batch, BatchSettings};
use lagrange::condensed;
use lagrange::net::{self, Solution};
use lagrange::{Settings, solve_from};
use model::cases::Exhibit;
use model::system::{Kind, System};
use model::{Ends, Problem, Vector};
use rand::RngExt;
use samples::scaled_chain;

use crate::common::{problem, spatial_seed, stream};
use crate::net_random::random;
use crate::net_work::above_a_floor;

/// Powers of two by which lengths, masses and gravity are multiplied.
const FACTORS: [[f64; 3]; 3] = [[1024.0, 1.0, 1.0], [1.0, 0.0625, 1.0], [0.125, 64.0, 0.25]];
/// Where a force is sought by its logarithm, a factor of forces is a sum that rounds.
const LENGTHS: [[f64; 3]; 2] = [[1024.0, 1.0, 1.0], [0.03125, 1.0, 1.0]];

/// The bits of a vector times a power of two.
fn bits(vector: Vector, factor: f64) -> [u64; 3] {
    times(vector, factor).map(f64::to_bits)
}

fn times(vector: Vector, factor: f64) -> Vector {
    vector.map(|x| x * factor)
}

#[track_caller]
fn assert_vectors(one: &[Vector], other: &[Vector], factor: f64) {
    for (a, b) in one.iter().zip(other) {
        assert_eq!(bits(*a, factor), bits(*b, 1.0));
    }
}

fn assert_scaled(one: &model::Equilibrium, other: &model::Equilibrium, factors: [f64; 3]) {
    let [length, mass, gravity] = factors;
    let force = mass * gravity;
    assert_vectors(&one.joints_m, &other.joints_m, length);
    assert_vectors(&one.multipliers_n, &other.multipliers_n, force);
    for (a, b) in one.axial_n.iter().zip(&other.axial_n) {
        assert_eq!((a * force).to_bits(), b.to_bits());
    }
    assert_eq!((one.energy_j * force * length).to_bits(), other.energy_j.to_bits());
    assert_eq!(one.stability, other.stability);
    assert_eq!(one.evidence.nullity, other.evidence.nullity);
    assert_eq!(one.evidence.iterations, other.evidence.iterations);
    assert_eq!(one.evidence.residual.to_bits(), other.evidence.residual.to_bits());
}

#[test]
fn hanging_chains_scale_without_rounding() {
    for k in 0..40 {
        let base = match k % 4 {
            0 => samples::folded_chain(k as u64),
            _ => problem(&mut stream(80, k), 2 + k % 9, k % 4 == 1),
        };
        let one = condensed::solve(&base, &condensed::Settings::default()).unwrap();
        for factors in LENGTHS {
            let other = scaled_chain(&base, factors);
            let other = condensed::solve(&other, &condensed::Settings::default()).unwrap();
            assert_eq!(one.pull.passes(), other.pull.passes());
            assert_scaled(&one.equilibrium, &other.equilibrium, factors);
        }
    }
}

#[test]
fn seeds_scale_without_rounding() {
    for k in 0..12 {
        let mut random = stream(81, k);
        let bars = 2 + k % 5;
        let base = problem(&mut random, bars, k % 3 == 0);
        let seed = spatial_seed(&mut random, bars);
        let one = solve_from(&base, &seed, &Settings::default());
        for factors in FACTORS {
            let other = solve_from(&scaled_chain(&base, factors), &seed, &Settings::default());
            match (&one, &other) {
                (Ok(one), Ok(other)) => {
                    assert_eq!(one.angles_rad, other.angles_rad);
                    assert_eq!(one.effort.iterations, other.effort.iterations);
                    assert_eq!(one.residual_history, other.residual_history);
                }
                (one, other) => assert_eq!(one, other),
            }
        }
    }
}

#[test]
fn batches_scale_without_rounding() {
    for bars in [2, 3, 6, 9, 16] {
        let mut random = stream(82, bars);
        let base = problem(&mut random, bars, false);
        let angles: Vec<f64> =
            (0..24 * bars).map(|_| random.random_range(0.0..std::f64::consts::TAU)).collect();
        let solved = |problem: &Problem| {
            let mut ends = Ends::default();
            let settings = BatchSettings { max_iterations: 60, ..BatchSettings::default() };
            Batch::new(problem, settings).unwrap().solve(&angles, &mut ends);
            ends
        };
        let one = solved(&base);
        for factors in FACTORS {
            let other = solved(&scaled_chain(&base, factors));
            assert_eq!(one.finish, other.finish);
            assert_eq!(one.iterations, other.iterations);
            assert_eq!(one.directions, other.directions);
            let [length, mass, gravity] = factors;
            for (a, b) in one.energy_j.iter().zip(&other.energy_j) {
                assert_eq!((a * length * mass * gravity).to_bits(), b.to_bits());
            }
        }
    }
}

fn assert_system_scaled(one: &Solution, other: &Solution, [length, mass, gravity]: [f64; 3]) {
    let force = mass * gravity;
    assert_eq!(one.factorisations, other.factorisations);
    assert_eq!((&one.slack, &one.limp, one.forces), (&other.slack, &other.limp, other.forces));
    assert_eq!(one.mechanisms, other.mechanisms);
    let (one, other) = (&one.equilibrium, &other.equilibrium);
    assert_vectors(&one.joints_m, &other.joints_m, length);
    assert_vectors(&one.reactions_n, &other.reactions_n, force);
    for (a, b) in one.axial_n.iter().zip(&other.axial_n) {
        assert_eq!((a * force).to_bits(), b.to_bits());
    }
    assert_eq!((one.energy_j * force * length).to_bits(), other.energy_j.to_bits());
    assert_eq!(one.stability, other.stability);
}

#[test]
fn systems_scale_without_rounding() {
    let kinds = [Kind::Bar, Kind::Cable, Kind::Strut];
    let random =
        (3000..3024).enumerate().map(|(k, seed)| random(seed, &kinds[..=k % 3], k % 2 == 0));
    let mut systems: Vec<System> = random.collect();
    systems.extend(model::cases::systems().map(Exhibit::system));
    systems.extend(samples::ropes().into_iter().map(|sample| sample.system));
    systems.push(samples::legs([1e-3, 2e-3, 3e-3, 4e-3]));
    let mut answers = 0;
    for system in systems {
        let one = net::solve(&system, &net::Settings::default());
        for factors in FACTORS {
            let other = samples::scaled(&system, factors);
            let other = net::solve(&other, &net::Settings::default());
            match (&one, &other) {
                (Ok(one), Ok(other)) => {
                    answers += 1;
                    assert_system_scaled(one, other, factors);
                }
                (one, other) => assert_eq!(one.is_ok(), other.is_ok(), "{}", system.name()),
            }
        }
    }
    assert!(answers > 120, "{answers}");
}

/// Masses far too small for their cubes: the same shape, digit for digit.
#[test]
fn masses_near_the_end_of_doubles_hang_alike() {
    let tiny = [1.0, f64::from_bits((1023 - 400) << 52), 1.0];
    for k in 0..20 {
        let base = problem(&mut stream(83, k), 2 + k % 9, false);
        let one = condensed::solve(&base, &condensed::Settings::default()).unwrap();
        let other = condensed::solve(&scaled_chain(&base, tiny), &condensed::Settings::default());
        let other = other.unwrap();
        let total_m = base.chain().total_length_m();
        for (a, b) in one.equilibrium.joints_m.iter().zip(&other.equilibrium.joints_m) {
            assert!((0..3).all(|x| (a[x] - b[x]).abs() < 1e-13 * total_m), "{a:?} {b:?}");
        }
        assert_eq!(one.equilibrium.stability, other.equilibrium.stability);
    }
}

/// A floor pushes what weighs next to nothing as it does what is heavy.
#[test]
fn floors_push_small_weights() {
    let factors = [1.0, f64::from_bits((1023 - 60) << 52), 1.0];
    let mut answers = 0;
    for seed in 3100..3112 {
        let system = random(seed, &[Kind::Cable], false);
        let on = |system| net::solve(&above_a_floor(system), &net::Settings::default());
        let other = on(samples::scaled(&system, factors));
        match (on(system), other) {
            (Ok(one), Ok(other)) => {
                answers += 1;
                assert_system_scaled(&one, &other, factors);
            }
            (one, other) => assert_eq!(one.is_ok(), other.is_ok()),
        }
    }
    assert!(answers > 4, "{answers}");
}
