//! The minimiser against the census of signs, the scalar minimiser, and itself.

use std::f64::consts::TAU;

use model::{Ends, Finish, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::{General, Line};

use super::control::{Lane, Next};
use super::piece::{Piece, direction};
use super::point::{Place, measure, slopes};
use super::wide::{WIDTH, same};
use super::{Batch, BatchSettings};
use crate::run::Seed;
use crate::run::minimise_from;
use crate::run::{Motion, Settings};

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

/// A bar of 1 m and 1 kg hangs, and three without mass bear nothing: rounding pushes some of them as
/// often as it pulls them, and that is a minimum all the same, in nine of ten seeds at the first go.
#[test]
fn slack_bars_are_no_saddle() {
    let bars = [1.0, 0.0, 0.0, 0.0].map(|mass| (1.0, mass));
    let problem = samples::homogeneous(10.0, &bars, [0.0, 1.2, -1.0]);
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let ends = solved(&problem, &random_angles(&mut rng, 4 * 500));
    let converged = |k: &usize| ends.finish[*k] == Finish::Converged;
    let minima: Vec<usize> = (0..500).filter(converged).collect();
    assert!(minima.len() >= 425, "{} of 500", minima.len());
    // Its middle is 0.5 m deep.
    assert!(minima.iter().all(|k| (ends.energy_j[*k] + 5.0).abs() < 1e-11));
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
    samples::assert_seeds_are_alone(|problem, angles, ends| *ends = solved(problem, angles));
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

/// Bars along (0.6, 0.8): their tangent parts are along (-0.8, 0.6).
#[test]
fn only_a_gap_along_the_bars_has_no_turn_that_closes_it() {
    let spread = [0.64, -0.48, 0.36];
    for size in [1e-9, 1.0, 1e3] {
        let at = |gap: [f64; 2]| {
            let gap = gap.map(|x| size * x);
            super::control::parallel(spread, gap, gap[0] * gap[0] + gap[1] * gap[1])
        };
        assert!(at([0.6, 0.8]) && at([-0.6, -0.8]));
        assert!(!at([-0.8, 0.6]) && !at([1.0, 0.0]) && !at([0.0, 1.0]) && !at([0.6, -0.8]));
        // An angle of 1e-5 rad is enough: 1e-10 of the square of the gap.
        assert!(!at([0.6 - 0.8e-5, 0.8 + 0.6e-5]) && at([0.6 - 0.8e-7, 0.8 + 0.6e-7]));
    }
}

/// Three bars have one motion that keeps the gap, whose turns follow from its two equations; a
/// minimum is where the sum of `l N` times the squares of the turns is positive. Turned at that
/// rate the energy less the closing force times the way changes by the slopes.
#[test]
fn curvature_of_three_bars_is_that_of_their_one_motion() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut counts = [0; 2];
    for _ in 0..500 {
        let list: Vec<Piece> = (0..3)
            .map(|_| Piece {
                length: rng.random_range(0.1..0.5),
                lifted: rng.random_range(-1.0..1.0),
            })
            .collect();
        let at = |phi: &[f64; 3]| -> Vec<Place> {
            let place =
                |phi: &f64| Place { x: same(phi.sin()), z: same(-phi.cos()), ..Place::ZERO };
            phi.iter().map(place).collect()
        };
        let phi: [f64; 3] = std::array::from_fn(|_| rng.random_range(0.0..TAU));
        let mut places = at(&phi);
        let sums = measure(&list, [0.0; 2], &places);
        let found = slopes(&list, &sums, &[true; WIDTH], &mut places);
        // The turns solve sum l t turn = 0, t = (cos, sin): a vector product.
        let row =
            |f: fn(f64) -> f64| -> [f64; 3] { std::array::from_fn(|i| list[i].length * f(phi[i])) };
        let (a, b) = (row(f64::cos), row(f64::sin));
        let turn: [f64; 3] = std::array::from_fn(|i| {
            a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]
        });
        // The multiplier that makes the slopes least, from its normal equations.
        let (mut m, mut r) = ([0.0; 3], [0.0; 2]);
        for (piece, phi) in list.iter().zip(&phi) {
            let (s, c) = phi.sin_cos();
            m = [
                m[0] + piece.length * c * c,
                m[1] + piece.length * c * s,
                m[2] + piece.length * s * s,
            ];
            r = [
                r[0] + piece.length * piece.lifted * s * c,
                r[1] + piece.length * piece.lifted * s * s,
            ];
        }
        let det = m[0] * m[2] - m[1] * m[1];
        let mu = [-(m[2] * r[0] - m[1] * r[1]) / det, -(m[0] * r[1] - m[1] * r[0]) / det];
        let axial = |i: usize| {
            let (s, c) = phi[i].sin_cos();
            (list[i].lifted + mu[1]) * c - mu[0] * s
        };
        let curvature: f64 = (0..3).map(|i| list[i].length * axial(i) * turn[i] * turn[i]).sum();
        if curvature.abs() < 1e-6 || det < 1e-4 {
            continue;
        }
        for lane in [0, WIDTH - 1] {
            assert_eq!(found.convex[lane], curvature > 0.0, "{phi:?} {list:?}");
        }
        counts[usize::from(curvature > 0.0)] += 1;
        let slope = |i: usize| {
            let (s, c) = phi[i].sin_cos();
            (list[i].lifted + mu[1]) * s + mu[0] * c
        };
        let largest = (0..3).map(|i| list[i].length * slope(i).abs()).fold(0.0, f64::max);
        let unit = mu[0].hypot(mu[1]).max(1.0) / 3.0;
        assert!((found.largest[0] * unit / largest - 1.0).abs() < 1e-9);
        if found.convex[0] {
            // Newton's step goes down, and stops where its model is least.
            let along: f64 = (0..3).map(|i| list[i].length * slope(i) * turn[i]).sum();
            let step = -along / curvature;
            let most = turn.iter().fold(0.0_f64, |most, turn| most.max((step * turn).abs()));
            assert!((found.largest_turn[0] / most - 1.0).abs() < 1e-6);
            assert!((found.fall[0] / (step * along) - 1.0).abs() < 1e-6);
        }
    }
    assert!(counts.iter().all(|count| *count > 50), "{counts:?}");
}

