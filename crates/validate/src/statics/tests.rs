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
