//! What is left open, and what merges, of chains whose degenerate places have closed forms.

use super::table;

fn open(key: &str) -> String {
    format!("census.parts[].chain.undecided[].{key}")
}

/// Four bars of 1 m fit into a line of 2 m when one of them points back, by -2 or by +2 times the
/// pull: the forces along (3, -4) have no bound, so the boxes hold w = 0 at H/V = -3/4.
#[test]
fn pulls_without_bound() {
    let [mut output] = table::outputs("pulls_without_bound");
    let at = output.numbers(&open("at[][]"));
    for (at, slope) in at.chunks(4).zip([0.75, -0.75]) {
        assert!(at[0] <= slope && slope <= at[1] && at[1] - at[0] < 1e-6, "{at:?}");
        assert!(at[2] <= 0.0 && 0.0 <= at[3] && at[3] < 1e-6, "{at:?}");
    }
}

/// Bars of 1 m with 10 and 20 N between anchors 2e-6 m apart, along (3, 4): they lie across it, and
/// their moment about the second anchor, 30 N times 0.4 m, is borne by a pull of 6e6 N along them.
#[test]
fn two_bars_next_to_each_other() {
    let [mut output] = table::outputs("two_bars_next_to_each_other");
    // V/|H|, and the unit of force over |H|: that of a power of two of kg above 0.75, which is half
    // of what hangs at the joints.
    let at = output.numbers(&open("at[][]"));
    for (at, slope) in at.chunks(4).zip([0.75, -0.75]) {
        assert!(at[0] <= slope && slope <= at[1] && at[1] - at[0] < 1e-8, "{at:?}");
        let w = 10.0 / 4.8e6;
        assert!(at[2] <= w && w <= at[3] && at[3] - at[2] < 1e-8 * w, "{at:?}");
    }
    let pulls = output.numbers(&open("pull_n[][]"));
    for (pull, sign) in pulls.chunks(4).zip([1.0, -1.0]) {
        // What bears the weights themselves is some 10 N of these.
        let near = |ends: &[f64], wanted: f64| {
            ends.iter().all(|end| (end - wanted).abs() < 30.0) && ends[0] < ends[1]
        };
        assert!(near(&pull[..2], -4.8e6 * sign) && near(&pull[2..], 3.6e6 * sign), "{pull:?}");
    }
}

/// A bar of 2 m hangs, and one stands on the last anchor as heavily; between them two of 0.5 m without
/// mass just bridge 1 m. The pull of these turns the one back by as much as the other gives way.
#[test]
fn a_gap_just_bridged() {
    let [mut output] = table::outputs("a_gap_just_bridged");
    let pulls = output.numbers(&open("pull_n[][]"));
    // A pull along them of next to nothing leaves the gap as it is to the third order.
    for pull in pulls.chunks(4) {
        assert!(pull[0] <= 0.0 && 0.0 <= pull[1] && pull[1] - pull[0] < 1e-2, "{pull:?}");
        // The whole weight of the first bar, half of it at the anchor itself.
        assert!(pull[2] <= -20.0 && -20.0 <= pull[3] && pull[3] - pull[2] < 1e-9, "{pull:?}");
    }
}

/// Three bars of 1 m and 10 N to (1, -2): two hang upright with the second one level between them
/// and without force. Of six equilibria nearer by four merge there, and two are left further off.
#[test]
fn four_merge() {
    let [mut output] = table::outputs("four_merge");
    let event = |key: &str| format!("traces[].events[].{key}");
    // Two curves touch, each with a fold that is known to half of the digits.
    let kinds = output.values(&event("kind"));
    let count = |kind: &str| kinds.iter().filter(|found| **found == kind).count();
    assert_eq!([kinds.len(), count("fold"), count("unloaded")], [4, 2, 2]);
    let angles = output.numbers(&event("angles_rad[]"));
    for (found, wanted) in angles.iter().zip([0.0, std::f64::consts::FRAC_PI_2, 0.0].iter().cycle())
    {
        assert!((found - wanted).abs() < 1e-2, "{angles:?}");
    }
    let mut branches = output.numbers(&event("branches[]"));
    branches.sort_by(f64::total_cmp);
    branches.dedup();
    assert_eq!(branches, [3.0, 4.0, 5.0, 6.0]);
    let ends = output.numbers("traces[].branches[].start.event");
    assert!(!ends.is_empty() && ends.iter().all(|event| (1.0..=4.0).contains(event)), "{ends:?}");
}
