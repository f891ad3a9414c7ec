//! Roots by hand.

use super::*;

/// Forces of 3 across and 4 up and down, along bars of 5: the pull is exact, and is known to be so
/// after one step that leads nowhere.
#[test]
fn a_pull_without_any_residual_is_looked_past_once() {
    let bars = [-4.0, 4.0].map(|carried| Bar { length: 5.0, carried });
    let mut signs = Signs::new(&bars, [6.0, 0.0], 1e-12);
    signs.shape = vec![Signed { u: [1.0, 0.0], axial: 0.0, sign: 1.0 }; 2];
    let Some([x, z]) = signs.root([3.0, 0.0]) else { panic!("no root") };
    assert!((x - 3.0).abs() <= 0.0 && z.abs() <= 0.0);
    assert_eq!(signs.passes, 2);
}
