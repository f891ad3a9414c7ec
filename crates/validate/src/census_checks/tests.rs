//! What a census is held against, with an index that is wrong and with numbers that are none.

use model::{Anchors, Bar};

use super::*;

/// Wherever the vertical of the anchors stands, and however the chain is turned about it.
#[test]
fn a_turned_chain_is_found_in_its_box() {
    let anchors = Anchors { start_m: [3.0, -2.0, 0.5], end_m: [3.0, -2.0, -1.5] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let chain = Chain::new("paper", 9.81, anchors, vec![bar; 3]).unwrap();
    let problem = Problem::new(chain).unwrap();
    let census = Census::take(&problem, &census::Settings::default()).unwrap();
    for (k, equilibrium) in census.equilibria.iter().enumerate() {
        let place = |angle: f64, x: [f64; 3]| -> Vector {
            let (sin, cos) = angle.sin_cos();
            let [x, y, z] = [x[0] - 3.0, x[1] + 2.0, x[2]];
            [3.0 + cos * x - sin * y, -2.0 + sin * x + cos * y, z]
        };
        for angle in [0.0, 0.4, 2.5, -1.3] {
            let middles = equilibrium.joints_m.iter().map(|joint| joint.map(Interval::mid));
            let joints_m: Vec<Vector> = middles.map(|x| place(angle, x)).collect();
            let found = nearest(problem.chain(), &census, &joints_m).unwrap();
            assert!(found.number == k + 1 && found.beyond < 1e-14, "{angle}: {found:?}");
        }
    }
}

#[test]
fn either_index_counts() {
    let problem = model::cases::paper();
    let census = Census::take(&problem, &census::Settings::default()).unwrap();
    let same = |census: &Census| -> Vec<bool> {
        visits(&problem, census).unwrap().iter().map(|visit| visit.same_stability).collect()
    };
    assert_eq!(same(&census), [true; 2]);
    // The index in space is the sum of both: one wrong, the sum right; and the other way round.
    let mut wrong = census.clone();
    wrong.equilibria[1].index_in_plane -= 1;
    wrong.equilibria[1].index_out_of_plane += 1;
    assert_eq!(same(&wrong), [true, false]);
    let mut wrong = census;
    wrong.equilibria[0].index_out_of_plane += 1;
    assert_eq!(same(&wrong), [false, true]);
}

#[test]
fn the_larger_of_two_remembers_what_is_none() {
    for (a, b, larger) in [(1.0, 2.0, 2.0), (2.0, 1.0, 2.0), (-2.0, -1.0, -1.0)] {
        assert_eq!(worse(a, b).to_bits(), f64::to_bits(larger));
    }
    for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::NAN, f64::NAN)] {
        assert!(worse(a, b).is_nan(), "{a} {b}");
    }
}

/// An interval from 1 to 2.
#[test]
fn what_lies_outside_is_measured_from_the_nearer_end() {
    let part = Interval::new(1.0, 2.0);
    for (x, off) in [(0.75, 0.25), (1.0, 0.0), (1.5, 0.0), (2.0, 0.0), (4.5, 2.5)] {
        assert_eq!(outside(part, x).to_bits(), f64::to_bits(off), "{x}");
    }
    assert!(outside(part, f64::NAN).is_nan());
}

/// The paper's lowest position 6/100 of 1 kg g m too high, of the 2 kg g of its joints times 3 m: a
/// gap of a hundredth.
#[test]
fn gaps_are_parts_of_the_weight_times_the_length() {
    let problem = model::cases::paper();
    let mut census = Census::take(&problem, &census::Settings::default()).unwrap();
    let lowest = census.equilibria[0].energy_j.mid();
    census.equilibria[0].energy_j = Interval::point(lowest + 0.06 * 9.80665);
    match gaps(&problem, &census) {
        Err(NoCertificate::Gap { gap }) => assert!((gap - 0.01).abs() < 1e-12, "{gap}"),
        other => panic!("{other:?}"),
    }
}

/// Three metres, 2^20 m from the origin: 8 units in the last place of that besides 1e-12.
#[test]
fn places_far_away_are_known_less_well() {
    let far = 2.0_f64.powi(20);
    let anchors = Anchors { start_m: [far, 0.0, 0.0], end_m: [far, 0.0, -2.0] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let chain = Chain::new("far", 9.81, anchors, vec![bar; 3]).unwrap();
    let wanted = 1e-12 + 2.0_f64.powi(20 - 49) / 3.0;
    assert!((placed(&chain) / wanted - 1.0).abs() < 1e-14);
}

/// A joint of a listed position 0.3 m off changes the lengths of its bars by some tenths of 3 m.
#[test]
fn what_is_listed_wrongly_is_out_of_balance() {
    let problem = model::cases::paper();
    let mut census = Census::take(&problem, &census::Settings::default()).unwrap();
    assert!(statics(&problem, &census) < 1e-12);
    let [x, y, z] = census.equilibria[1].joints_m[1].map(Interval::mid);
    census.equilibria[1].joints_m[1] = [x, y, z + 0.3].map(Interval::point);
    let found = statics(&problem, &census);
    assert!(found > 0.02 && found.is_finite(), "{found}");
}

/// Half a metre of three beside the boxes of the nearer of both.
#[test]
fn the_nearest_entry_has_its_number() {
    let problem = model::cases::paper();
    let census = Census::take(&problem, &census::Settings::default()).unwrap();
    for k in 0..2 {
        let mut joints_m: Vec<Vector> =
            census.equilibria[k].joints_m.iter().map(|joint| joint.map(Interval::mid)).collect();
        joints_m[2][2] += if k == 0 { -0.5 } else { 0.5 };
        let found = nearest(problem.chain(), &census, &joints_m).unwrap();
        assert_eq!(found.number, k + 1);
        assert!((found.beyond - 0.5 / 3.0).abs() < 1e-12, "{found:?}");
        joints_m[1][0] = f64::NAN;
        assert_eq!(nearest(problem.chain(), &census, &joints_m), None);
        assert_eq!(nearest(problem.chain(), &census, &joints_m[1..]), None);
    }
}
