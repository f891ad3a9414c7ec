//! Two answers that are made up, apart by numbers by hand.

use std::f64::consts::FRAC_PI_3;

use model::{Anchors, Bar, ForceChoice};

use super::*;

/// Three bars of 1 m between anchors 2 m apart, upright or not.
fn chain(upright: bool) -> Chain {
    let start_m = [3.0, -2.0, 0.5];
    let end_m = if upright { [3.0, -2.0, -1.5] } else { [5.0, -2.0, 0.5] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    Chain::new("three", 10.0, Anchors { start_m, end_m }, vec![bar; 3]).unwrap()
}

/// Joints by their places from the first anchor, turned by an angle, and as many forces.
fn answer(places_m: [Vector; 4], forces_n: [Vector; 4], angle: f64) -> Equilibrium {
    let settings = lagrange::Settings::default();
    let like = lagrange::solve(&model::cases::paper(), &settings).unwrap().equilibrium;
    let (sin, cos) = angle.sin_cos();
    let turned = |[x, y, z]: Vector| [cos * x - sin * y, sin * x + cos * y, z];
    let place = |at: Vector| {
        let [x, y, z] = turned(at);
        [3.0 + x, -2.0 + y, 0.5 + z]
    };
    Equilibrium {
        joints_m: places_m.map(place).to_vec(),
        multipliers_n: forces_n.map(turned).to_vec(),
        ..like
    }
}

const PLACES: [Vector; 4] = [[0.0; 3], [0.5, -0.25, -0.75], [-1.0, 0.5, -1.25], [0.0, 0.0, -2.0]];
const FORCES: [Vector; 4] = [[1.0, 2.0, 3.0], [-4.0, 5.0, 6.0], [7.0, -8.0, 9.0], [2.0, 4.0, 8.0]];

#[test]
fn what_turns_freely_is_turned_onto_the_other() {
    let first = answer(PLACES, FORCES, 0.0);
    for angle in [0.0, FRAC_PI_3, -2.5] {
        let mut second = answer(PLACES, FORCES, angle);
        second.energy_j = first.energy_j - 0.5;
        let found = Differences::of(&chain(true), [&first, &second], None, None);
        assert!((found.turned_rad.unwrap() + angle).abs() < 1e-15, "{:?}", found.turned_rad);
        assert!(found.joints_m < 1e-15 && found.forces_n < 1e-14);
        assert!((found.energy_j - 0.5).abs() < 1e-15);
        // Heights do not turn.
        second.joints_m[1][2] += 0.25;
        second.multipliers_n[2][2] -= 0.75;
        let found = Differences::of(&chain(true), [&first, &second], None, None);
        assert!((found.joints_m - 0.25).abs() < 1e-15 && (found.forces_n - 0.75).abs() < 1e-14);
        if angle.abs() > 0.0 {
            let found = Differences::of(&chain(false), [&first, &second], None, None);
            assert!(found.turned_rad.is_none() && found.joints_m > 0.5 && found.forces_n > 5.0);
        }
    }
}

/// One joint at 1 m and one at 2 m, the second of them a quarter of a turn further: `atan2(4, 1)`
/// brings both together closest.
#[test]
fn far_joints_count_by_the_square_of_their_distance() {
    let at = |second: Vector| [[0.0; 3], [0.0, 1.0, 0.0], second, [0.0, 0.0, -2.0]];
    let first = answer(at([0.0, 2.0, -1.0]), FORCES, 0.0);
    let second = answer(at([2.0, 0.0, -1.0]), FORCES, 0.0);
    let angle = turn_onto(&chain(true), &first, &second);
    assert!((angle - 4.0_f64.atan2(1.0)).abs() < 1e-15, "{angle}");
    let angle = turn_onto(&chain(true), &second, &first);
    assert!((angle + 4.0_f64.atan2(1.0)).abs() < 1e-15, "{angle}");
}

/// Joint 1 is 1 m off by (2, -1, 2)/3, joint 2 by 3/4 m.
#[test]
fn the_largest_distance_is_that_of_a_joint_that_is_held() {
    let first = answer(PLACES, FORCES, 0.0);
    let mut second = first.clone();
    for (k, off) in [(0, 2.0), (1, -1.0), (2, 2.0)] {
        second.joints_m[1][k] += off / 3.0;
    }
    second.joints_m[2][1] -= 0.75;
    let apart = |free: Option<FreeJoints>| {
        Differences::of(&chain(false), [&first, &second], free, None).joints_m
    };
    assert!((apart(None) - 1.0).abs() < 1e-15);
    assert!((apart(Some(FreeJoints { first: 1, last: 1 })) - 0.75).abs() < 1e-15);
    assert!((apart(Some(FreeJoints { first: 2, last: 2 })) - 1.0).abs() < 1e-15);
    assert!(apart(Some(FreeJoints { first: 1, last: 2 })) < 1e-15);
}

/// 5 N along the line of a family, and 3/4 N across it at one joint.
#[test]
fn a_force_along_the_line_of_a_family_is_no_difference() {
    let family = ForceFamily {
        dimension: 1,
        direction: [0.0, 0.6, 0.8],
        start_force_n: None,
        choice: ForceChoice::Unknown,
    };
    let first = answer(PLACES, FORCES, 0.0);
    let mut second = first.clone();
    for (k, force) in second.multipliers_n.iter_mut().enumerate() {
        let sign = if k == 0 { 1.0 } else { -1.0 };
        *force = [force[0], force[1] + sign * 3.0, force[2] + sign * 4.0];
    }
    second.multipliers_n[3][0] += 0.75;
    let apart = |family: Option<&ForceFamily>| {
        Differences::of(&chain(false), [&first, &second], None, family).forces_n
    };
    assert!((apart(None) - 5.0_f64.hypot(0.75)).abs() < 1e-14);
    assert!((apart(Some(&family)) - 0.75).abs() < 1e-14);
}

#[test]
fn what_is_missing_is_no_number() {
    let whole = answer(PLACES, FORCES, 0.0);
    let mut short = whole.clone();
    short.joints_m.truncate(3);
    short.multipliers_n.truncate(2);
    for both in [[&whole, &short], [&short, &whole], [&short, &short]] {
        let found = Differences::of(&chain(false), both, None, None);
        assert!(found.joints_m.is_nan() && found.forces_n.is_nan());
    }
    assert!(worst([1.0, f64::NAN, 2.0].into_iter()).is_nan());
    assert!(worst([f64::NAN, 2.0].into_iter()).is_nan());
    assert_eq!(worst([1.0, 3.0, 2.0].into_iter()).to_bits(), 3.0_f64.to_bits());
}
