//! `census`: two bars hang or stand; the paper's circles; positions that are not isolated.

use serde_json::json;

use super::evidence::NOTHING;
use super::output::Output;
use super::solve::{AXIAL, DEPTH, H, LAMP, LEVEL_V, system_of_level_v};

use crate::run::{good, holding};

/// Weight of a bar of the paper's case, N.
const MG: f64 = 9.806_65;

/// Three bars of 1 m and 10 N to the end.
fn three_bars(end: &str) -> String {
    format!(
        "gravity_m_s2 = 10\nanchors = {{ start_m = [0, 0, 0], end_m = {end} }}\n\
         bars = [{{ length_m = 1, mass_kg = 1, count = 3 }}]\n"
    )
}

fn census(test: &'static str, text: &str) -> Output {
    let folder = holding([("file.toml", text)]);
    Output::json("census", test, &good(&folder, &["census", "file.toml", "--json"]))
}

/// What is known of the list of a chain.
fn of_chain(key: &str) -> String {
    format!("census.parts[].chain.{key}")
}

/// A row of bars told by its joints, by its signs and pulls alone.
#[test]
fn by_signs_and_pulls() {
    let folder = holding([("lamp.toml", LAMP)]);
    let arguments = ["census", "lamp.toml", "--list", "signs", "--json", "--csv", "lamp.csv"];
    let text = good(&folder, &arguments);
    let mut object: serde_json::Value = serde_json::from_str(&text).unwrap();
    // All else is that of the whole census.
    let whole = good(&folder, &["census", "lamp.toml", "--json"]);
    let mut whole: serde_json::Value = serde_json::from_str(&whole).unwrap();
    for of in [&mut object, &mut whole] {
        of["census"]["seconds"] = json!(0.0);
        of["census"]["parts"][0]["chain"]["statistics"]["seconds"] = json!(0.0);
    }
    for key in ["schema_version", "system", "census"] {
        assert_eq!(object[key], whole[key]);
        object.as_object_mut().unwrap().remove(key);
    }
    let test = "by_signs_and_pulls";
    let mut output = Output::json("census --list signs", test, &object.to_string());
    output.is("list", "signs");
    output.is("equilibria[].number", json!([1, 2]));
    output.is("equilibria[].energy_j", json!([-48.0, 48.0]));
    output.is("equilibria[].pattern", json!(["TT", "CC"]));
    output.encloses("equilibria[].pull_n[][]", json!([9.6, -12.8, -9.6, -12.8]));
    output.each("equilibria[].index_in_plane", 0);
    output.is("equilibria[].index_in_space", json!([0, 1]));
    output.is("equilibria[].optimal", json!([true, false]));
    let lines = std::fs::read_to_string(folder.path().join("lamp.csv")).unwrap();
    let mut output = Output::csv("census --list signs --csv", test, &lines);
    output.are(json!({ "equilibrium": [1, 2], "energy_j": [-48.0, 48.0] }));
    output.each("index_in_plane", 0);
    output.is("index_in_space", json!([0, 1]));
    output.is("optimal", json!([true, false]));
    output.is("pattern", json!(["TT", "CC"]));
    output.is("pull_level_n", json!([9.6, -9.6]));
    output.each("pull_upright_n", -12.8);
}

