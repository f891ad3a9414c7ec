//! What is left open, and what merges, of chains whose degenerate places have closed forms.

use serde_json::json;

use super::evidence::NOTHING;
use super::output::Output;

use crate::run::holding;

/// A census that does not decide everything.
fn census(test: &'static str, end: &str, bars: &str) -> Output {
    let text = format!(
        "gravity_m_s2 = 10\nanchors = {{ start_m = [0, 0, 0], end_m = {end} }}\nbars = [{bars}]\n"
    );
    let folder = holding([("file.toml", text)]);
    let mut output = Output::ended(3, test, &folder, "census file.toml");
    output.are(json!({ "census.complete": false, "census.decided": false }));
    output
}

fn open(key: &str) -> String {
    format!("census.parts[].chain.undecided[].{key}")
}

/// Four bars of 1 m fit into a line of 2 m when one of them points back, by -2 or by +2 times the
/// pull: the forces along (3, -4) have no bound, so the boxes hold w = 0 at H/V = -3/4.
#[test]
fn pulls_without_bound() {
    let bars = "{ length_m = 1, mass_kg = 1, count = 4 }";
    let mut output = census("pulls_without_bound", "[1.2, 0, -1.6]", bars);
    output.is("census.undecided_boxes", 2);
    output.each(&open("reason"), "degenerate");
    output.says(&open("why"), &["as small as cells get"]);
    output.each(&open("pattern_count"), 4);
    let back = [[1, 1, 1, -1], [1, 1, -1, 1], [1, -1, 1, 1], [-1, 1, 1, 1]];
    let forth = back.map(|signs| signs.map(|sign: i32| -sign));
    let [first, second, third, fourth] = forth;
    output.is(&open("patterns[][]"), json!([back, [fourth, third, second, first]]));
    // V = -1 and V = 1 are the faces of the half cube, with the coordinates H and w.
    output.is(&open("chart"), json!(["below", "above"]));
    let at = output.numbers(&open("at[][]"));
    for (at, slope) in at.chunks(4).zip([0.75, -0.75]) {
        assert!(at[0] <= slope && slope <= at[1] && at[1] - at[0] < 1e-6, "{at:?}");
        assert!(at[2] <= 0.0 && 0.0 <= at[3] && at[3] < 1e-6, "{at:?}");
    }
    output.each(&open("pull_n"), json!(null));
    output.is("census.parts[].chain.straight[]", json!([]));
    output.says(
        "census.parts[].chain.topology_unknown",
        &["sides 4, 5 are together as long as the others"],
    );
    output.each("equilibria[].evidence.ladder[].reason.cells", 2);
}

/// Bars of 1 m with 10 and 20 N between anchors 2e-6 m apart, along (3, 4): they lie across it, and
/// their moment about the second anchor, 30 N times 0.4 m, is borne by a pull of 6e6 N along them.
#[test]
fn two_bars_next_to_each_other() {
    let bars = "{ length_m = 1, mass_kg = 1 }, { length_m = 1, mass_kg = 2 }";
    let mut output = census("two_bars_next_to_each_other", "[1.2e-6, 0, 1.6e-6]", bars);
    output.is("census.undecided_boxes", 2);
    output.each(&open("reason"), "degenerate");
    output.says(&open("why"), &["as small as cells get"]);
    output.repeat_at(open, json!({ "pattern_count": 1, "patterns[][]": [-1, 1] }));
    output.is(&open("chart"), json!(["left", "right"]));
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
    let heavy = "{ length_m = 2, mass_kg = 2 }";
    let bars = format!("{heavy}, {{ length_m = 0.5, mass_kg = 0, count = 2 }}, {heavy}");
    let mut output = census("a_gap_just_bridged", "[1, 0, -4]", &bars);
    output.is(&open("reason"), json!(["unloaded"]));
    output.says(&open("why"), &["the force of a bar vanishes here"]);
    // They are pulled or pushed; slack they have one position, which is known to be there.
    output.is(&open("pattern_count"), json!([2]));
    let family = |key: &str| format!("census.parts[].chain.slack_families[].{key}");
    output.is(&family("signs[]"), json!([1, 0, 0, -1]));
    output.is(&family("dimension_in_plane"), 0);
    output.is(&family("is_manifold"), false);
    // Around the force of the second bar, which vanishes where the first bears its own weight.
    output.each(&open("chart.around"), 1);
    let pulls = output.numbers(&open("pull_n[][]"));
    // A pull along them of next to nothing leaves the gap as it is to the third order.
    for pull in pulls.chunks(4) {
        assert!(pull[0] <= 0.0 && 0.0 <= pull[1] && pull[1] - pull[0] < 1e-2, "{pull:?}");
        // The whole weight of the first bar, half of it at the anchor itself.
        assert!(pull[2] <= -20.0 && -20.0 <= pull[3] && pull[3] - pull[2] < 1e-9, "{pull:?}");
    }
}