/// What a seed takes is enough; one pass fewer is not.
#[test]
fn the_limit_of_iterations_is_the_last_that_is_made() {
    let problem = model::cases::paper();
    let angles = [0.3, 0.7, -1.3];
    let passes = solved(&problem, &angles).iterations[0];
    for (max_iterations, finish) in
        [(passes, Finish::Converged), (passes - 1, Finish::IterationLimit)]
    {
        let settings =
            BatchSettings { max_iterations: u32::from(max_iterations), ..Default::default() };
        let mut ends = Ends::default();
        Batch::new(&problem, settings).unwrap().minimise(&angles, &mut ends);
        assert_eq!(ends.finish, [finish]);
    }
}

#[test]
fn a_lane_gives_up_after_its_halvings_and_its_perturbations() {
    let mut lane = Lane::new(0);
    let settings = BatchSettings::default();
    // The whole step, then ever smaller halves.
    let first = lane.accepted(&settings, 1.0, true, 0.35, -1.0);
    assert_eq!(first, Next::Step(1.0));
    for k in 1..=64 {
        assert_eq!(lane.halve(), Next::Step(0.5_f64.powi(k)));
    }
    assert_eq!(lane.halve(), Next::Stalled);
    // A step is cut to a turn of 0.7 rad.
    assert_eq!(lane.accepted(&settings, 1.0, true, 1.4, -1.0), Next::Step(0.5));
    for k in 1..=8 {
        assert_eq!(lane.perturb(), Next::Perturb(0.01 * f64::from(k)));
    }
    assert_eq!(lane.perturb(), Next::Stalled);
}

/// Where the slope is zero to the tolerance: a minimum whose step turns bars goes on, for 64
/// steps and not where the step does not go down; what is no minimum is perturbed.
#[test]
fn minima_settle() {
    let settings = BatchSettings::default();
    let here = |lane: &mut Lane, convex, turn, fall| {
        lane.accepted(&settings, settings.tolerance, convex, turn, fall)
    };
    let mut lane = Lane::new(0);
    for _ in 0..64 {
        assert_eq!(here(&mut lane, true, 1e-8, -1e-20), Next::Step(1.0));
    }
    assert_eq!(here(&mut lane, true, 1e-8, -1e-20), Next::Minimum);
    for (turn, fall) in [(1e-10, -1e-20), (1e-8, 0.0), (1e-8, 1e-20), (f64::INFINITY, -1.0)] {
        assert_eq!(here(&mut Lane::new(0), true, turn, fall), Next::Minimum);
    }
    assert_eq!(here(&mut Lane::new(0), false, 1e-8, -1e-20), Next::Perturb(0.01));
    // One that settles is a minimum, though rounding no longer shows it.
    let mut lane = Lane::new(0);
    assert_eq!(here(&mut lane, true, 1e-8, -1e-20), Next::Step(1.0));
    assert_eq!(here(&mut lane, false, 1e-10, -1e-20), Next::Minimum);
    let mut lane = Lane::new(0);
    assert_eq!(lane.accepted(&settings, f64::NAN, true, 0.1, -1.0), Next::NonFinite);
    assert_eq!(lane.accepted(&settings, 1.0, true, f64::NAN, -1.0), Next::Perturb(0.01));
}
