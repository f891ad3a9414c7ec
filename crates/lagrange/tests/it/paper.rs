//! The paper's example: its equilibria, multipliers, energies and null spaces.
//!
//! Reference values: kind external, forty-digit root finding on the elimination of the example
//! (sextic in the cosine of theta), rounded to a double.

use std::f64::consts::{FRAC_PI_2, PI};

use lagrange::{Seed, Settings, Solution, relative_residual, solve, solve_from, spectrum};
use model::{InPlane, InSpace, cases};

use crate::common::MG;

/// Angles of E1 from the descending vertical, degrees.
const E1: [f64; 3] = [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34];
/// V of E1 and E2, mgl, counted as in the paper.
const V: [f64; 2] = [2.335_468_651_999_305, 3.664_531_348_000_695];
/// Horizontal multiplier of E1 and the four vertical ones, mg.
const H: f64 = 0.648_944_835_933_933_6;
const VERTICAL: [f64; 4] = [
    2.312_944_292_241_838, -1.312_944_292_241_838, -0.312_944_292_241_837_6,
    0.687_055_707_758_162_4,
];

/// Asked for are 1e-10 rad, 1e-10 mg and 1e-12 mgl. Worst measured: below 1e-15 in all four.
const ANGLE: f64 = 4e-15;
const FORCE: f64 = 4e-15;
const ENERGY: f64 = 4e-15;
/// Largest of the 30 equations, mg, mgl, l.
const RESIDUAL: f64 = 4e-15;

/// Angles from the descending vertical in the vertical plane of the bars, positive towards the
/// heading, rad. With anchors on one vertical the plane is any plane: only *OYZ* and *OXZ* stay
/// what they are.
fn planar_angles(found: &Solution, heading: f64) -> Vec<f64> {
    let joints = &found.equilibrium.joints_m;
    let first = joints[1][0].hypot(joints[1][1]);
    let (cos, sin) = (joints[1][0] / first, joints[1][1] / first);
    let towards = (cos * heading.cos() + sin * heading.sin()).signum();
    joints
        .windows(2)
        .map(|pair| {
            let d: [f64; 3] = std::array::from_fn(|k| pair[1][k] - pair[0][k]);
            assert!((d[1] * cos - d[0] * sin).abs() < ANGLE, "out of the plane: {d:?}");
            (towards * (d[0] * cos + d[1] * sin)).atan2(-d[2])
        })
        .collect()
}

/// E1, E1', E2, E2' as (angles, energy index): E2 is E1 upside down.
fn equilibria() -> [([f64; 3], usize); 4] {
    let [a, b, c] = E1.map(f64::to_radians);
    [([a, b, c], 0), ([-a, -b, -c], 0), ([-c, -b, -a], 1), ([c, b, a], 1)]
}

fn assert_is(found: &Solution, heading: f64, angles: [f64; 3], energy: usize) {
    for (got, expected) in planar_angles(found, heading).iter().zip(angles) {
        assert!((got - expected).abs() < ANGLE, "{got} instead of {expected}");
    }
    let v = found.equilibrium.energy_j / MG + 6.0;
    assert!((v - V[energy]).abs() < ENERGY, "V = {v} mgl");
    assert!(found.equilibrium.evidence.residual < RESIDUAL);
}

#[test]
fn multipliers_of_e1_have_the_papers_meaning_and_order() {
    let [e1, ..] = equilibria();
    let found = solve_from(&cases::paper(), &Seed::planar(&e1.0), &Settings::default()).unwrap();
    let horizontal = [-H, H, H, H];
    for (joint, (y, z)) in horizontal.iter().zip(VERTICAL).enumerate() {
        let expected = [0.0, *y, z];
        for (axis, expected) in expected.iter().enumerate() {
            let got = found.lambda[3 * joint + axis] / MG;
            assert!((got - expected).abs() < FORCE, "lambda {}: {got}", 3 * joint + axis + 1);
            let observable = found.equilibrium.multipliers_n[joint][axis] / MG;
            assert!((observable - expected).abs() < FORCE);
        }
    }
    let reactions = found.equilibrium.reactions_n;
    assert!((reactions.start[2] + reactions.end[2] - 3.0 * MG).abs() < FORCE * MG);
    // Bars 1 and 2 hang, bar 3 props.
    let signs: Vec<bool> = found.equilibrium.axial_n.iter().map(|force| *force > 0.0).collect();
    assert_eq!(signs, [true, true, false]);
}

