//! The minimiser against the census of signs, the scalar minimiser, and itself.

use std::f64::consts::TAU;

use model::{Ends, Finish, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::{General, Line};

use super::piece::direction;
use super::{Batch, BatchSettings};
use crate::minimise::minimise_from;
use crate::seed::Seed;
use crate::settings::{Motion, Settings};

fn random_problem(rng: &mut ChaCha8Rng, bars: usize) -> Problem {
    let line = Line::PlaneOyz;
    General { centre: 0.2..0.8, span: 0.2..0.8, line, ..General::default() }.problem(rng, bars)
}

fn solved(problem: &Problem, angles: &[f64]) -> Ends {
    let mut ends = Ends::default();
    Batch::new(problem, BatchSettings::default()).unwrap().minimise(angles, &mut ends);
    ends
}

fn random_angles(rng: &mut ChaCha8Rng, count: usize) -> Vec<f64> {
    (0..count).map(|_| rng.random_range(0.0..TAU)).collect()
}

#[test]
fn directions_are_those_of_the_library() {
    for step in 0..10_000_u32 {
        let angle = (f64::from(step) - 5e3) * 0.01;
        let [x, z] = direction(angle);
        assert!((x - angle.sin()).abs() < 2e-14 && (z + angle.cos()).abs() < 2e-14, "{angle}");
    }
}

#[test]
fn every_seed_of_the_paper_slides_into_its_minimum() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let ends = solved(&model::cases::paper(), &random_angles(&mut rng, 30_000));
    for (finish, v) in ends.finish.iter().zip(&ends.energy_j) {
        assert_eq!(*finish, Finish::Converged);
        // 40-digit root finding; E1 and its mirror image have the same energy.
        assert!((v / 9.80665 + 6.0 - 2.335_468_651_999_305).abs() < 1e-13);
    }
}

/// The scalar minimiser goes another way, but its minima are minima of the same energy.
#[test]
fn the_minima_are_those_of_the_scalar_minimiser() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let settings = Settings { motion: Motion::Plane, ..Default::default() };
    for bars in [3, 4, 5, 6, 7] {
        let problem = random_problem(&mut rng, bars);
        let angles = random_angles(&mut rng, 300 * bars);
        let ends = solved(&problem, &angles);
        assert!(ends.finish.iter().all(|finish| *finish == Finish::Converged), "{bars} bars");
        for (u, v) in ends.directions.chunks(bars).zip(&ends.energy_j).take(60) {
            // The scalar solver stays at a minimum that it is given.
            let phi: Vec<f64> = u.iter().map(|u| u[0].atan2(-u[1])).collect();
            let seed = Seed::angles(&problem, &phi).unwrap();
            let stays = minimise_from(&problem, &seed, &settings).unwrap().equilibrium.energy_j;
            assert!((stays - v).abs() < 1e-12 * problem.chain().total_mass_kg() * 9.81 * 10.0);
        }
    }
}

#[test]
fn a_seed_ends_the_same_whatever_its_neighbours() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let problem = random_problem(&mut rng, 4);
    let angles = random_angles(&mut rng, 4 * 200);
    let together = solved(&problem, &angles);
    for seed in 0..200 {
        let alone = solved(&problem, &angles[4 * seed..4 * (seed + 1)]);
        assert_eq!(alone.finish[0], together.finish[seed]);
        assert_eq!(alone.iterations[0], together.iterations[seed]);
        assert_eq!(alone.energy_j[0].to_bits(), together.energy_j[seed].to_bits());
        assert_eq!(alone.residual[0].to_bits(), together.residual[seed].to_bits());
    }
}

#[test]
fn bad_and_straight_seeds() {
    let problem = model::cases::paper();
    let ends = solved(&problem, &[f64::NAN, 0.0, 1.0, 0.3, 0.7, -1.3, 1.0, f64::INFINITY, 1.0]);
    assert_eq!(ends.finish, [Finish::NonFinite, Finish::Converged, Finish::NonFinite]);
    // Parallel bars cannot close to first order; E2 is stationary and a maximum.
    let e2 = [73.920_588_792_231_34_f64, -38.599_136_184_451_89, -19.694_867_976_133_02]
        .map(f64::to_radians);
    let ends = solved(&problem, &[[0.0; 3], [TAU / 2.0; 3], [1.0; 3], e2].concat());
    assert_eq!(ends.finish, [Finish::Converged; 4]);
    assert!(solved(&problem, &[]).finish.is_empty());
}