/// The first hangs, the second stands on its anchors.
#[test]
fn it_hangs_or_stands() {
    let mut output = census("it_hangs_or_stands", LEVEL_V);
    output.is("schema_version", 3);
    system_of_level_v(&mut output);
    output.each("equilibria[].solver", "census");
    output.is("equilibria[].energy_j", json!([-10.0 * DEPTH, 10.0 * DEPTH]));
    output.each("equilibria[].joints[].name", json!(["0", "1", "2"]));
    let joints = [-DEPTH, DEPTH].map(|z| [0.0, 0.0, 0.0, 0.5, 0.0, z, 1.0, 0.0, 0.0]);
    output.is("equilibria[].joints[].at_m[]", json!(joints));
    let bar = |key: &str| format!("equilibria[].bars[].{key}");
    output.repeat_at(bar, json!({ "from": ["0", "1"], "to": ["1", "2"] }));
    output.is(&bar("axial_n"), json!([AXIAL, AXIAL, -AXIAL, -AXIAL]));
    // Along a bar at 60 degrees, at the middle joint, and with its weight at the anchor.
    let (least, most) = (H / 2.0, H / 2.0 + 10.0 * DEPTH);
    output.is(&bar("axial_from_n"), json!([most, least, -most, -least]));
    output.is(&bar("axial_to_n"), json!([least, most, -least, -most]));
    output.is(&bar("axial_max_n"), json!([most, most, -most, -most]));
    let ends = [H, -H].map(|h| [h, 0.0, 0.0, h, 0.0, 10.0]);
    output.is(&bar("force_at_end_n[]"), json!(ends));
    let starts = [H, -H].map(|h| [-h, 0.0, 10.0, -h, 0.0, 0.0]);
    output.is(&bar("force_at_start_n[]"), json!(starts));
    let reactions = [H, -H].map(|h| [-h, 0.0, 10.0, h, 0.0, 10.0]);
    output.is("equilibria[].reactions_n.*[]", json!(reactions));
    // Nothing moves in the plane; out of it the standing one falls.
    output.each("equilibria[].in_plane", "minimum");
    output.each("equilibria[].stability.index_in_plane", 0);
    output.is("equilibria[].stability.in_space", json!(["stable", "unstable"]));
    output.is("equilibria[].stability.index_in_space", json!([0, 1]));
    output.each("equilibria[].stability.neutral", 0);
    proof_by_intervals(&mut output);
    output.is("equilibria[].label", json!(["1", "2"]));
    output.repeat(json!({ "equilibria[].circle": null, "equilibria[].mirrored": false }));
    output.is("equilibria[].angles_deg[]", json!([30.0, 150.0, 150.0, 30.0]));
    output.is("equilibria[].angles_signed_deg[]", json!([30.0, 150.0, 150.0, 30.0]));
    output.is("equilibria[].signs[]", json!([1, 1, -1, -1]));
    output.is("equilibria[].energy_scaled", json!([-DEPTH, DEPTH]));
    let at = |key: &str| format!("equilibria[].enclosures.{key}");
    output.encloses(&at("pull_n[][]"), json!([H, -10.0, -H, -10.0]));
    output.encloses(&at("energy_j[]"), json!([-10.0 * DEPTH, 10.0 * DEPTH]));
    let [low, high] = [std::f64::consts::FRAC_PI_6, 5.0 * std::f64::consts::FRAC_PI_6];
    output.encloses(&at("angles_rad[][]"), json!([low, high, high, low]));
    output.encloses(&at("joints_m[][][]"), json!(joints));
    let forces = [H, -H].map(|h| [-h, 0.0, 10.0, h, 0.0, 0.0, h, 0.0, 10.0]);
    output.encloses(&at("multipliers_n[][][]"), json!(forces));
    output.encloses(&at("axial_n[][]"), json!([AXIAL, AXIAL, -AXIAL, -AXIAL]));
    summary(&mut output);
}

