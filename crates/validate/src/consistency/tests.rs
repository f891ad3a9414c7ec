//! What rounding explains of short bars far away.

use model::{Anchors, Bar};

use super::*;

/// A light bar of 2^-20 m, 2^20 m from the origin: its ends are stored to 2^-29 m, so that its
/// direction is known to 2^-8, and the force along it, of 1 N, to the square of that: 1.53e-5 N.
#[test]
fn a_force_loses_by_the_square_of_the_angle_of_rounding() {
    let (far, length_m) = (2.0_f64.powi(20), 2.0_f64.powi(-20));
    let [start_m, end_m] = [[far, 0.0, 0.0], [far, 0.0, -length_m]];
    let bar = Bar::homogeneous(length_m, 0.0).unwrap();
    let chain = Chain::new("far", 9.81, Anchors { start_m, end_m }, vec![bar]).unwrap();
    let settings = lagrange::Settings::default();
    let like = lagrange::solve(&model::cases::paper(), &settings).unwrap().equilibrium;
    let (up, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let axial = |off_n: f64| {
        let answer = Equilibrium {
            joints_m: vec![start_m, end_m],
            multipliers_n: vec![up, down],
            reactions_n: model::Reactions { start: up, end: down },
            axial_n: vec![1.0 + off_n],
            ..like.clone()
        };
        let found = consistency(&chain, &answer);
        assert_eq!(found.reactions.to_bits(), 0);
        found.axial
    };
    let explained = 2.0_f64.powi(-16);
    assert_eq!(axial(0.9 * explained).to_bits(), 0);
    assert!((axial(3.0 * explained) - 2.0 * explained).abs() < 1e-14);
}
