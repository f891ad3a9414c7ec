//! Errors and shifts, by hand.

use model::Vector;

use super::*;
use crate::net::frame::Rod;

const ZERO3: Vector = [0.0; 3];

/// Bars of 1 and 1/2 in a row from a support, with two free joints; the unit of length is 4 m.
fn newton() -> Newton {
    let rods = vec![Rod::straight(0, 1, 1.0, Kind::Bar), Rod::straight(1, 2, 0.5, Kind::Strut)];
    let frame = Frame { length_m: 4.0, ..Frame::of_rods(1, vec![ZERO3; 3], rods) };
    let factor = Factor::new(&frame.spots, &frame.rods, &frame.meter).unwrap();
    let settings = Settings::default();
    Newton::new(Arc::new(frame), factor, settings, &[2.0, -1.0], Pace::default())
}

fn places(first: f64, second: f64) -> Shape {
    let x = vec![ZERO3, [first, 0.0, 0.0], [first + second, 0.0, 0.0]];
    Shape { x, force: vec![0.0, -1.0] }
}

/// The excess of a bar is (d² - l²)/2l: 0.105 for 1.1 over 1, and -0.21 for 0.2 over 0.5; over the
/// length -0.42, which is more. In metres -0.84.
#[test]
fn the_worst_misfit_is_told_in_metres() {
    let newton = newton();
    let Error::NotClosed { member, misfit_m } = newton.stalled(&places(1.1, 0.2)) else {
        panic!("it does not fit");
    };
    assert!(member == 2 && (misfit_m - 0.84).abs() < 1e-14, "{member} {misfit_m}");
    let Error::NotClosed { member, misfit_m } = newton.stalled(&places(1.1, 0.5)) else {
        panic!("it does not fit");
    };
    assert!(member == 1 && (misfit_m - 0.42).abs() < 1e-14, "{member} {misfit_m}");
    // 0.000_5 is near enough: what is left is the balance, of a joint that is pushed by 1.
    let Error::Stalled { unbalance, misfit } = newton.stalled(&places(1.0005, 0.5)) else {
        panic!("it fits");
    };
    assert!((unbalance - 1.0).abs() < 1e-12);
    assert!((misfit - 0.5 * (1.0005 * 1.0005 - 1.0)).abs() < 1e-14);
}

/// Of the bar the ends may move by two lengths towards each other or apart, of the strut by 0.3.
#[test]
fn no_step_turns_a_member_too_far() {
    let newton = newton();
    for (step, part) in [
        ([1.0, 0.0, 0.0, 1.0, 0.0, 0.0], 1.0),
        ([0.0, 8.0, 0.0, 0.0, 8.0, 0.0], 0.25),
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.6], 0.25),
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.1], 1.0),
        ([8.0, 0.0, 0.0, 8.0, 0.6, 0.0], 0.25),
    ] {
        assert!((newton.longest_part(&step) - part).abs() < 1e-15, "{step:?}");
    }
}

#[test]
fn shifts_follow_the_part_of_a_step_that_was_made() {
    for (part, before, after) in [
        (1.0, 1e-3, 2e-4),
        (0.91, 1e-3, 2e-4),
        (0.9, 1e-3, 1e-3),
        (0.3, 1e-3, 1e-3),
        (0.29, 1e-3, 4e-3),
        (0.1, 0.0, 1e-8),
        (1.0, 4e-8, 0.0),
        (1.0, 6e-8, 1.2e-8),
    ] {
        let mut newton = newton();
        newton.shift = before;
        newton.relent(part);
        assert!((newton.shift - after).abs() < 1e-15, "{part} {before}");
    }
}

#[test]
fn places_that_are_no_numbers_are_refused() {
    let frame = newton().frame;
    assert!(frame.finite_slope(&places(1.0, 0.5)).is_ok());
    assert!(frame.finite_slope(&places(f64::NAN, 0.5)).is_err());
}

#[test]
fn absurd_forces_name_the_member_with_the_largest() {
    let frame = newton().frame;
    for (force, named) in [([-1e14, 1.0], 1), ([1.0, -1e14], 2)] {
        let shape =
            Shape { x: vec![ZERO3, [1.0, 0.0, 0.0], [1.5, 0.0, 0.0]], force: force.to_vec() };
        let Some(Error::Absurd { member, .. }) = frame.absurd(&shape) else { panic!("absurd") };
        assert_eq!(member, named);
    }
}
