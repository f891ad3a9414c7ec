//! The batch against the crate's own full system.

use std::f64::consts::{FRAC_PI_2, TAU};

use model::{Bar, Ends, Finish, Problem};
use nalgebra::{DMatrix, DVector, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::{General, Line};

use super::kernel::{Common, State, step};
use super::lanes::{LANES, Lanes};
use super::numbers::Numbers;
use super::{Batch, BatchSettings};
use crate::full::Seed;
use crate::full::Solver;
use crate::full::mechanism::{Mechanism, Units};
use crate::full::multipliers::all_multipliers;
use crate::settings::Settings;

/// A chain of random bars with its anchors in the plane OYZ.
fn random_problem(rng: &mut ChaCha8Rng, bars: usize) -> Problem {
    let line = Line::PlaneOyz;
    General { centre: 0.2..0.8, span: 0.2..0.8, line, ..General::default() }.problem(rng, bars)
}

/// The rows and columns of the full system that a chain in the plane OYZ has: Y, Z and φ of each
/// bar, the second and third multiplier of each joint.
fn planar(bars: usize) -> Vec<usize> {
    let coordinates = (0..bars).flat_map(|bar| [6 * bar + 1, 6 * bar + 2, 6 * bar + 5]);
    let joints =
        (0..=bars).flat_map(move |joint| [6 * bars + 3 * joint + 1, 6 * bars + 3 * joint + 2]);
    coordinates.chain(joints).collect()
}

#[test]
fn one_step_is_that_of_the_full_system() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut worst = 0.0_f64;
    for trial in 0..200 {
        let bars = 2 + trial % 6;
        let problem = random_problem(&mut rng, bars);
        let mechanism = Mechanism::scaled(problem.chain(), Units::total(problem.chain()));
        let phi: Vec<f64> = (0..bars).map(|_| rng.random_range(0.0..TAU)).collect();
        let pull = [rng.random_range(-2.0..2.0), rng.random_range(-2.0..2.0)];

        // The full system, Jacobian and all: centres anywhere, multipliers that carry the weights.
        let mut q = DVector::zeros(6 * bars);
        for (bar, phi) in phi.iter().enumerate() {
            for k in 1..3 {
                q[6 * bar + k] = rng.random_range(-1.0..1.0);
            }
            (q[6 * bar + 4], q[6 * bar + 5]) = (FRAC_PI_2, *phi);
        }
        let lambda = all_multipliers(&mechanism, &Vector3::new(0.0, pull[0], pull[1]));
        let residual = crate::full::system::residual_of(&mechanism, &q, &lambda);
        let jacobian = crate::full::system::jacobian_of(&mechanism, &q, &lambda);
        let rows = planar(bars);
        let matrix = DMatrix::from_fn(rows.len(), rows.len(), |i, j| jacobian[(rows[i], rows[j])]);
        let right = DVector::from_fn(rows.len(), |i, _| -residual[rows[i]]);
        let condition = {
            let values = matrix.clone().svd(false, false).singular_values;
            values.max() / values.min()
        };
        let full = matrix.full_piv_lu().solve(&right).unwrap();
        let expected: Vec<f64> = (0..bars).map(|bar| full[3 * bar + 2]).collect();
        let expected_pull = [-full[3 * bars], -full[3 * bars + 1]];
        if expected.iter().any(|turn| turn.abs() > 1.0) {
            // The batch would shorten it.
            continue;
        }

        let numbers = Numbers::of(&problem);
        let mut states = vec![State::ZERO; bars];
        for (state, phi) in states.iter_mut().zip(&phi) {
            state.angle = Lanes::all(*phi);
        }
        // Not the first step, at which the multipliers would be estimated.
        let mut common = Common {
            pull: pull.map(Lanes::all),
            pull_before: [Lanes::ZERO; 2],
            count: [1; LANES],
            far: [true; LANES],
        };
        step(&numbers.bars, numbers.span, 1e-13, &mut states, &mut common);
        let size = full.amax().max(1.0) * condition * f64::EPSILON;
        for lane in 0..LANES {
            for ((state, phi), turn) in states.iter().zip(&phi).zip(&expected) {
                worst = worst.max((state.angle.0[lane] - phi - turn).abs() / size);
            }
            for ((now, before), change) in common.pull.iter().zip(pull).zip(expected_pull) {
                worst = worst.max((now.0[lane] - before - change).abs() / size);
            }
        }
    }
    // In units of the rounding error times the condition of the full planar matrix.
    assert!(worst < 4.0, "{worst}");
}

/// Every seed through the batch; equilibria as directions, without the doubles.
fn reached(problem: &Problem, angles: &[f64]) -> (Vec<Vec<[f64; 2]>>, usize) {
    let batch = Batch::new(problem, BatchSettings::default()).unwrap();
    let mut ends = Ends::default();
    batch.solve(angles, &mut ends);
    let bars = batch.bars();
    let mut list: Vec<Vec<[f64; 2]>> = vec![];
    let mut failed = 0;
    for (finish, u) in ends.finish.iter().zip(ends.directions.chunks(bars)) {
        if *finish != Finish::Converged {
            failed += 1;
        } else if !list.iter().any(|other| distance(other, u) < 1e-8) {
            list.push(u.to_vec());
        }
    }
    (list, failed)
}

fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max)
}

/// The scalar solver needs seconds for these, and is the reference.
#[test]
fn the_equilibria_reached_are_those_of_the_scalar_solver() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for bars in [3, 3, 4] {
        let problem = random_problem(&mut rng, bars);
        let angles: Vec<f64> = (0..2000 * bars).map(|_| rng.random_range(0.0..TAU)).collect();
        let (batch, failed) = reached(&problem, &angles);
        let mut scalar: Vec<Vec<[f64; 2]>> = vec![];
        let mut solver = Solver::new(&problem, &Settings::default()).unwrap();
        for phi in angles.chunks(bars).take(400) {
            let Ok(found) = solver.solve(&Seed::planar(phi)) else { continue };
            let joints = found.solution().unwrap().equilibrium.joints_m;
            let lengths = problem.chain().bars().iter().map(Bar::length_m);
            let u: Vec<[f64; 2]> = joints
                .windows(2)
                .zip(lengths)
                .map(|(pair, l)| [(pair[1][1] - pair[0][1]) / l, (pair[1][2] - pair[0][2]) / l])
                .collect();
            if !scalar.iter().any(|other| distance(other, &u) < 1e-8) {
                scalar.push(u);
            }
        }
        assert_eq!(batch.len(), scalar.len(), "{bars} bars");
        for u in &batch {
            assert!(scalar.iter().any(|other| distance(other, u) < 1e-8));
        }
        assert!(failed * 100 <= 2000, "{failed} of 2000 failed");
    }
}

#[test]
fn a_seed_ends_the_same_whatever_its_neighbours() {
    samples::assert_seeds_are_alone(|problem, angles, ends| {
        Batch::new(problem, BatchSettings::default()).unwrap().solve(angles, ends);
    });
}

#[test]
fn all_random_seeds_of_the_paper_lead_to_its_four_equilibria() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let angles: Vec<f64> = (0..3 * 20_000).map(|_| rng.random_range(0.0..TAU)).collect();
    let (list, failed) = reached(&model::cases::paper(), &angles);
    assert_eq!((list.len(), failed), (4, 0));
}

/// Seeds of long chains, most of which Newton's method alone does not bring to an end: all lead to
/// equilibria, by the paper's own equations, and to many different ones.
#[test]
fn seeds_of_long_chains_lead_to_equilibria() {
    const SEEDS: usize = 100;
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for (bars, end_m, different) in [
        (15, [0.0, 0.88, 0.0], 2),
        (30, [0.0, 0.88, 0.0], 10),
        (60, [0.0, 0.88, 0.0], 40),
        (60, [0.0, 0.5, -0.3], 90),
        (200, [0.0, 0.7, 0.1], 90),
    ] {
        let n = usize::try_from(bars).unwrap();
        let problem = samples::homogeneous(9.81, &vec![(1.0 / f64::from(bars), 1.0); n], end_m);
        let batch = Batch::new(&problem, BatchSettings::default()).unwrap();
        let angles: Vec<f64> = (0..SEEDS * n).map(|_| rng.random_range(0.0..TAU)).collect();
        let mut ends = Ends::default();
        batch.solve(&angles, &mut ends);
        let converged = ends.finish.iter().filter(|finish| **finish == Finish::Converged).count();
        assert_eq!(converged, SEEDS, "{bars} bars");
        assert!(ends.residual.iter().all(|residual| *residual <= 1e-13), "{bars} bars");
        let mut patterns: Vec<u64> = ends.energy_j.iter().map(|v| (v * 1e9).to_bits()).collect();
        patterns.sort_unstable();
        patterns.dedup_by_key(|bits| (f64::from_bits(*bits) / 10.0).round().to_bits());
        assert!(patterns.len() >= different, "{bars} bars: {} energies", patterns.len());
        // In space, three angles a bar, from where the batch ended: the solver stays.
        let mut solver = Solver::new(&problem, &Settings::default()).unwrap();
        for u in ends.directions.chunks(n).take(5) {
            let directions: Vec<[f64; 3]> = u.iter().map(|u| [0.0, u[0], u[1]]).collect();
            let found = solver.solve(&Seed::directions(&directions)).unwrap();
            assert!(found.effort().iterations <= 4, "{:?}", found.effort());
        }
    }
}

#[test]
fn a_seed_that_is_no_number_fails_alone() {
    let batch = Batch::new(&model::cases::paper(), BatchSettings::default()).unwrap();
    let mut ends = Ends::default();
    batch.solve(&[f64::NAN, 0.0, 1.0, 0.3, 0.7, -1.3, 1.0, f64::INFINITY, 1.0], &mut ends);
    assert_eq!(ends.finish, [Finish::NonFinite, Finish::Converged, Finish::NonFinite]);
    batch.solve(&[], &mut ends);
    assert!(ends.finish.is_empty() && ends.directions.is_empty());
}

#[test]
fn parallel_bars_are_no_obstacle() {
    // All bars along one line: the matrix of the step is singular.
    let batch = Batch::new(&model::cases::paper(), BatchSettings::default()).unwrap();
    let mut ends = Ends::default();
    batch.solve(&[[0.0; 3], [0.5; 3], [TAU / 2.0; 3]].concat(), &mut ends);
    assert_eq!(ends.finish, [Finish::Converged; 3]);
}
