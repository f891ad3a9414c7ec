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

/// Bars of 8 kg and 3 kg, each with a quarter of it at its far joint, drawn as (3, 0, 4) and
/// (0, -5, 12) under 10 m/s²: 20 N and 7.5 N of the forces after them are weight, and along them are
/// `(21 - 28)/5` and `(-95 + 186)/13` N. From joint 0 the centres are 1 and 4 + 3 m high, 290 J.
#[test]
fn differences_are_told_in_units_of_weight_and_length() {
    let bars = [(2.0, 8.0), (5.0, 3.0)];
    let bars = bars.map(|(length, mass)| Bar::new(length, mass, 0.25 * length, [0.0; 3]).unwrap());
    let joints_m = vec![[1.0, 2.0, 3.0], [4.0, 2.0, 7.0], [4.0, -3.0, 19.0]];
    let anchors = Anchors { start_m: joints_m[0], end_m: joints_m[2] };
    let chain = Chain::new("two", 10.0, anchors, bars.to_vec()).unwrap();
    let settings = lagrange::Settings::default();
    let like = lagrange::solve(&model::cases::paper(), &settings).unwrap().equilibrium;
    let forces = [[1.0, 2.0, 3.0], [7.0, 11.0, 13.0], [17.0, 19.0, 23.0]];
    let right = Equilibrium {
        energy_j: 290.0,
        joints_m,
        multipliers_n: forces.to_vec(),
        reactions_n: model::Reactions { start: forces[0], end: forces[2] },
        axial_n: vec![-1.4, 7.0],
        ..like
    };
    let off = |change: &dyn Fn(&mut Equilibrium)| {
        let mut answer = right.clone();
        change(&mut answer);
        let found = consistency(&chain, &answer);
        [found.energy, found.axial, found.reactions, found.forces()]
    };
    let told = |found: [f64; 4], wanted: [f64; 4]| {
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{found}, not {wanted}");
        }
    };
    told(off(&|_| ()), [0.0; 4]);
    // 110 N times 7 m, and 110 N.
    told(off(&|a| a.energy_j += 7.7), [0.01, 0.0, 0.0, 0.0]);
    told(off(&|a| a.energy_j -= 7.7), [0.01, 0.0, 0.0, 0.0]);
    told(off(&|a| a.axial_n[0] -= 1.1), [0.0, 0.01, 0.0, 0.01]);
    told(off(&|a| a.axial_n[1] += 2.2), [0.0, 0.02, 0.0, 0.02]);
    told(off(&|a| a.reactions_n.start = [4.0, 6.0, 3.0]), [0.0, 0.0, 5.0 / 110.0, 5.0 / 110.0]);
    told(off(&|a| a.reactions_n.end = [17.0, 14.0, 11.0]), [0.0, 0.0, 13.0 / 110.0, 13.0 / 110.0]);
    // A force of 220 N is the larger unit.
    let large = off(&|a| {
        a.multipliers_n[0] = [0.0, -220.0, 0.0];
        a.reactions_n.start = [0.0, -220.0, 2.2];
    });
    told(large, [0.0, 0.0, 0.01, 0.01]);
    let changes: [fn(&mut Equilibrium); 3] =
        [|a| a.joints_m.truncate(2), |a| a.multipliers_n.truncate(2), |a| a.axial_n.truncate(1)];
    for change in changes {
        assert!(off(&change).iter().all(|x| x.is_nan()));
    }
    assert!(off(&|a| a.axial_n[0] = f64::NAN)[3].is_nan());
    assert!(off(&|a| a.reactions_n.end[1] = f64::NAN)[3].is_nan());
    assert!(off(&|a| a.energy_j = f64::NAN)[0].is_nan());
}

/// Anchors 2^20 m away are stored to 2^-29 m, which 20 N make 20 times 2^-29 J.
#[test]
fn an_energy_is_known_to_the_rounding_of_places() {
    let far = 2.0_f64.powi(20);
    let [start_m, end_m] = [[far, 0.0, 0.0], [far, 0.0, -2.0]];
    let bar = Bar::homogeneous(2.0, 2.0).unwrap();
    let chain = Chain::new("far", 10.0, Anchors { start_m, end_m }, vec![bar]).unwrap();
    let settings = lagrange::Settings::default();
    let like = lagrange::solve(&model::cases::paper(), &settings).unwrap().equilibrium;
    let off = |roundings: f64| {
        let answer = Equilibrium {
            energy_j: -20.0 + roundings * 20.0 * 2.0_f64.powi(-29),
            joints_m: vec![start_m, end_m],
            multipliers_n: vec![[0.0, 0.0, 20.0], [0.0; 3]],
            axial_n: vec![10.0],
            ..like.clone()
        };
        consistency(&chain, &answer).energy
    };
    assert_eq!(off(1.0).to_bits(), 0);
    assert!((off(3.0) / (2.0 * 2.0_f64.powi(-30)) - 1.0).abs() < 1e-14, "{}", off(3.0));
}

#[test]
fn the_worse_of_two_remembers_what_is_none() {
    for (a, b, larger) in [(1.0, 2.0, 2.0), (2.0, 1.0, 2.0), (-2.0, -1.0, -1.0)] {
        assert_eq!(worse(a, b).to_bits(), f64::to_bits(larger));
    }
    for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN)] {
        assert!(worse(a, b).is_nan(), "{a} {b}");
    }
}
