//! The frame with two stays, by hand.

use super::*;

/// 8 N at the corner of a square: the stay bears √2 times as much, bar 3-4 is pressed by 8 N. Half
/// a newton too much in the bar is left over at the corner, more than the 1/64 of the load that is allowed.
#[test]
fn the_corner_of_the_frame_is_in_balance() {
    let entry = |bar_n: &str| {
        frame(&StayedFrame {
            force_n: 8.0,
            tolerance: 1.0 / 64.0,
            diagonal_n: "11.313708498984761".to_owned(),
            bar_n: bar_n.to_owned(),
        })
    };
    for (bar_n, broken_n) in [("-8.0", 0.0), ("-8.5", 0.5)] {
        let entry = entry(bar_n);
        let check = entry.by_hand.as_ref().unwrap();
        assert!((check.broken_n - broken_n).abs() < 1e-14, "{check:?}");
        assert_eq!(check.allowed_n.to_bits(), f64::to_bits(0.125));
        let [stay, bar] = &entry.numbers[..] else { panic!("{entry:?}") };
        assert!((stay.ours - 8.0 * 2.0_f64.sqrt()).abs() < 1e-14);
        assert!((bar.ours + 8.0).abs() < 1e-15 && (bar.published + 8.0 + broken_n).abs() < 1e-15);
        assert!((bar.allowed - (8.0 + broken_n) / 64.0).abs() < 1e-15);
    }
}
