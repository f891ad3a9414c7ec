//! The orders of the integrators, measured.

use motion::Order;

use crate::common::{at_rest, closed, hanging, paper, rods, run, string};

/// Error at 1 s for steps of `1/n` and `1/2n`, against a much finer run; the order it falls with.
fn measured(order: Order, n: [f64; 2]) -> f64 {
    let system = hanging(&rods(2), &[]);
    let at = string(&[1.0, 1.0], &[1.0, 2.0]);
    let end = |step: f64, order: Order| {
        let mut simulation = at_rest(&system, &at, order);
        run(&mut simulation, 1.0, step);
        simulation.joints_m()[2]
    };
    let exact = end(1.0 / 16_000.0, Order::Fourth);
    let error = |n: f64| {
        let found = end(1.0 / n, order);
        (0..3).map(|k| (found[k] - exact[k]).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(n[0]), error(n[1]));
    (coarse / fine).ln() / (n[1] / n[0]).ln()
}

#[test]
fn rattle_is_of_second_order() {
    let order = measured(Order::Second, [500.0, 2000.0]);
    assert!((order - 2.0).abs() < 0.02, "{order}");
}

#[test]
fn the_composition_is_of_fourth_order() {
    let order = measured(Order::Fourth, [100.0, 400.0]);
    assert!((order - 4.0).abs() < 0.1, "{order}");
}

#[test]
fn the_longer_composition_is_of_eighth_order() {
    let order = measured(Order::Eighth, [40.0, 80.0]);
    assert!((order - 8.0).abs() < 0.4, "{order}");
}

#[test]
fn a_motion_runs_back_to_where_it_began() {
    let at = closed(0.8, 1.0);
    let mut simulation = at_rest(&paper(), &at, Order::Second);
    run(&mut simulation, 0.5, 1e-3);
    for _ in 0..500 {
        simulation.step(-1e-3).unwrap();
    }
    let back = simulation.joints_m();
    for (found, begun) in back.iter().zip(&at) {
        for k in 0..3 {
            assert!((found[k] - begun[k]).abs() < 1e-11, "{back:?}");
        }
    }
}
