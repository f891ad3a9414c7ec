//! Lengths, masses and gravity times powers of two: not a digit of an answer changes. So a number
//! in some unit that is added to one in another is noticed, whatever its size.

use lagrange::batch::{Batch, BatchSettings};
use lagrange::condensed;
use lagrange::net::{self, Solution};
use lagrange::{Settings, solve, solve_from};
use model::cases::Case;
use model::system::{Kind, System};
use model::{Problem, Vector};
use samples::scaled_chain;

use crate::common::{problem, spatial_seed, stream};
use crate::net_random::random;
use crate::net_work::above_a_floor;

/// Two to this power.
const fn two(power: i64) -> f64 {
    f64::from_bits((1023 + power).cast_unsigned() << 52)
}

/// Powers of two by which lengths, masses and gravity are multiplied.
const FACTORS: [[f64; 3]; 4] =
    [[1024.0, 1.0, 1.0], [1.0, 0.0625, 1.0], [0.125, 64.0, 0.25], [two(-30), two(40), two(-20)]];
/// Where a force is sought by its logarithm, a factor of forces is a sum that rounds.
const LENGTHS: [[f64; 3]; 3] = [[1024.0, 1.0, 1.0], [0.03125, 1.0, 1.0], [two(60), 1.0, 1.0]];

fn times(vectors: &[Vector], factor: f64) -> Vec<Vector> {
    vectors.iter().map(|vector| vector.map(|x| factor * x)).collect()
}

fn each(numbers: &[f64], factor: f64) -> Vec<f64> {
    numbers.iter().map(|x| factor * x).collect()
}

fn assert_scaled(one: &model::Equilibrium, other: &model::Equilibrium, factors: [f64; 3]) {
    let [length, mass, gravity] = factors;
    let force = mass * gravity;
    assert_eq!(times(&one.joints_m, length), other.joints_m);
    assert_eq!(times(&one.multipliers_n, force), other.multipliers_n);
    assert_eq!(each(&one.axial_n, force), other.axial_n);
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
        let solved = |problem: &Problem| {
            let settings = Settings::default();
            [solve_from(problem, &seed, &settings), solve(problem, &settings)]
        };
        let ones = solved(&base);
        for factors in FACTORS {
            for (one, other) in ones.iter().zip(&solved(&scaled_chain(&base, factors))) {
                match (one, other) {
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
}

#[test]
fn batches_scale_without_rounding() {
    samples::assert_batches_scale(&FACTORS, |problem, angles, ends| {
        let settings = BatchSettings { max_iterations: 60, ..BatchSettings::default() };
        Batch::new(problem, settings).unwrap().solve(angles, ends);
    });
}

fn assert_system_scaled(one: &Solution, other: &Solution, [length, mass, gravity]: [f64; 3]) {
    let force = mass * gravity;
    assert_eq!(one.factorisations, other.factorisations);
    assert_eq!((&one.slack, &one.limp, one.forces), (&other.slack, &other.limp, other.forces));
    assert_eq!(one.mechanisms, other.mechanisms);
    let (one, other) = (&one.equilibrium, &other.equilibrium);
    assert_eq!(times(&one.joints_m, length), other.joints_m);
    assert_eq!(times(&one.reactions_n, force), other.reactions_n);
    assert_eq!(each(&one.axial_n, force), other.axial_n);
    assert_eq!((one.energy_j * force * length).to_bits(), other.energy_j.to_bits());
    assert_eq!(one.stability, other.stability);
}

#[test]
fn systems_scale_without_rounding() {
    let kinds = [Kind::Bar, Kind::Cable, Kind::Strut];
    let random =
        (3000..3024).enumerate().map(|(k, seed)| random(seed, &kinds[..=k % 3], k % 2 == 0));
    let mut systems: Vec<System> = random.collect();
    systems.extend(model::cases::systems().map(Case::system));
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

/// Numbers whose products are near the end of doubles, masses far too small for their cubes: the same shape and forces.
#[test]
fn numbers_near_the_end_of_doubles_hang_alike() {
    let factors =
        [[1.0, two(-400), 1.0], [two(-332), two(332), two(30)], [two(299), two(-498), two(-30)]];
    let solved = |problem: &Problem| {
        condensed::solve(problem, &condensed::Settings::default()).unwrap().equilibrium
    };
    for (k, factors) in (0..20).flat_map(|k| factors.map(|factors| (k, factors))) {
        let base = problem(&mut stream(83, k), 2 + k % 9, false);
        let (one, other) = (solved(&base), solved(&scaled_chain(&base, factors)));
        let [length, mass, gravity] = factors;
        let total_m = base.chain().total_length_m();
        for (a, b) in times(&one.joints_m, length).iter().zip(&other.joints_m) {
            assert!((0..3).all(|x| (a[x] - b[x]).abs() < 1e-14 * total_m * length), "{a:?} {b:?}");
        }
        let forces_n = one.axial_n.iter().zip(&other.axial_n);
        let scale = one.axial_n.iter().fold(0.0_f64, |most, n| most.max(n.abs()));
        for (a, b) in forces_n {
            assert!((a - b / (mass * gravity)).abs() < 1e-13 * scale, "{a} {b}");
        }
        assert_eq!(one.stability, other.stability);
    }
}

/// A floor pushes what weighs next to nothing as it does what is heavy.
#[test]
fn floors_push_small_weights() {
    let factors = [1.0, two(-60), 1.0];
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
