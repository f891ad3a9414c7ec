//! Violations by hand.

use model::{Anchors, Bar};

use super::*;

/// Two bars of 1 m drawn as 1.25 m each (3, 4, 5): a quarter of a metre, of 2 m.
#[test]
fn a_wrong_length_is_a_part_of_the_total() {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.5, 0.0, 0.0] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let chain = Chain::new("two bars", 1.0, anchors, vec![bar; 2]).unwrap();
    let joints_m = [[0.0; 3], [0.75, 0.0, -1.0], [1.5, 0.0, 0.0]];
    let found = judge(&chain, &joints_m, &[[0.0, 0.0, 1.0], [0.0; 3], [0.0, 0.0, 1.0]]);
    assert!((found.length - 0.125).abs() < 1e-14, "{found:?}");
    // The anchors are right, and bear the whole weight.
    assert_eq!((found.closure.to_bits(), found.balance.to_bits()), (0, 0));
}

/// Two bars of 1 m and 1 N hang as a triangle of equal sides: moments about the joint say that the
/// anchors pull by a quarter of a newton over the height. A thousandth too much at the first is left
/// over on bar 1 and on the whole.
#[test]
fn a_force_too_much_is_left_over() {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let chain = Chain::new("triangle", 1.0, anchors, vec![bar; 2]).unwrap();
    let joints_m = [[0.0; 3], [0.5, 0.0, -0.75_f64.sqrt()], [1.0, 0.0, 0.0]];
    let across = 0.25 / 0.75_f64.sqrt();
    for more in [0.0, 1e-3] {
        let forces = [[-across, 0.0, 1.0 + more], [across, 0.0, 0.0], [across, 0.0, 1.0]];
        let found = judge(&chain, &joints_m, &forces);
        let largest = across.hypot(1.0 + more);
        assert!((found.force - more / largest).abs() < 1e-14, "{found:?}");
        assert!((found.balance - more / 2.0).abs() < 1e-14, "{found:?}");
    }
}

/// Bars of 8 and 12 m drawn as (2, 3, 6) and (-4, -3, 12), of 7 and 13 m, from (1, -2, 5); 80 and
/// 30 N at a quarter of each; and forces that are in no balance.
fn crooked() -> (Chain, [Vector; 3], [Vector; 3]) {
    let anchors = Anchors { start_m: [1.0, -2.0, 5.0], end_m: [-1.0, -2.0, 23.0] };
    let bars = [(8.0, 8.0), (12.0, 3.0)];
    let bars = bars.map(|(length, mass)| Bar::new(length, mass, 0.25 * length, [0.0; 3]).unwrap());
    let chain = Chain::new("crooked", 10.0, anchors, bars.to_vec()).unwrap();
    let joints_m = [anchors.start_m, [3.0, 1.0, 11.0], anchors.end_m];
    (chain, joints_m, [[1.0, 2.0, 3.0], [7.0, 11.0, 13.0], [17.0, 19.0, 23.0]])
}

fn close(found: f64, wanted: f64) {
    assert!((found / wanted - 1.0).abs() < 1e-12, "{found}, not {wanted}");
}

/// Bar 1 feels (1, 2, 3), (7, 11, 13) and its weight, (8, 13, -64) together; about a quarter of it
/// `3/4 (2, 3, 6) × (7, 11, 13) - 1/4 (2, 3, 6) × (1, 2, 3) = (-39, 24, 1)/2`. Bar 2 feels the
/// opposite of (7, 11, 13) and (17, 19, 23): (10, 8, -20), and (-531, 512, -49)/2.
#[test]
fn what_is_left_over_on_a_bar_is_told_beyond_rounding() {
    let (chain, joints_m, forces) = crooked();
    let none = Rounding { place_m: 0.0, force_n: 0.0 };
    let some = Rounding { place_m: 0.125, force_n: 0.5 };
    let wanted = [
        (80.0, 1.0, 4329.0_f64.sqrt(), 524.5_f64.sqrt(), 7.0 + 1.0),
        (1179.0_f64.sqrt(), 1.0, 564.0_f64.sqrt(), 136_626.5_f64.sqrt(), 13.0 - 1.0),
    ];
    for (i, (largest, stretch, force, moment, length)) in wanted.into_iter().enumerate() {
        let bar = LoadedBar::new(&chain, i, &joints_m, &forces);
        close(bar.largest_n(), largest);
        close(bar.stretch(&none), stretch);
        close(bar.stretch(&some), stretch - 0.125);
        close(bar.force_left(&none), force);
        close(bar.force_left(&some), force - 0.5);
        close(bar.moment_left(&none), moment);
        close(bar.moment_left(&some), moment - (0.125 * largest + 0.5 * length));
    }
}

