//! States of answers.

use model::Bar;
use model::system::{Joint, Member, System};

use super::*;
use crate::net::{Settings, solve};

/// Two bars of 5 between anchors 6 apart, far from the origin: their joint hangs 4 below.
#[test]
fn the_state_of_an_answer_is_told_in_units_from_the_origin() {
    let joints = vec![
        Joint::anchor("A", [100.0, 20.0, 7.0]),
        Joint::free("B").with_mass(1.0),
        Joint::anchor("C", [106.0, 20.0, 7.0]),
    ];
    let bar = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = vec![Member::bar(0, 1, bar), Member::bar(1, 2, bar)];
    let system = System::new("V", 10.0, joints, members).unwrap();
    let framework = Framework::new(&system);
    let state = State::of(&framework, &solve(&system, &Settings::default()).unwrap());
    for joint in [0, 2] {
        assert!((state.places[joint] - framework.nodes[joint].base).norm() < 1e-14);
    }
    let middle = (state.places[0] + state.places[2]) * 0.5 - Vector3::z() * 0.8;
    assert!((state.places[1] - middle).norm() < 1e-12);
    // 10 N in all, half of it up in each bar of slope 4 in 5.
    for axial in &state.axial {
        assert!((axial * framework.units.force_n - 6.25).abs() < 1e-11);
    }
    assert_eq!(state.taut, [true; 2]);
}
