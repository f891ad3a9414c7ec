//! The bounds that need no cone solver: true for whatever they are given, tight for the optimum.

use crate::support::{chain, configuration, energy, rng, scaled, unit_j};
use bounds::{Sense, pull_bound, stress_bound};
use energy::{Settings, minimise};
use model::{Anchors, Bar, Chain, Equilibrium, Problem};
use rand::RngExt;

/// Rounding of the energies compared, of weight times length; measured 3e-15 at most.
const ROUNDING: f64 = 1e-13;

/// By how much the bound of the paper's chain may fall short: its stress matrix is singular, so
/// that the roundings of the force densities given count in full; measured 1.0e-14.
const SINGULAR: f64 = 4e-14;

/// Three equal bars of the paper in units of mass, length and gravity 1: its data are exact
/// doubles.
fn paper_in_units() -> Problem {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, -2.0] };
    let bars = vec![Bar::homogeneous(1.0, 1.0).unwrap(); 3];
    Problem::new(Chain::new("paper", 1.0, anchors, bars).unwrap()).unwrap()
}

fn minimum(problem: &Problem) -> Equilibrium {
    minimise(problem, &Settings::default()).unwrap().equilibrium
}

fn force_densities(problem: &Problem, equilibrium: &Equilibrium) -> Vec<f64> {
    let bars = problem.chain().bars();
    equilibrium.axial_n.iter().zip(bars).map(|(force, bar)| force / bar.length_m()).collect()
}

/// The reference digits give V(E1) = 2.33546865199930500930868666574 - 6 and its angles to 25
/// digits. The bound is below the exact value, and by no more than rounding.
#[test]
fn paper_to_the_last_digit() {
    let problem = paper_in_units();
    let degrees = [19.694_867_976_133_02_f64, 38.599_136_184_451_89, -73.920_588_792_231_34];
    let mut joints = vec![[0.0; 3]];
    for angle in degrees {
        let (sin, cos) = angle.to_radians().sin_cos();
        let [_, y, z] = joints[joints.len() - 1];
        joints.push([0.0, y + sin, z - cos]);
    }
    // Horizontal pull 0.6489448359339336 of the multipliers over the horizontal extent of each bar.
    let tau: Vec<f64> = degrees.map(|a| 0.648_944_835_933_933_6 / a.to_radians().sin()).to_vec();
    let bound = stress_bound(&problem, Sense::Lower, &joints, &tau).unwrap();
    // The double nearest the exact value is above it by 5e-17.
    let exact = -3.664_531_348_000_694_7;
    assert!(bound.rigorous_j <= exact, "{:e}", bound.rigorous_j - exact);
    assert!(bound.rigorous_j > exact - SINGULAR, "{:e}", bound.rigorous_j - exact);
    // The stress matrix is singular there: the turn about OD.
    assert!(bound.raised > 0.0 && bound.raised < 1e-13, "{:e}", bound.raised);
}

/// The minimum that the minimiser of this crate finds is certified, and no random configuration is
/// below the bound.
#[test]
fn minima_are_certified_and_nothing_is_below() {
    let mut rng = rng(1);
    for stream in 0..60 {
        let n = 2 + usize::try_from(stream).unwrap() % 9;
        let problem = chain(n, stream, 0.7);
        let found = minimum(&problem);
        let tau = force_densities(&problem, &found);
        let bound = stress_bound(&problem, Sense::Lower, &found.joints_m, &tau).unwrap();
        let gap = (found.energy_j - bound.rigorous_j) / unit_j(&problem);
        assert!(gap.abs() < ROUNDING, "{stream}: {gap:e}");
        for _ in 0..200 {
            let joints = configuration(&problem, &mut rng);
            let above = (energy(&problem, &joints) - bound.rigorous_j) / unit_j(&problem);
            assert!(above > -ROUNDING, "{stream}: {above:e}");
        }
    }
}

/// What is proved does not depend on what is given: wrong joints and wrong forces make the bound
/// worse or none at all, never wrong.
#[test]
fn wrong_data_never_give_a_wrong_bound() {
    let mut rng = rng(2);
    let (mut proved, mut refused) = (0, 0);
    for stream in 0..200 {
        let problem = chain(2 + usize::try_from(stream).unwrap() % 7, stream, 0.9);
        let found = minimum(&problem);
        let size = 10.0_f64.powi(-rng.random_range(0..12));
        let mut noise = |x: f64, unit: f64| x + unit * size * rng.random_range(-1.0..1.0);
        let joints: Vec<_> = found.joints_m.iter().map(|x| x.map(|x| noise(x, 1.0))).collect();
        let tau: Vec<_> =
            force_densities(&problem, &found).iter().map(|t| noise(*t, t.abs())).collect();
        match stress_bound(&problem, Sense::Lower, &joints, &tau) {
            Some(bound) => {
                let above = (found.energy_j - bound.rigorous_j) / unit_j(&problem);
                assert!(above > -ROUNDING, "{stream}: {above:e}");
                proved += 1;
            }
            None => refused += 1,
        }
        let pull = found.reactions_n.end.map(|f| noise(f, f.abs()));
        let bound = pull_bound(&problem, Sense::Lower, pull);
        assert!(found.energy_j - bound > -ROUNDING * unit_j(&problem), "{stream}");
    }
    assert!(proved > 100 && refused > 0, "{proved} proved, {refused} refused");
}

