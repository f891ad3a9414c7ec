//! What is taut, by hand.

use super::*;
use crate::net::directions::Directions;
use crate::net::framework::{Node, Units};

/// A cable of length 2 between two joints, with a force and its counterpart.
fn hanging(force: Pair, slack: Pair) -> (Framework, Hanging) {
    let node = Node { base: Vector3::zeros(), free: Directions::All, load: Vector3::zeros() };
    let framework = Framework {
        units: Units { length_m: 1.0, force_n: 1.0, origin_m: Vector3::zeros() },
        nodes: vec![node.clone(), node],
        links: vec![Link {
            from: 0,
            to: 1,
            length: 2.0,
            within: 0.0,
            compliance: 0.0,
            kind: Kind::Cable,
            rope: None,
        }],
        ropes: Vec::new(),
        lying: Vec::new(),
        work: crate::net::work::Work::default(),
    };
    let hanging = Hanging {
        places: vec![Vector3::zeros(), Vector3::x()],
        forces: vec![Some(force)],
        slacks: vec![slack],
        steps: 0,
        gap: 0.0,
        misfit: 0.0,
        short: 0,
        first: 1.0,
    };
    (framework, hanging)
}

/// The only force is the mean one; the slack is 1/2, 3/4, 5/4 and 8 lengths.
#[test]
fn a_cable_is_taut_where_its_force_is_more_than_its_slack() {
    let across = |x: f64| Vector3::new(x, 0.0, 0.0);
    for (left, taut) in [(1.0, true), (1.5, true), (2.5, false), (16.0, false)] {
        let slack = Pair::new(left + 0.5, across(0.5));
        let (framework, hanging) = hanging(Pair::new(1.0, across(0.75)), slack);
        let tautness = hanging.tautness(&framework.links[0], 0, hanging.mean());
        assert!((tautness - 2.0 / left).abs() < 1e-15);
        let state = hanging.state(&framework);
        assert_eq!(state.taut, [taut]);
        assert!((state.axial[0] - if taut { 0.75 } else { 0.0 }).abs() < 1e-15);
    }
    // A force without any size pulls nothing, whatever its head is.
    let (framework, hanging) =
        hanging(Pair::new(1.0, Vector3::zeros()), Pair::new(1.0, Vector3::zeros()));
    assert!((hanging.tautness(&framework.links[0], 0, hanging.mean()) - 2.0).abs() < 1e-15);
    assert_eq!(hanging.state(&framework).taut, [false]);
}

#[test]
fn without_forces_worth_the_name_no_cable_is_taut() {
    let across = Vector3::new(0.5, 0.0, 0.0);
    for (size, taut) in [(2e-9, true), (0.5e-9, false)] {
        let (framework, hanging) = hanging(Pair::new(size, across * size), Pair::new(1.0, across));
        assert_eq!(hanging.idle(), !taut);
        assert_eq!(hanging.state(&framework).taut, [taut]);
    }
}
