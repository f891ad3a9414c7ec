//! What is explained, by hand.

use super::super::tests::lamp;
use super::*;

const KNOWN: Bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 3.0 };

/// `2 δ/(d - δ)`, and 2 at most.
#[test]
fn a_direction_turns_by_what_its_ends_move() {
    let turn = |distance_m: f64| KNOWN.turn(distance_m).to_bits();
    for (distance_m, wanted) in [(0.0, 2.0), (0.25, 2.0), (0.5, 2.0), (0.75, 1.0), (2.25, 0.25)] {
        assert_eq!(turn(distance_m), f64::to_bits(wanted), "{distance_m}");
    }
    assert_eq!(KNOWN.distance_m(&lamp().members()[0]).to_bits(), 0.5_f64.to_bits());
}

/// Moved by 2^40 m the lamp is as large as before, 6 m, and its places are stored to 2^-9 m.
#[test]
fn far_away_places_are_known_by_their_rounding() {
    let far = 2.0_f64.powi(40);
    let system = lamp();
    let mut joints = system.joints().to_vec();
    for (joint, x) in joints.iter_mut().zip([-3.0, 3.0]) {
        *joint = model::system::Joint::anchor(joint.name.to_string(), [far + x, 0.0, 0.0]);
    }
    let system = System::new("far", 10.0, joints, system.members().to_vec()).unwrap();
    let places = [[far - 3.0, 0.0, 0.0], [far + 3.0, 0.0, 0.0], [far, 0.0, -4.0]];
    let bounds = Bounds::of_positions(&system, &places, 0.001);
    let wanted = 0.006 + 2.0_f64.powi(-9);
    assert!((bounds.position_m / wanted - 1.0).abs() < 1e-9, "{bounds:?}");
    assert_eq!((bounds.tolerance, bounds.force_n), (0.001, 0.0));
    // Members longer than anything else are the size.
    let near = Bounds::of_positions(&lamp(), &[[-3.0, 0.0, 0.0]; 3], 0.001);
    assert!((near.position_m / 0.005 - 1.0).abs() < 1e-9, "{near:?}");
    let none = Bounds::of_positions(&lamp(), &[[-3.0, 0.0, f64::NAN]; 3], 0.001);
    assert!(none.position_m.is_nan());
}