/// With all bars in tension the pull of the equilibrium proves as much as its stress.
#[test]
fn the_pull_proves_the_minimum_when_all_bars_are_in_tension() {
    let mut tense = 0;
    for stream in 0..60 {
        let problem = chain(2 + usize::try_from(stream).unwrap() % 9, stream, 0.95);
        let found = minimum(&problem);
        let bound = pull_bound(&problem, Sense::Lower, found.reactions_n.end);
        let gap = (found.energy_j - bound) / unit_j(&problem);
        if found.axial_n.iter().all(|f| *f > 0.0) {
            assert!(gap.abs() < ROUNDING, "{stream}: {gap:e}");
            tense += 1;
        } else {
            assert!(gap > 0.0, "{stream}: {gap:e}");
        }
    }
    assert!(tense > 10);
}

/// E2 is an equilibrium (reference digits), and not the minimum: its stress matrix certifies
/// nothing. It is the maximum, and certified as that.
#[test]
fn an_equilibrium_that_is_not_optimal_is_not_certified() {
    let problem = paper_in_units();
    let degrees = [73.920_588_792_231_34_f64, -38.599_136_184_451_89, -19.694_867_976_133_02];
    let mut joints = vec![[0.0; 3]];
    for angle in degrees {
        let (sin, cos) = angle.to_radians().sin_cos();
        let [_, y, z] = joints[joints.len() - 1];
        joints.push([0.0, y + sin, z - cos]);
    }
    // E2 is E1 upside down: the same horizontal pull, bar by bar in the reverse order, pushed.
    let tau: Vec<f64> = degrees.map(|a| 0.648_944_835_933_933_6 / a.to_radians().sin()).to_vec();
    assert!(stress_bound(&problem, Sense::Lower, &joints, &tau).is_none());
    let bound = stress_bound(&problem, Sense::Upper, &joints, &tau).unwrap();
    // Reference digits: 3.66453134800069499069131333426 - 6.
    let exact = -2.335_468_651_999_305;
    assert!((bound.rigorous_j - exact).abs() < SINGULAR);
    assert!(bound.rigorous_j >= exact);
}

#[test]
fn units_do_not_matter() {
    let problem = chain(6, 5, 0.8);
    let found = minimum(&problem);
    let tau = force_densities(&problem, &found);
    let reference = stress_bound(&problem, Sense::Lower, &found.joints_m, &tau).unwrap();
    let reference = reference.rigorous_j / unit_j(&problem);
    let at_pull = pull_bound(&problem, Sense::Lower, found.reactions_n.end) / unit_j(&problem);
    for (length, mass, gravity) in [
        (1e-9, 1.0, 1.0),
        (1e9, 1e-6, 1.0),
        (1e-6, 1e6, 1e3),
        (1e6, 1e6, 1e-9),
        (1e100, 1e-80, 1.0),
    ] {
        let other = scaled(&problem, length, mass, gravity);
        let joints: Vec<_> = found.joints_m.iter().map(|x| x.map(|x| length * x)).collect();
        let force = mass * gravity;
        let tau: Vec<_> = tau.iter().map(|t| t * (force / length)).collect();
        let bound = stress_bound(&other, Sense::Lower, &joints, &tau).unwrap();
        assert!((bound.rigorous_j / unit_j(&other) - reference).abs() < ROUNDING, "{length}");
        let pull = found.reactions_n.end.map(|f| f * force);
        let bound = pull_bound(&other, Sense::Lower, pull) / unit_j(&other);
        assert!((bound - at_pull).abs() < ROUNDING, "{length}");
    }
}

#[test]
fn what_is_not_finite_or_not_complete_proves_nothing() {
    let problem = model::cases::paper();
    let found = minimum(&problem);
    let tau = force_densities(&problem, &found);
    let joints = found.joints_m;
    assert!(stress_bound(&problem, Sense::Lower, &joints[1..], &tau).is_none());
    assert!(stress_bound(&problem, Sense::Lower, &joints, &tau[1..]).is_none());
    for bad in [f64::NAN, f64::INFINITY] {
        let mut wrong = tau.clone();
        wrong[1] = bad;
        assert!(stress_bound(&problem, Sense::Lower, &joints, &wrong).is_none());
        let mut wrong = joints.clone();
        wrong[1][2] = bad;
        assert!(stress_bound(&problem, Sense::Lower, &wrong, &tau).is_none());
        let bound = pull_bound(&problem, Sense::Lower, [bad, 0.0, 0.0]);
        assert!(bound <= f64::MIN, "{bound}");
        let bound = pull_bound(&problem, Sense::Upper, [0.0, 0.0, bad]);
        assert!(bound >= f64::MAX, "{bound}");
    }
}
