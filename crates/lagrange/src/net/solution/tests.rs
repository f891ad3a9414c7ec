//! Which forces are shown, by hand.

use model::Bar;
use model::system::{Joint, Member};

use super::*;
use crate::net::directions::Directions;
use crate::net::framework::{Link, Node, Units};
use crate::net::{Settings, solve};
use model::system::Kind;

/// Three members in parallel between two joints, the second one a cable with this force; the third
/// bears what can be taken off.
fn chosen(largest: f64, cable: f64) -> Forces {
    let node = Node { base: Vector3::zeros(), free: Directions::All, load: Vector3::zeros() };
    let link =
        |kind| Link { from: 0, to: 1, length: 1.0, within: 0.0, compliance: 0.0, kind, rope: None };
    let framework = Framework {
        units: Units { length_m: 1.0, force_n: 1.0, origin_m: Vector3::zeros() },
        nodes: vec![node.clone(), node],
        links: vec![link(Kind::Bar), link(Kind::Cable), link(Kind::Bar)],
        ropes: Vec::new(),
        lying: Vec::new(),
        work: crate::net::work::Work::default(),
    };
    let places = vec![Vector3::zeros(), Vector3::x()];
    let mut state = State::new(places, vec![largest, cable, 0.5 * largest], vec![true; 3]);
    let basis = [vec![0.0, 0.0, 1.0]];
    let forces = choose(&framework, &mut state, Some(&basis), f64::INFINITY);
    let left = if forces == Forces::LeastNorm { 0.0 } else { 0.5 * largest };
    assert!((state.axial[2] - left).abs() < 1e-15 * largest);
    forces
}

/// A cable may push with 1e-10 of the largest force, which is rounding.
#[test]
fn the_push_of_a_cable_is_held_against_the_largest_force() {
    for largest in [1e-3, 1.0, 1e3] {
        assert_eq!(chosen(largest, largest), Forces::LeastNorm);
        assert_eq!(chosen(largest, -0.9e-10 * largest), Forces::LeastNorm);
        assert_eq!(chosen(largest, -1.1e-10 * largest), Forces::Found);
    }
}

/// A weight between anchors on one vertical, on bars of 1 m above and 3 m below: as if both were
/// equally stiff, the forces in the ratio of 3 to -1 give both the same elongation.
#[test]
fn the_longer_of_two_bars_takes_less() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("B").with_mass(2.0),
        Joint::anchor("C", [0.0, 0.0, -4.0]),
    ];
    let bar = |length: f64| Bar::homogeneous(length, 0.0).unwrap();
    let members = vec![Member::bar(0, 1, bar(1.0)), Member::bar(1, 2, bar(3.0))];
    let system = System::new("between", 10.0, joints, members).unwrap();
    let found = solve(&system, &Settings::default()).unwrap();
    assert_eq!(found.forces, Forces::LeastNorm);
    for (axial, expected) in found.equilibrium.axial_n.iter().zip([15.0, -5.0]) {
        assert!((axial - expected).abs() < 1e-9, "{axial}");
    }
}
