//! Ropes over rings and pulleys against closed forms.

use lagrange::network::{
    Derivatives, Error, Forces, Parameter, Seed, Settings, Solution, solve, solve_from,
};
use model::Bar;
use model::system::{Joint, Member, System};
use samples::RopeSample;

use crate::network::{close, near};

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

#[test]
fn ropes_have_one_tension() {
    for sample in samples::ropes() {
        let name = sample.system.name();
        let found = solve(&sample.system, &Settings::default());
        let found = found.unwrap_or_else(|error| panic!("{name}: {error}"));
        holds(&sample, &found);
        assert_eq!(
            (found.forces, found.equilibrium.stability.neutral),
            (Forces::Unique, 0),
            "{name}"
        );
        let drawn = found.equilibrium.joints_m.iter().map(|[x, y, z]| [x + 0.1, y - 0.05, z + 0.1]);
        let near = solve_from(&sample.system, &Seed::at(drawn.collect()), &Settings::default());
        holds(&sample, &near.unwrap_or_else(|error| panic!("{name}: {error}")));
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

fn rope(path: [usize; 4], length_m: f64) -> Member {
    Member::cable(path[0], path[3], Bar::homogeneous(length_m, 0.0).unwrap())
        .over(path[1..3].to_vec())
}

/// Two weights over two pulleys: the lighter one is pulled up to its pulley.
#[test]
fn unequal_weights_jam() {
    for (masses_kg, light, pulley) in
        [([3.0, 2.0], "Q", "E"), ([3.0, 2.99], "Q", "E"), ([1.0, 5.0], "P", "D")]
    {
        let joints = vec![
            Joint::anchor("D", [0.0; 3]),
            Joint::anchor("E", [1.0, 0.0, 0.0]),
            Joint::free("P").with_mass(masses_kg[0]),
            Joint::free("Q").with_mass(masses_kg[1]),
        ];
        let system =
            System::new("two weights", 10.0, joints, vec![rope([2, 0, 1, 3], 6.0)]).unwrap();
        let error = solve(&system, &Settings::default()).unwrap_err();
        let Error::Jammed { member: 1, from, to } = &error else { panic!("{error}") };
        assert!(
            [from, to].contains(&&light.to_owned()) && [from, to].contains(&&pulley.to_owned())
        );
    }
}

/// Two ropes on one way share as equally stiff ones, and have no derivatives.
#[test]
fn ropes_side_by_side_are_a_family() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("D", [3.0, 0.0, 4.0]),
        Joint::free("P").with_mass(10.0),
        Joint::anchor("B", [7.0, 0.0, 4.0]),
    ];
    let ropes = vec![rope([0, 1, 2, 3], 10.0), rope([3, 2, 1, 0], 10.0)];
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