#[test]
fn stability_of_the_four() {
    for (angles, energy) in equilibria() {
        let seed = Seed::planar(&angles);
        let found = solve_from(&cases::paper(), &seed, &Settings::default()).unwrap();
        let stability = found.equilibrium.stability;
        if energy == 0 {
            assert_eq!(
                (stability.in_plane, stability.in_space),
                (InPlane::Minimum, InSpace::Stable)
            );
        } else {
            assert_eq!((stability.in_plane, stability.index_in_plane), (InPlane::Maximum, 1));
            assert_eq!((stability.in_space, stability.index_in_space), (InSpace::Unstable, 2));
        }
    }
}

/// Nullity 4: three spins (or locked angles), and the turn about OD. At gimbal lock, theta = pi/2,
/// and away from it; in OYZ, in OXZ and in any vertical plane between.
#[test]
fn nullity_is_four_at_gimbal_lock_and_away_from_it() {
    let problem = cases::paper();
    for (angles, energy) in equilibria() {
        for heading in [0.0, 0.3, FRAC_PI_2, 2.0, PI, -1.0] {
            let seed = Seed::planar_towards(heading, &angles.map(|angle| angle + 0.02));
            let found = solve_from(&problem, &seed, &Settings::default()).unwrap();
            assert_is(&found, heading, angles, energy);
            assert_eq!((found.nullity, found.equilibrium.evidence.nullity), (4, 4));
        }
        // The paper's own choice, to the letter.
        let found = solve_from(&problem, &Seed::planar(&angles), &Settings::default()).unwrap();
        let [psi, theta, _] = found.angles_rad[0];
        assert!(psi.abs() < ANGLE && (theta - FRAC_PI_2).abs() < ANGLE, "left the lock");
        let spectrum = spectrum(problem.chain(), &found.q, &found.lambda).unwrap();
        assert_eq!((spectrum.singular_values.len(), spectrum.nullity), (30, 4));
        // Nothing near the threshold: a gap of ten orders of magnitude.
        assert!(spectrum.singular_values[25] > 1e-3, "{:?}", &spectrum.singular_values[25..]);
        assert!(spectrum.singular_values[26] < 1e-13, "{:?}", &spectrum.singular_values[25..]);
        assert!(spectrum.condition < 1e3 && spectrum.condition >= 1.0);
    }
}

#[test]
fn no_guess_gives_e1() {
    let chain = cases::paper();
    let found = solve(&chain, &Settings::default()).unwrap();
    let v = found.equilibrium.energy_j / MG + 6.0;
    assert!((v - V[0]).abs() < ENERGY);
    assert_eq!(found.equilibrium.stability.in_space, InSpace::Stable);
    assert!(relative_residual(chain.chain(), &found.q, &found.lambda) < 1e-14);
}

#[test]
fn evidence_is_filled() {
    let problem = cases::paper();
    let found =
        solve_from(&problem, &Seed::planar(&[0.3, 0.7, -1.3]), &Settings::default()).unwrap();
    let evidence = &found.equilibrium.evidence;
    assert_eq!(evidence.rung(), Some(model::Rung::Converged));
    assert_eq!(evidence.iterations, found.effort.iterations);
    assert_eq!(found.residual_history.len(), found.effort.iterations);
    assert!(evidence.solve_s > 0.0 && evidence.condition.is_finite());
    // Quadratic convergence: from the second step on each residual is below the square of the one
    // before it times a constant of the problem.
    for pair in found.residual_history[1..].windows(2) {
        assert!(pair[1] < 10.0 * pair[0] * pair[0] + 1e-15, "{:?}", found.residual_history);
    }
}