/// The whole has (18, 21, -84) N left, and about its first joint `(-2, 0, 18) × (17, 19, 23)` with
/// the weights at (3/2, -5/4) and (3, 3/4): (-939, 844, -76)/2 N m.
#[test]
fn the_worst_of_all_bars_and_the_whole_are_told() {
    let (chain, joints_m, forces) = crooked();
    let found = judge(&chain, &joints_m, &forces);
    close(found.force, 4329.0_f64.sqrt() / 80.0);
    close(found.moment, 136_626.5_f64.sqrt() / 1179.0_f64.sqrt() / 12.0);
    close(found.length, 1.0 / 20.0);
    close(found.balance, 7821.0_f64.sqrt() / 110.0);
    close(found.turn, (0.25 * 1_599_833.0_f64).sqrt() / 110.0 / 20.0);
    assert_eq!((found.closure.to_bits(), found.worst_bar), (0, 2));
    let largest = found.turn.max(found.balance).max(found.moment);
    assert_eq!(found.largest().to_bits(), largest.to_bits());
    assert!(found.passes(largest) && !found.passes(0.999 * largest));
    // 5 and 13 m off its anchors; and forces larger than the weight of all bars.
    let mut moved = joints_m;
    moved[0] = [4.0, -2.0, 9.0];
    close(judge(&chain, &moved, &forces).closure, 5.0 / 20.0);
    moved[2] = [4.0, -14.0, 23.0];
    close(judge(&chain, &moved, &forces).closure, 13.0 / 20.0);
    let large = forces.map(|force| force.map(|x| 16.0 * x));
    let size = 16.0 * 1179.0_f64.sqrt();
    let left = (288.0_f64.powi(2) + 336.0_f64.powi(2) + 306.0_f64.powi(2)).sqrt();
    close(judge(&chain, &joints_m, &large).balance, left / size);
}

/// A violation is the worst where it is larger than those before.
#[test]
fn the_worst_bar_is_the_one_with_the_largest_violation() {
    let (chain, joints_m, forces) = crooked();
    let mut heavy = forces;
    // All of it is left over on the first bar: it is in tension on the one side alone.
    heavy[0] = [0.0, 0.0, 1000.0];
    assert_eq!(judge(&chain, &joints_m, &heavy).worst_bar, 1);
    assert_eq!(judge(&chain, &joints_m[..2], &forces).worst_bar, 0);
    let mut none = forces;
    none[2][1] = f64::NAN;
    assert!(judge(&chain, &joints_m, &none).largest().is_nan());
}

/// 2^20 m from the origin places are stored to 8 units in the last place of that, 2^-29 m.
#[test]
fn places_are_known_to_the_rounding_of_the_farthest_coordinate() {
    let far = 2.0_f64.powi(20);
    let bar = Bar::homogeneous(3.0, 1.0).unwrap();
    let mut anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
    let rounding = |anchors: Anchors| {
        stored_rounding_m(&Chain::new("far", 10.0, anchors, vec![bar; 2]).unwrap()).to_bits()
    };
    assert_eq!(rounding(anchors), f64::to_bits(6.0 * 2.0_f64.powi(-49)));
    anchors.end_m = [1.0, -far, 0.0];
    assert_eq!(rounding(anchors), f64::to_bits(2.0_f64.powi(-29)));
    anchors = Anchors { start_m: [0.0, 0.0, far], end_m: [0.0; 3] };
    assert_eq!(rounding(anchors), f64::to_bits(2.0_f64.powi(-29)));
}
