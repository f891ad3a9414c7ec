//! Single numbers of the solvers against closed forms and symmetry.

use lagrange::batch::{Batch, BatchSettings};
use lagrange::condensed::{self, Solver};
use lagrange::net::{Derivatives, Parameter, solve};
use lagrange::{Error, Seed, Settings, solve_from};
use model::system::{Joint, Member, Support, System};
use model::{Bar, Problem};
use rand::RngExt;

use crate::common::{planar_seed, problem, stream};

/// Three bars between anchors at this azimuth.
fn turned(azimuth: f64) -> Problem {
    let end_m = [0.6 * azimuth.cos(), 0.6 * azimuth.sin(), -0.4];
    samples::homogeneous(9.81, &[(1.0, 1.0); 3], end_m)
}

/// The memory of a solution that is given back holds the next one.
#[test]
fn memory_given_back_is_used_again() {
    let mut solver = Solver::default();
    let settings = condensed::Settings::default();
    let first = solver.solve(&model::cases::paper(), &settings).unwrap();
    let memory = first.equilibrium.joints_m.as_ptr();
    solver.take_back(first);
    let second = solver.solve(&model::cases::paper(), &settings).unwrap();
    assert_eq!(second.equilibrium.joints_m.as_ptr(), memory);
}

#[test]
fn batches_head_towards_the_last_anchor() {
    for azimuth in [0.0, 0.3, 1.2, 2.5, 4.0, 5.5] {
        let batch = Batch::new(&turned(azimuth), BatchSettings::default()).unwrap();
        let [x, y] = batch.heading();
        assert!((x - azimuth.cos()).abs() < 1e-15 && (y - azimuth.sin()).abs() < 1e-15);
    }
}

/// All equilibria of a chain turn with its anchors, and keep their indices; at 45 degrees a sign of
/// the plane that is wrong makes two of its directions one.
#[test]
fn indices_do_not_depend_on_the_azimuth() {
    let settings = Settings::default();
    let mut saddles = 0;
    for k in 0..30 {
        let mut random = stream(90, k);
        let phi: Vec<f64> = (0..3).map(|_| random.random_range(-3.1..3.1)).collect();
        let heading = |azimuth: f64| Seed::planar_towards(azimuth, &phi);
        let Ok(one) = solve_from(&turned(0.0), &heading(0.0), &settings) else { continue };
        for azimuth in [std::f64::consts::FRAC_PI_4, 2.0, 3.0 * std::f64::consts::FRAC_PI_4] {
            let Ok(other) = solve_from(&turned(azimuth), &heading(azimuth), &settings) else {
                continue;
            };
            let off = one.equilibrium.energy_j - other.equilibrium.energy_j;
            if off.abs() < 1e-9 {
                assert_eq!(one.equilibrium.stability, other.equilibrium.stability);
                saddles += usize::from(one.equilibrium.stability.index_in_plane > 0);
            }
        }
    }
    assert!(saddles > 10, "{saddles}");
}

/// However few steps there are: what is returned has converged, and more of them do not undo it.
#[test]
fn steps_that_run_out_return_nothing() {
    for k in 0..6 {
        let mut random = stream(91, k);
        let problem = problem(&mut random, 3, false);
        let seed = planar_seed(&mut random, 3);
        let mut reached = false;
        for max_iterations in 1..40 {
            let settings = Settings { max_iterations, relaxations: 0, ..Settings::default() };
            let found = solve_from(&problem, &seed, &settings);
            assert!(found.is_ok() || !reached, "{max_iterations}");
            if let Ok(found) = found {
                reached = true;
                assert!(found.equilibrium.evidence.residual < 1e-11);
            }
        }
    }
}

/// A weight on a floor beside a slack or taut spring: more weight is more push, one to one, and
/// nothing moves.
#[test]
fn what_lies_on_a_floor_pushes_it_with_its_weight() {
    for (x, mass_kg) in [(0.5, 2.0), (0.9, 7.0)] {
        let joints = vec![
            Joint::anchor("A", [0.0, 0.0, 1.0]),
            Joint::free("P").with_mass(mass_kg).with_force([x, 0.0, 0.0]),
        ];
        let spring = Member::cable(0, 1, Bar::homogeneous(1.3, 0.0).unwrap());
        let system = System::new("weight", 10.0, joints, vec![spring.with_stiffness(40.0)]);
        let system = system.unwrap().with_floor(0.0).unwrap();
        let found = solve(&system, &lagrange::net::Settings::default()).unwrap();
        let answer = &found.equilibrium;
        assert!(answer.joints_m[1][2].abs() < 1e-12 && answer.reactions_n[1][2] > 0.0);
        let mut derivatives = Derivatives::new(&system, &found).unwrap();
        let down = Parameter::Force { joint: 1, axis: 2 };
        let change = derivatives.change(down).unwrap();
        assert!(change.joints_m[1].iter().all(|dx| dx.abs() < 1e-12), "{change:?}");
        assert!((change.reactions_n[1][2] + 1.0).abs() < 1e-12, "{change:?}");
        // Along the floor the spring gives way.
        let aside = derivatives.change(Parameter::Force { joint: 1, axis: 0 }).unwrap();
        assert!(aside.joints_m[1][0] > 1e-3 && aside.joints_m[1][2].abs() < 1e-12, "{aside:?}");
    }
}

/// On a slanted line that leads below the floor, floor and line together bear the weight.
#[test]
fn a_floor_ends_a_slide() {
    let support = Support::Line { at_m: [0.0, 0.0, 0.5], direction: [0.8, 0.0, -0.6] };
    let joints =
        vec![Joint::anchor("A", [0.0, 0.0, 2.0]), Joint::free("P").with_mass(3.0).held_by(support)];
    let cable = Member::cable(0, 1, Bar::homogeneous(5.0, 0.0).unwrap());
    let system = System::new("slide", 10.0, joints, vec![cable]).unwrap();
    let system = system.with_floor(0.0).unwrap();
    let found = solve(&system, &lagrange::net::Settings::default()).unwrap();
    let [x, _, z] = found.equilibrium.joints_m[1];
    assert!((x - 2.0 / 3.0).abs() < 1e-12 && z.abs() < 1e-12, "{x} {z}");
    let [rx, ry, rz] = found.equilibrium.reactions_n[1];
    assert!(rx.abs() < 1e-10 && ry.abs() < 1e-10 && (rz - 30.0).abs() < 1e-10, "{rx} {ry} {rz}");
}

/// A search for what is stable ends after as many tries as it may make, and the first.
#[test]
fn searches_for_what_is_stable_end() {
    let problem = model::cases::paper();
    for relaxations in [0, 1, 3] {
        let hasty = Settings {
            max_iterations: 1,
            max_relaxation_steps: 1,
            relaxations,
            ..Default::default()
        };
        let error = lagrange::solve(&problem, &hasty).unwrap_err();
        let Error::Stagnated { relaxations: made, .. } = error else { panic!("{error}") };
        assert_eq!(made, relaxations + 1);
    }
}