/// The rungs of what is found by enclosure: no steps, no second solver.
fn proof_by_intervals(output: &mut Output) {
    let at = |key: &str| format!("equilibria[].evidence.{key}");
    output.is(&at("rung"), json!(["optimal", "complete"]));
    for width in ["residual", "ladder[].proof.residual", "ladder[].proof.box_width"] {
        output.within(&at(width), f64::EPSILON / 2.0..=NOTHING);
    }
    for of in ["residual_of", "ladder[].proof.residual_of"] {
        output.says(&at(of), &["width of the enclosures"]);
    }
    for none in ["iterations", "ladder[].proof.iterations", "nullity", "ladder[].proof.families"] {
        output.each(&at(none), 0);
    }
    // Along and up: 2 l/|F| times 3/4 and 1/4.
    output.near(&at("condition"), 1e-9, json!([3.0, 3.0]));
    output.within(&at("solve_s"), 1e-7..=60.0);
    let rungs = ["converged", "agreed", "verified", "complete", "optimal"];
    output.each(&at("ladder[].rung"), rungs.as_slice());
    let reached = [true, false, true, true, true, true, false, true, true, false];
    output.is(&at("ladder[].reached"), json!(reached));
    let how = ["width of", "census", "Krawczyk", "4 patterns"];
    let how = [&how[..], &["semidefinite"], &how, &["falls in 1 directions"]].concat();
    output.says(&at("ladder[].how"), &how);
    let kinds = ["one_solver_only", "one_solver_only", "no_certificate"];
    output.is(&at("ladder[].reason.kind"), json!(kinds));
    output.each(&at("ladder[].reason.solver"), "census");
    output.within(&at("ladder[].reason.statics"), 0.0..=NOTHING);
    output.is(&at("ladder[].reason.because"), "energy_falls");
    output.is(&at("ladder[].reason.directions"), 1);
    output.within(&at("ladder[].proof.distance"), 0.0..=NOTHING);
    output.each(&at("ladder[].proof.circle"), false);
    output.each(&at("ladder[].proof.in_plane"), 2);
    output.each(&at("ladder[].proof.patterns"), 4);
    output.within(&at("ladder[].proof.cells"), 4.0..=1000.0);
    output.is(&at("ladder[].proof.singular"), false);
}

/// The configurations of two bars in a plane are two points.
fn summary(output: &mut Output) {
    output.are(json!({
        "census.complete": true, "census.decided": true, "census.count": 2, "census.circles": false,
        "census.undecided_boxes": 0, "census.slack_families": 0,
    }));
    output.within("census.seconds", 1e-7..=60.0);
    let at = |key: &str| format!("census.parts[].{key}");
    output.are_at(at, json!({ "count": 2, "framed": 0, "net": null }));
    for none in ["hanging[]", "slack[]"] {
        output.is(&at(none), json!([]));
    }
    let wanted = json!({
        "joints[]": ["0", "1", "2"], "complete": true, "decided": true, "count_in_plane": 2,
        "circle_count": null, "count_by_index[]": [2], "alternating_sum": 2,
        "euler_characteristic": 2, "betti[]": [2], "topology_unknown": null,
    });
    output.are_at(of_chain, wanted);
    for none in ["straight[]", "undecided[]", "slack_families[]"] {
        output.is(&of_chain(none), json!([]));
    }
    output.is("census.energy_unit_j", 10.0);
    output.is("census.energy_unit", "weight times length of one bar");
    output.is("census.energy_symbol", "mgl");
    output.is(&of_chain("check.passed"), true);
    output.is(&of_chain("check.refuted"), false);
    output.is(&of_chain("check.failure"), json!(null));
    let at = |key: &str| of_chain(&format!("statistics.{key}"));
    output.is(&at("bars"), 2);
    output.within(&at("cells"), 4.0..=1000.0);
    // Each cell is tested, each equilibrium proved.
    output.within(&at("tests"), 4.0..=10_000.0);
    output.within(&at("proofs"), 2.0..=1000.0);
    output.within(&at("levels"), 1.0..=64.0);
    output.within(&at("seconds"), 1e-7..=60.0);
}

