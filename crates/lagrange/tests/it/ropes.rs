//! Ropes over rings and pulleys against closed forms.

use lagrange::net::{
    Derivatives, Error, Forces, Parameter, Seed, Settings, Solution, solve, solve_from,
};
use model::Bar;
use model::system::{Joint, Member, RunTogether, System};
use samples::{RopeSample, rope};

use crate::net::{close, near};

fn holds(sample: &RopeSample, found: &Solution) {
    let answer = &found.equilibrium;
    assert_eq!(answer.axial_n.len(), sample.axial_n.len());
    for (axial, wanted) in answer.axial_n.iter().zip(&sample.axial_n) {
        close(*axial, *wanted);
    }
    for (joint, at_m) in &sample.at_m {
        near(answer.joints_m[*joint], *at_m);
    }
}

/// What is found, and again from places next to it.
fn found_again(sample: &RopeSample) -> Solution {
    let (system, settings) = (&sample.system, Settings::default());
    let failed = |error| panic!("{}: {error}", system.name());
    let found = solve(system, &settings).unwrap_or_else(failed);
    holds(sample, &found);
    let drawn = found.equilibrium.joints_m.iter().map(|[x, y, z]| [x + 0.1, y - 0.05, z + 0.1]);
    holds(
        sample,
        &solve_from(system, &Seed::at(drawn.collect()), &settings).unwrap_or_else(failed),
    );
    found
}

#[test]
fn ropes_have_one_tension() {
    for sample in samples::ropes() {
        let name = sample.system.name();
        let found = found_again(&sample);
        assert_eq!(
            (found.forces, found.equilibrium.stability.neutral),
            (Forces::Unique, 0),
            "{name}"
        );
    }
}

/// At both ends the rope pulls along its own span: 3 m level at the anchor, down at the weight.
#[test]
fn the_ends_of_a_rope_have_directions_of_their_own() {
    let over_a_pulley = &samples::ropes()[5];
    let found = solve(&over_a_pulley.system, &Settings::default()).unwrap().equilibrium;
    let tension = over_a_pulley.axial_n[0];
    near(found.start_forces_n[0], [-0.6 * tension, 0.0, -0.8 * tension]);
    near(found.end_forces_n[0], [0.0, 0.0, -tension]);
    near(found.reactions_n[0], [0.6 * tension, 0.0, 1.8 * tension]);
    near(found.reactions_n[2], [-0.6 * tension, 0.0, -0.8 * tension]);
    close(found.energy_j, -tension);
}

/// Rings that have run to a pulley, to an end of the rope or to another ring, and what holds them there.
#[test]
fn joints_that_run_together_are_held_by_less_than_the_tension() {
    for sample in samples::jammed_ropes() {
        let name = sample.system.name();
        let found = found_again(&sample);
        let jams = &found.equilibrium.evidence.jams;
        assert_eq!(jams.len(), sample.jams.len(), "{name}");
        for (jam, (span, pull_n)) in jams.iter().zip(&sample.jams) {
            assert_eq!((jam.member, jam.span), (0, *span), "{name}");
            near(jam.pull_n, *pull_n);
        }
        let derivatives = Derivatives::new(&sample.system, &found).map(|_| ());
        assert!(matches!(derivatives, Err(Error::Jammed(RunTogether { member: 1, .. }))), "{name}");
    }
}

/// 100 N stretch 3.6 m to 4 m between anchors: 100 N (4/3.6 - 1), whatever loads the anchors.
#[test]
fn what_is_stretched_between_anchors_bears_it() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [4.0, 0.0, 0.0]).with_force([2.0, 0.0, -2.0]),
    ];
    let body = Bar::homogeneous(3.6, 0.0).unwrap();
    let members = vec![Member::cable(0, 1, body).with_stiffness(100.0)];
    let system = System::new("a stay", 10.0, joints, members).unwrap();
    let found = solve(&system, &Settings::default()).unwrap().equilibrium;
    close(found.axial_n[0], 100.0 * (4.0 / 3.6 - 1.0));
    near(found.reactions_n[0], [-found.axial_n[0], 0.0, 0.0]);
}

/// Two ropes on one way share as equally stiff ones, and derivatives of them are refused.
#[test]
fn ropes_side_by_side_are_a_family() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("D", [3.0, 0.0, 4.0]),
        Joint::free("P").with_mass(10.0),
        Joint::anchor("B", [7.0, 0.0, 4.0]),
    ];
    let ropes = vec![rope(&[0, 1, 2, 3], 10.0), rope(&[3, 2, 1, 0], 10.0)];
    let system = System::new("two ropes", 9.6, joints, ropes).unwrap();
    let found = solve(&system, &Settings::default()).unwrap();
    // 96 N on four spans with the slope of 4 and 3 m.
    near(found.equilibrium.joints_m[2], [5.0, 0.0, 4.0 - 1.5]);
    for axial in &found.equilibrium.axial_n {
        close(*axial, 96.0 / (4.0 * 0.6));
    }
    assert_eq!(found.forces, Forces::LeastNorm);
    let named = found.equilibrium.evidence.self_stresses.as_ref().unwrap();
    assert_eq!((named.dimension, named.basis[0].len()), (1, 2));
    let refused = Derivatives::new(&system, &found).err().unwrap();
    assert_eq!(refused, Error::OpenForces { dimension: 1 });
}

/// `T = W/(2 cos a)` with `sin a = d/L`: `dT/dL = −W d²/(2 L³ cos³ a)`, `dT/dd = W d/(2 L² cos³ a)`, and none by the
/// height of an anchor.
#[test]
fn the_tension_of_a_rope_over_a_ring_by_its_length() {
    let ring = &samples::ropes()[0].system;
    let found = solve(ring, &Settings::default()).unwrap();
    let mut derivatives = Derivatives::new(ring, &found).unwrap();
    let [by_length, aside, up] = [
        Parameter::Length { member: 0 },
        Parameter::Anchor { joint: 1, axis: 0 },
        Parameter::Anchor { joint: 1, axis: 2 },
    ]
    .map(|by| derivatives.change(by).unwrap().axial_n[0]);
    let weight_n = 10.0 * 9.80665;
    close(by_length, -weight_n * 16.0 / (250.0 * 0.216));
    close(aside, weight_n * 4.0 / (50.0 * 0.216));
    assert!(up.abs() < 1e-9, "{up}");
    // The force follows the weight: 1/(2 cos a) for each newton down.
    let by_force = derivatives.change(Parameter::Force { joint: 2, axis: 2 }).unwrap();
    close(by_force.axial_n[0], -1.0 / 1.2);
    assert_eq!(derivatives.change(Parameter::Mass { member: 0 }).unwrap().axial_n, [0.0]);
}