/// The joint between two slack bars of 1 m, 1 m apart, may be anywhere that these let it.
#[test]
fn a_free_joint() {
    let text = "gravity_m_s2 = 10\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
                bars = [{ length_m = 1, mass_kg = 1 }, { length_m = 1, mass_kg = 0, count = 2 }, \
                { length_m = 1, mass_kg = 1 }]\n";
    let mut output = Output::alone("a_free_joint", text, "solve system.toml");
    output.each("equilibria[].evidence.ladder[].proof.room.free_joints", 1);
    output.is("agreement.free_joints", 1);
    output.each("equilibria[].evidence.ladder[].reason.kind", json!(["no_box", "slack_family"]));
    // Both heavy bars hang upright.
    output.each("equilibria[].energy_j", -10.0);
    output.each("equilibria[].bars[].axial_n", json!([5.0, 0.0, 0.0, 5.0]));
}

/// Three bars of 1 m and 10 N to (1, -2): two hang upright with the second one level between them
/// and without force. Of six equilibria nearer by four merge there, and two are left further off.
#[test]
fn four_merge() {
    let text = "gravity_m_s2 = 10\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, -1] }\n\
                bars = [{ length_m = 1, mass_kg = 1, count = 3 }]\n";
    let mut output =
        Output::alone("four_merge", text, "trace system.toml --vary anchors.end_m.z=-2.2..-1.8:3");
    let point = |key: &str| format!("traces[].points[].{key}");
    let wanted = json!({
        "status": ["complete", "undecided", "complete"], "count": [2, 6], "proved": 2,
        "reasons[]": ["unloaded"], "straight": 0,
    });
    output.are_at(point, wanted);
    let event = |key: &str| format!("traces[].events[].{key}");
    // Two curves touch, each with a fold that is known to half of the digits.
    let kinds = output.values(&event("kind"));
    let count = |kind: &str| kinds.iter().filter(|found| **found == kind).count();
    assert_eq!([kinds.len(), count("fold"), count("unloaded")], [4, 2, 2]);
    output.is(&event("bar"), json!([2, 2]));
    let half = 1e-6;
    output.within(&event("values[]"), -2.0 - half..=-2.0 + half);
    output.within(&event("values_error[]"), 0.0..=20.0 * half);
    output.within(&event("position"), 0.5 - half..=0.5 + half);
    output.within(&event("position_error"), 0.0..=20.0 * half);
    let span_m = 5.0_f64.sqrt();
    output.within(&event("span_m"), span_m - half..=span_m + half);
    let angles = output.numbers(&event("angles_rad[]"));
    for (found, wanted) in angles.iter().zip([0.0, std::f64::consts::FRAC_PI_2, 0.0].iter().cycle())
    {
        assert!((found - wanted).abs() < 1e-2, "{angles:?}");
    }
    // Centres at 0.5, 1 and 1.5 m below the first anchor.
    output.within(&event("energy_j"), -30.0 - 1e-5..=-30.0 + 1e-5);
    output.within(&event("residual"), 0.0..=NOTHING);
    output.within(&event("singular"), 0.0..=1e-2);
    let mut branches = output.numbers(&event("branches[]"));
    branches.sort_by(f64::total_cmp);
    branches.dedup();
    assert_eq!(branches, [3.0, 4.0, 5.0, 6.0]);
    let ends = output.numbers("traces[].branches[].start.event");
    assert!(!ends.is_empty() && ends.iter().all(|event| (1.0..=4.0).contains(event)), "{ends:?}");
    output.is("traces[].checks.mismatches[]", json!([]));
}