/// Two circles of equilibria, each met twice by a vertical plane; angles, energies and forces from 40
/// digits, the energies from a Gröbner basis with real-root counting as well.
#[test]
fn circles_of_the_paper() {
    let mut output = Output::told("circles_of_the_paper", ".", "census --case three-equal-bars");
    let first = [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34];
    let [a, b, c] = first;
    let second = [-c, -b, -a];
    let signed = [first, first.map(|x: f64| -x), second, second.map(|x: f64| -x)];
    output.is("equilibria[].angles_signed_deg[]", json!(signed));
    let whole = signed.map(|angles| angles.map(|x: f64| x.rem_euclid(360.0)));
    output.is("equilibria[].angles_deg[]", json!(whole));
    output.is("equilibria[].label", json!(["1", "1'", "2", "2'"]));
    output.is("equilibria[].circle", json!([1, 1, 2, 2]));
    output.is("equilibria[].mirrored", json!([false, true, false, true]));
    let [low, high] = [2.335_468_651_999_305 - 6.0, 3.664_531_348_000_695 - 6.0];
    output.is("equilibria[].energy_scaled", json!([low, low, high, high]));
    output.each("equilibria[].evidence.ladder[].proof.circle", true);
    output.is("equilibria[].evidence.rung", json!(["optimal", "optimal", "complete", "complete"]));
    output.is("equilibria[].in_plane", json!(["minimum", "minimum", "maximum", "maximum"]));
    output.is("equilibria[].stability.index_in_plane", json!([0, 0, 1, 1]));
    output.is("equilibria[].stability.index_in_space", json!([0, 0, 2, 2]));
    output.each("equilibria[].stability.neutral", 1);
    // E2 is E1 upside down.
    output.is("equilibria[].signs[]", json!([1, 1, -1, 1, 1, -1, 1, -1, -1, 1, -1, -1]));
    let [along, up, down] =
        [-0.648_944_835_933_933_6, 2.312_944_292_241_837_6, 0.687_055_707_758_162_4]
            .map(|n| n * MG);
    let of = |along: f64, up, down| [[0.0, along, up], [0.0, -along, down]];
    let all =
        [of(along, up, down), of(-along, up, down), of(along, down, up), of(-along, down, up)];
    output.are(json!({ "equilibria[].reactions_n.*[]": all, "census.circles": true }));
    output.is(&of_chain("circle_count"), 2);
    output.is("census.count", 4);
    // Two minima and two maxima in the plane, where the configurations form a closed curve.
    output.is(&of_chain("count_by_index[]"), json!([2, 2]));
    output.is(&of_chain("alternating_sum"), 0);
    output.is(&of_chain("euler_characteristic"), 0);
    output.is(&of_chain("betti[]"), json!([1, 1]));
}

/// Anchors 1 m apart on one vertical: of three bars of 1 m one points back, and all is straight.
#[test]
fn straight_positions() {
    let mut output = census("straight_positions", &three_bars("[0, 0, -1]"));
    output.are(json!({
        "equilibria[]": [], "census.complete": false, "census.decided": true, "census.count": 0,
    }));
    output.is(&of_chain("straight[].along[]"), json!([1, 1, -1, 1, -1, 1, -1, 1, 1]));
    output.each(&of_chain("straight[].upright"), true);
    output.are_at(of_chain, json!({ "euler_characteristic": null, "betti": null }));
    output.says(&of_chain("topology_unknown"), &["sides 1, 4 are together as long as the others"]);
}

/// Two bars that hang plumb 1 m apart, with two weightless ones of 1 m between: these lie as they
/// like, above or below.
#[test]
fn slack_bars() {
    let text = "gravity_m_s2 = 10\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
                bars = [{ length_m = 1, mass_kg = 1 }, { length_m = 1, mass_kg = 0, count = 2 }, \
                { length_m = 1, mass_kg = 1 }]\n";
    let mut output = census("slack_bars", text);
    let at = |key: &str| of_chain(&format!("slack_families[].{key}"));
    output.is(&at("signs[]"), json!([1, 0, 0, 1, -1, 0, 0, -1]));
    output.encloses(&at("energy_j[]"), json!([-10.0, 10.0]));
    output.encloses(&at("gap_m[]"), json!([1.0, 1.0]));
    output.encloses(&at("pull_n[][]"), json!([0.0, -10.0, 0.0, -10.0]));
    // Each standing bar falls in two directions.
    output.are_at(at, json!({ "index_in_plane": [0, 2], "index_in_space": [0, 4] }));
    output.repeat_at(at, json!({ "dimension_in_plane": 0, "is_manifold": true }));
    output.is("census.energy_unit_j", 80.0);
    output.is("census.energy_unit", "weight times length of the whole chain");
    output.is("census.energy_symbol", "MgL");
}

