//! The simple pendulum against elliptic functions, and the numbers of the IFToMM library.

use motion::Order;

use crate::common::{G, at_rest, hanging, links, run};
use crate::elliptic::elliptic;

/// Angle of a pendulum of length 1 released at `start` from rest.
fn angle(start: f64, time_s: f64) -> f64 {
    let (quarter, amplitude) = elliptic((0.5 * start).sin());
    // The phase is reduced to one period, where the recursion keeps its digits.
    let phase = (quarter + G.sqrt() * time_s) % (4.0 * quarter);
    2.0 * ((0.5 * start).sin() * amplitude(phase).sin()).asin()
}

#[test]
fn elliptic_functions_give_the_numbers_of_the_library() {
    // IFToMM library of computational benchmarks, A01: mass 1, length 1, from (-1, 0) at rest, g
    // 9.81.
    for (time_s, x, y) in [
        (5.0, -0.942_305_435_043_8, -0.334_754_338_414),
        (10.0, -0.275_087_462_576_1, -0.961_419_205_099_1),
    ] {
        let theta = angle(-std::f64::consts::FRAC_PI_2, time_s);
        println!("{} {}", theta.sin() - x, -theta.cos() - y);
        assert!((theta.sin() - x).abs() < 1e-12 && (-theta.cos() - y).abs() < 1e-12);
    }
}

#[test]
fn a_released_pendulum_follows_the_elliptic_function_to_twelve_digits() {
    let system = hanging(&links(1), &[1.0]);
    let at = [[0.0; 3], [-1.0, 0.0, 0.0]];
    let mut pendulum = at_rest(&system, &at, Order::Fourth);
    for time_s in [5.0, 10.0] {
        run(&mut pendulum, 5.0, 2e-4);
        let theta = angle(-std::f64::consts::FRAC_PI_2, time_s);
        let end = pendulum.joints_m()[1];
        println!("{:e} {:e}", end[0] - theta.sin(), end[2] + theta.cos());
        assert!((end[0] - theta.sin()).abs() < 1e-12, "{end:?} {theta}");
        assert!((end[2] + theta.cos()).abs() < 1e-12);
    }
}

#[test]
fn a_pendulum_in_space_keeps_its_angular_momentum() {
    let system = hanging(&links(1), &[2.0]);
    let mut pendulum = at_rest(&system, &[[0.0; 3], [0.6, 0.0, -0.8]], Order::Second);
    pendulum.push(&[[0.0; 3], [0.0, 1.5, 0.0]]).unwrap();
    // About the vertical: x v_y - y v_x.
    let momentum = |s: &motion::Simulation| {
        let (x, v) = (s.joints_m()[1], s.velocities_m_s()[1]);
        x[0] * v[1] - x[1] * v[0]
    };
    let before = momentum(&pendulum);
    assert!((before - 0.6 * 0.75).abs() < 1e-15);
    run(&mut pendulum, 10.0, 1e-3);
    assert!((momentum(&pendulum) - before).abs() < 1e-12, "{}", momentum(&pendulum) - before);
}