/// Under a bar that hangs from below its own anchor's height, three of 1 m without mass over 1 m: two
/// along it and one against it fit too. Standing it leaves 2.2 m, over which they reach with one in
/// either way, but straight they do not.
#[test]
fn slack_bars_that_fit_into_a_line() {
    let text = "gravity_m_s2 = 10\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, -1] }\n\
                bars = [{ length_m = 1, mass_kg = 1 }, { length_m = 1, mass_kg = 0, count = 3 }]\n";
    let mut output = census("slack_bars_that_fit_into_a_line", text);
    let at = |key: &str| of_chain(&format!("slack_families[].{key}"));
    output.is(&at("signs[]"), json!([1, 0, 0, 0, -1, 0, 0, 0]));
    output.is(&at("is_manifold"), json!([false, true]));
    output.each(&at("dimension_in_plane"), 1);
    output.encloses(&at("gap_m[]"), json!([1.0, 5.0_f64.sqrt()]));
    output.are(json!({ "census.decided": true, "census.complete": false }));
    output.each("equilibria[].evidence.ladder[].reason.listed", 1);
}

/// A ring of 4 kg on a rope of 10 m between anchors 6 m apart, 3-4-5: 25 N by g = 10, and no other.
#[test]
fn census_of_a_ring() {
    let ring = "gravity_m_s2 = 10\njoints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, ring = { mass_kg = 4 } }\n\
                bars = [{ from = 'A', to = 'B', via = ['ring'], length_m = 10, mass_kg = 0, kind = 'cable', \
                strength_n = 100, safety = 3 }]";
    let mut output = census("census_of_a_ring", ring);
    output.are(json!({
        "equilibria[].bars[].via[]": "ring", "equilibria[].bars[].axial_n": 25.0,
        "equilibria[].bars[].utilisation": 0.25, "equilibria[].weakest.bar": 1,
        "equilibria[].weakest.utilisation": 0.25, "equilibria[].weakest.safety": 4.0,
        "equilibria[].weakest.safety_wanted": 3.0,
    }));
    output
        .is("equilibria[].joints[].at_m[]", json!([-3.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, -4.0]));
    output.is("equilibria[].bars[].force_at_start_n[]", json!([-15.0, 0.0, 20.0]));
    output.is("equilibria[].bars[].force_at_end_n[]", json!([15.0, 0.0, 20.0]));
    output.is("census.complete", true);
    output.is("census.count", 1);
}

/// A row of bars by name, with a weight at its joint: it hangs below its anchors or stands above them.
#[test]
fn census_of_the_lamp() {
    let mut output = census("census_of_the_lamp", LAMP);
    output.is("equilibria[].energy_j", json!([-48.0, 48.0]));
    output.is("equilibria[].energy_scaled", json!([-48.0 / 140.0, 48.0 / 140.0]));
    output.each("equilibria[].joints[].name", json!(["A", "B", "P"]));
    output.is("equilibria[].bars[].axial_n", json!([16.0, 12.0, -16.0, -12.0]));
    let starts = [-9.6, 9.6].map(|x| [x, 0.0, 12.8, x, 0.0, -7.2]);
    output.is("equilibria[].bars[].force_at_start_n[]", json!(starts));
    let ends = starts.map(|forces| forces.map(|n: f64| -n));
    output.is("equilibria[].bars[].force_at_end_n[]", json!(ends));
    // The first bar bears the lamp.
    let forces = [-9.6, 9.6].map(|x| [x, 0.0, 12.8, -x, 0.0, 7.2, -x, 0.0, 7.2]);
    output.encloses("equilibria[].enclosures.multipliers_n[][][]", json!(forces));
    // 3-4-5.
    let angle = 0.75_f64.atan().to_degrees();
    output
        .is("equilibria[].angles_deg[]", json!([angle, 90.0 + angle, 180.0 - angle, 90.0 - angle]));
    output.is("equilibria[].signs[]", json!([1, 1, -1, -1]));
    output.is(&of_chain("joints[]"), json!(["A", "P", "B"]));
    output.is("census.energy_symbol", "MgL");
}

/// A light bar hangs a weight below two others, or stands it above: four positions.
#[test]
fn a_hanger() {
    let text = "gravity_m_s2 = 10
\
                joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [1, 0, 0] }, P = { mass_kg = 1 }, Q = { mass_kg = 1 } }
\
                bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0 }, \
                { from = \"B\", to = \"P\", length_m = 1, mass_kg = 0 }, \
                { from = \"P\", to = \"Q\", length_m = 1, mass_kg = 0 }]
";
    let mut output = census("a_hanger", text);
    // P at ∓√3/2 m, Q 1 m below or above it, 10 N each.
    let energies =
        [-20.0 * DEPTH - 10.0, -20.0 * DEPTH + 10.0, 20.0 * DEPTH - 10.0, 20.0 * DEPTH + 10.0];
    output.is("equilibria[].energy_j", json!(energies));
    output.is("census.count", 4);
    output.is("census.parts[].count", 4);
    output.is("census.parts[].hanging[]", json!([3]));
    let at = |key: &str| format!("equilibria[].evidence.ladder[].proof.system.{key}");
    output.within(&at("width_m"), f64::EPSILON..=NOTHING);
    output.within(&at("width_n"), f64::EPSILON..=NOTHING);
    output.within(&at("distance_n"), 0.0..=NOTHING);
    for (key, count) in [
        ("turns", 0),
        ("slack", 0),
        ("loose_joints", 0),
        ("hanging", 1),
        ("parts", 1),
        ("positions", 4),
    ] {
        output.each(&at(key), count);
    }
    // An upright bar falls to both sides, two of 60 degrees out of their plane.
    output.is("equilibria[].stability.index_in_space", json!([0, 2, 1, 3]));
}

/// A weight on three light bars, in a tripod of 3-4-5 triangles: it hangs or stands.
#[test]
fn a_frame() {
    let mut output = Output::told("a_frame", ".", "census --case tripod");
    // 30 kg at 2.4 m, legs of 3 m: a third of the weight times 3/2.4 in each.
    let leg = 30.0 * 9.806_65 / 3.0 * 3.0 / 2.4;
    output.is("equilibria[].bars[].axial_n", json!([leg, leg, leg, -leg, -leg, -leg]));
    output.is("census.parts[].framed", 1);
    output.is("census.parts[].chain", json!(null));
    output.is("equilibria[].stability.index_in_plane", json!([null, null]));
}

/// Three strands of 2 m, one of two bars, to a knot over the middle of a triangle: 1.2 m out and
/// 1.6 m down.
#[test]
fn a_bridle() {
    let text = "gravity_m_s2 = 10
\
                joints = { A = { at_m = [1.2, 0, 0] }, B = { at_m = [-0.6, 1.0392304845413263, 0] }, \
                C = { at_m = [-0.6, -1.0392304845413263, 0] }, P = { mass_kg = 30 } }
\
                bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 1, count = 2 }, \
                { from = \"B\", to = \"P\", length_m = 2, mass_kg = 1 }, \
                { from = \"C\", to = \"P\", length_m = 2, mass_kg = 1 }]
";
    let mut output = census("a_bridle", text);
    let at = |key: &str| format!("census.parts[].net.{key}");
    let wanted = json!({
        "closures": 2, "knots[]": "P", "swings[]": "A-P.1", "in_plane": false,
    });
    output.are_at(at, wanted);
    output.within(&at("signs"), 1.0..=16.0);
    output.within(&at("cells"), 1.0..=10_000.0);
    output.within(&at("tests"), 1.0..=100_000.0);
    output.is(&at("undecided_boxes"), 0);
}

/// A boom of 5 m with 10 N at its end P, and two strands of 5 m from P to a pulley on its level, 8 m away: P hangs in
/// the middle, 3 m down. Standing or hanging alone the boom would be out of their reach.
#[test]
fn a_boom_on_its_tackle() {
    let text = "gravity_m_s2 = 10
                joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 }, D = { at_m = [8, 0, 0] } }
                bars = [{ from = 'A', to = 'P', length_m = 5, mass_kg = 0 }, \
                { from = 'D', to = 'D', via = ['P'], length_m = 10, mass_kg = 0, kind = 'cable' }]";
    let mut output = census("a_boom_on_its_tackle", text);
    output.is("census.count", 1);
    // Both slopes bear a half of 10 N, with 3/5 of their force: one bar, and two strands of one tension.
    let along = 5.0 * 5.0 / 3.0;
    output.is("equilibria[].bars[].axial_n", json!([along, along / 2.0]));
    output.is("census.parts[].slack[]", json!([2]));
}

/// The same positions as text in columns.
#[test]
fn columns_of_a_census() {
    let folder = holding([("v.toml", LEVEL_V), ("lamp.toml", LAMP)]);
    good(&folder, &["census", "v.toml", "--csv", "v.csv"]);
    good(&folder, &["census", "lamp.toml", "--csv", "lamp.csv"]);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let mut output = Output::csv("census --csv", "columns_of_a_census", &read("v.csv"));
    output.is("equilibrium", json!([1, 1, 1, 2, 2, 2]));
    let halves = |low: f64, high: f64| json!([low, low, low, high, high, high]);
    output.is("energy_j", halves(-10.0 * DEPTH, 10.0 * DEPTH));
    output.each("index_in_plane", 0);
    output.is("index_in_space", json!([0, 0, 0, 1, 1, 1]));
    let rungs = ["optimal", "optimal", "optimal", "complete", "complete", "complete"];
    output.is("rung", json!(rungs));
    output.within("box_width", f64::EPSILON / 2.0..=NOTHING);
    output.repeat(json!({ "joint": [0, 1, 2], "x_m": [0.0, 0.5, 1.0], "y_m": 0.0 }));
    output.is("z_m", json!([0.0, -DEPTH, 0.0, 0.0, DEPTH, 0.0]));
    output.is("reaction_x_n", json!([-H, 0.0, H, H, 0.0, -H]));
    output.repeat(json!({ "reaction_y_n": 0.0, "reaction_z_n": [10.0, 0.0, 10.0] }));
    output.is("force_x_n", json!([-H, H, H, H, -H, -H]));
    output.repeat(json!({ "force_y_n": 0.0, "force_z_n": [10.0, 0.0, 10.0] }));
    // Of the bar that ends at the joint.
    output.is("angle_deg", json!(["", 30.0, 150.0, "", 150.0, 30.0]));
    output.is("axial_n", json!(["", AXIAL, AXIAL, "", -AXIAL, -AXIAL]));
    // Joints by name, in another order than that of the row.
    let mut output = Output::csv("census --csv", "", &read("lamp.csv"));
    output.each("joint", json!(["A", "B", "P"]));
    output.is("z_m", json!([0.0, 0.0, -2.4, 0.0, 0.0, 2.4]));
    output.is("reaction_x_n", json!([-9.6, 9.6, 0.0, 9.6, -9.6, 0.0]));
    output.is("axial_n", json!(["", 12.0, 16.0, "", -12.0, -16.0]));
    output.is("force_x_n", json!([-9.6, 9.6, 9.6, 9.6, -9.6, -9.6]));
    assert!(output.unlisted().is_empty());
}
