//! `study`, `derivatives` and `trace`: over the weight everything scales, over the span of two bars
//! and over the lengths of a 3-4-5 triangle there are closed forms.

use serde_json::{Value, json};

use super::evidence::NOTHING;
use super::output::Output;
use super::solve::{AXIAL, DEPTH, H, LAMP, LEVEL_V, system_of_lamp, system_of_level_v};

use crate::run::holding;

fn folder() -> tempfile::TempDir {
    holding([("v.toml", LEVEL_V), ("lamp.toml", LAMP)])
}

/// The level V under 10 and 20 N a bar.
#[test]
fn study_of_a_chain() {
    let folder = folder();
    let command = "study v.toml --vary gravity_m_s2=10,20 --csv v.csv";
    let mut output = Output::told("study_of_a_chain", &folder, command);
    output.is("schema_version", 3);
    system_of_level_v(&mut output);
    output.are(json!({ "parameters[]": "gravity_m_s2", "units[]": "m/s^2" }));
    let at = |key: &str| format!("points[].{key}");
    output.each(&at("path"), 1);
    output.is(&at("values[]"), json!([10.0, 20.0]));
    output.each(&at("span_m"), 1.0);
    output.is(&at("energy_j"), json!([-10.0 * DEPTH, -20.0 * DEPTH]));
    output.each(&at("lowest_joint"), "1");
    output.each(&at("lowest_m[]"), json!([0.5, 0.0, -DEPTH]));
    output.each(&at("sag_m"), DEPTH);
    // Both bars bear the same at their anchors, (H, 10 N) along (1, √3)/2: either may be named.
    let anchor = 0.5 * H + 10.0 * DEPTH;
    let found = output.numbers(&at("tension_n[]"));
    for (pair, wanted) in found.chunks(2).zip([anchor, 2.0 * anchor]) {
        assert!([1.0, 2.0].contains(&pair[0]) && (pair[1] - wanted).abs() < 1e-11, "{pair:?}");
    }
    let wanted = json!({
        "compression_n": null, "rises_deg[]": [-60.0, 60.0], "rung": "optimal", "agrees": true,
        "check_failed": false,
    });
    output.repeat_at(at, wanted);
    output.within(&at("joints_differ_m"), 0.0..=NOTHING);
    output.within(&at("forces_differ_n"), 0.0..=NOTHING);
    let ends = |h: f64, w: f64| [[-h, 0.0, w], [h, 0.0, w]];
    output.is(&at("reactions_n.*[]"), json!([ends(H, 10.0), ends(2.0 * H, 20.0)]));
    let mut output = Output::file("study --csv", "study_of_a_chain", folder.path().join("v.csv"));
    output.is("gravity_m_s2", json!([10.0, 20.0]));
    output.each("span_m", 1.0);
    // Of joint 0, then of joint 2, row by row.
    output.is("#_x_n", json!([-H, H, -2.0 * H, 2.0 * H]));
    output.each("#_y_n", 0.0);
    output.is("#_z_n", json!([10.0, 10.0, 20.0, 20.0]));
    output.is("energy_j", json!([-10.0 * DEPTH, -20.0 * DEPTH]));
    output.repeat(json!({
        "sag_m": DEPTH, "lowest_joint": 1, "lowest_x_m": 0.5, "lowest_z_m": -DEPTH,
    }));
    output.is("tension_n", json!([anchor, 2.0 * anchor]));
    output.within("tension_bar", 1.0..=2.0);
    output.each("rise_#_deg", json!([-60.0, 60.0]));
    columns_of_every_study(&mut output);
}

/// What is alike for both systems.
fn columns_of_every_study(output: &mut Output) {
    output.repeat(json!({
        "path": 1, "agrees": true, "evidence": "optimal", "lowest_y_m": 0.0, "compression_n": "",
        "compression_bar": "", "refused": "",
    }));
}

/// The paper's chain, whose third bar is pushed.
#[test]
fn study_of_the_paper() {
    let folder = folder();
    let command = "study --case three-equal-bars --vary gravity_m_s2=10 --csv paper.csv";
    let mut output = Output::told("study_of_the_paper", &folder, command);
    // The force of the ground at D, 0.6489 mg level and 0.6871 mg up, along the bar at beta.
    let (sine, cosine) = 73.920_588_792_231_34_f64.to_radians().sin_cos();
    let pushed = 10.0 * (0.648_944_835_933_933_6 * sine + 0.687_055_707_758_162_4 * cosine);
    output.is("points[].compression_n[]", json!([3, pushed]));
    let mut output =
        Output::file("study --csv", "study_of_the_paper", folder.path().join("paper.csv"));
    output.are(json!({ "compression_n": pushed, "compression_bar": 3 }));
}

/// Anchors further apart than the bars reach.
#[test]
fn study_of_too_few_bars() {
    let folder = folder();
    let mut output =
        Output::told("study_of_too_few_bars", &folder, "study v.toml --vary anchors.end_m.x=1,3");
    output.is("points[].refused", true);
    let reason = "the anchors \"0\" and \"2\" are 3 m apart and the members between them reach only 2 m: 1 m are missing";
    output.is("points[].reason", reason);
}

/// The lamp with 2 and 4 kg.
#[test]
fn study_of_a_system() {
    let folder = folder();
    let command = "study lamp.toml --vary joints.P.mass_kg=2,4 --csv lamp.csv --of joints.P.z";
    let mut output = Output::told("study_of_a_system", &folder, command);
    output.is("schema_version", 3);
    system_of_lamp(&mut output);
    output.is("parameters[]", "joints.P.mass_kg");
    output.is("units[]", "kg");
    output.is("of[]", "joints.P.z");
    output.repeat(json!({ "points[].of[]": -2.4, "points[].span_m": 5.0 }));
    let at = |key: &str| format!("points[].{key}");
    output.each(&at("path"), 1);
    output.are_at(at, json!({ "values[]": [2.0, 4.0], "energy_j": [-48.0, -96.0] }));
    output.each(&at("lowest_joint"), "P");
    output.each(&at("lowest_m[]"), json!([1.8, 0.0, -2.4]));
    output.each(&at("sag_m"), 2.4);
    output.is(&at("tension_n[]"), json!([1.0, 16.0, 1.0, 32.0]));
    output.each(&at("compression_n"), json!(null));
    // Bar by bar in their directions: (1.8, -2.4) and (3.2, 2.4).
    let rises = [-0.8_f64, 0.6].map(|sin| sin.asin().to_degrees());
    let wanted = json!({
        "rises_deg[]": rises, "rung": "optimal", "agrees": true, "check_failed": false,
    });
    output.repeat_at(at, wanted);
    output.within(&at("joints_differ_m"), 0.0..=NOTHING);
    output.within(&at("forces_differ_n"), 0.0..=NOTHING);
    let forces = [1.0, 2.0].map(|k| [-9.6, 0.0, 12.8, 9.6, 0.0, 7.2].map(|n: f64| k * n));
    output.is(&at("reactions_n.*[]"), json!(forces));
    let mut output =
        Output::file("study --csv", "study_of_a_system", folder.path().join("lamp.csv"));
    output.is("joints.P.mass_kg", json!([2.0, 4.0]));
    output.each("span_m", 5.0);
    output.is("energy_j", json!([-48.0, -96.0]));
    output.repeat(json!({
        "sag_m": 2.4, "joints.P.z": -2.4, "lowest_joint": "P", "lowest_x_m": 1.8,
        "lowest_z_m": -2.4,
    }));
    output.is("tension_n", json!([16.0, 32.0]));
    output.each("tension_bar", 1);
    for (anchor, x, z) in [("A", -9.6, 12.8), ("B", 9.6, 7.2)] {
        output.is(&format!("{anchor}_x_n"), json!([x, 2.0 * x]));
        output.each(&format!("{anchor}_y_n"), 0.0);
        output.is(&format!("{anchor}_z_n"), json!([z, 2.0 * z]));
    }
    output.each("rise_#_deg", json!(rises));
    columns_of_every_study(&mut output);
}

/// What every kind of derivatives says of the lamp.
fn about_lamp(output: &mut Output) {
    output.is("schema_version", 3);
    output.system("lamp", [3, 2], [7.0, 2.0, 10.0]);
}

/// Each bar alone gives under its force F across itself with l/F; both stand at a right angle.
#[test]
fn stiffness_of_anchors() {
    let folder = folder();
    let mut output = Output::told("stiffness_of_anchors", &folder, "derivatives lamp.toml");
    about_lamp(&mut output);
    output.is("anchors[].of", json!(["A", "A", "B", "B"]));
    output.is("anchors[].by", json!(["A", "B", "A", "B"]));
    // Across bar 1 along (0.8, 0.6): 16/3 N/m; across bar 2 along (0.6, -0.8): 12/4 N/m; across
    // both, one after the other.
    let xx = 16.0 / 3.0 * 0.64 + 3.0 * 0.36;
    let xz = 16.0 / 3.0 * 0.48 - 3.0 * 0.48;
    let zz = 16.0 / 3.0 * 0.36 + 3.0 * 0.64;
    let yy = 1.0 / (3.0 / 16.0 + 4.0 / 12.0);
    let stiffness = [1.0, -1.0, -1.0, 1.0]
        .map(|s| [[s * xx, 0.0, s * xz], [0.0, s * yy, 0.0], [s * xz, 0.0, s * zz]]);
    output.is("anchors[].stiffness_n_m[][]", json!(stiffness));
}

/// From `x = (s² + a² - b²)/2s` and `z² = a² - x²`, over the sides a, b and s.
#[test]
fn gradient_of_a_height() {
    let folder = folder();
    let command = "derivatives lamp.toml --of joints.P.at_m.z --csv z.csv";
    let mut output = Output::told("gradient_of_a_height", &folder, command);
    about_lamp(&mut output);
    output.are(json!({ "of": "joints.P.at_m.z", "value": -2.4 }));
    let wanted = [
        ("bars.1.length_m", -0.8, "m/m"),
        ("bars.1.mass_kg", 0.0, "m/kg"),
        ("bars.2.length_m", -0.6, "m/m"),
        ("bars.2.mass_kg", 0.0, "m/kg"),
        ("joints.A.at_m.x", -0.48, "m/m"),
        ("joints.A.at_m.y", 0.0, "m/m"),
        ("joints.A.at_m.z", 0.64, "m/m"),
        ("joints.B.at_m.x", 0.48, "m/m"),
        ("joints.B.at_m.y", 0.0, "m/m"),
        ("joints.B.at_m.z", 0.36, "m/m"),
        ("joints.P.mass_kg", 0.0, "m/kg"),
        ("joints.P.force_n.x", 0.0, "m/N"),
        ("joints.P.force_n.y", 0.0, "m/N"),
        ("joints.P.force_n.z", 0.0, "m/N"),
    ];
    output.is("derivatives[].parameter", wanted.map(|(name, ..)| name).as_slice());
    output.is("derivatives[].value", wanted.map(|(_, value, _)| value).as_slice());
    output.is("derivatives[].unit", wanted.map(|(.., unit)| unit).as_slice());
    let mut output =
        Output::file("derivatives --csv", "gradient_of_a_height", folder.path().join("z.csv"));
    output.is("parameter", wanted.map(|(name, ..)| name).as_slice());
    output.is("derivative", wanted.map(|(_, value, _)| value).as_slice());
    output.is("unit", wanted.map(|(.., unit)| unit).as_slice());
}

/// Of 20 N bar 1 bears `20 a (5 - x)/5 |z|`, bar 2 `20 b x/5 |z|`, anchor A `20 (5 - x)/5` upwards.
#[test]
fn derivatives_by_a_length() {
    let folder = folder();
    let command = "derivatives lamp.toml --by bars.1.length_m";
    let mut output = Output::told("derivatives_by_a_length", &folder, command);
    about_lamp(&mut output);
    output.is("by", "bars.1.length_m");
    output.is("unit", "m");
    output.is("joints_m.*[]", json!([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.6, 0.0, -0.8]));
    output.is("axial_n[]", json!([-3.0, 0.0]));
    output.is("reactions_n.*[]", json!([1.8, 0.0, -2.4, -1.8, 0.0, 2.4]));
}

/// Hanging and standing under 10 to 20 N a bar: angles stay, forces and energies scale.
#[test]
fn branches_over_gravity() {
    let folder = folder();
    let command = "trace v.toml --vary gravity_m_s2=10,20 --csv v.csv";
    let mut output = Output::told("branches_over_gravity", &folder, command);
    output.is("schema_version", 3);
    system_of_level_v(&mut output);
    let at = |key: &str| format!("traces[].{key}");
    output.is(&at("parameters[]"), "gravity_m_s2");
    output.is(&at("units[]"), "m/s^2");
    output.is(&at("points[].position"), json!([0.0, 1.0]));
    output.is(&at("points[].values[]"), json!([10.0, 20.0]));
    output.repeat_at(at, json!({ "points[].span_m": 1.0, "points[].status": "complete" }));
    // The configurations of two bars in a plane are two points.
    let wanted = json!({
        "points[].count": 2, "points[].by_index[]": 2, "points[].alternating_sum": 2,
        "points[].euler_characteristic": 2, "points[].circles": false, "points[].families": 0,
        "directions[][]": [1.0, 0.0],
    });
    output.repeat_at(at, wanted);
    output.is(&at("branches[].id"), json!([1, 2]));
    output.repeat_at(at, json!({ "branches[].start": "path", "branches[].end": "path" }));
    output.are_at(at, json!({ "events[]": [], "checks.between": 1 }));
    for none in ["added", "disagreements", "euler_violations"] {
        output.is(&at(&format!("checks.{none}")), 0);
    }
    for none in ["mismatches[]", "undecided[]", "unfollowed[]", "incomplete[]"] {
        output.is(&at(&format!("checks.{none}")), json!([]));
    }
    let at = |key: &str| format!("traces[].branches[].points[].{key}");
    let positions = output.numbers(&at("position"));
    assert!(positions.len() >= 4 && positions.windows(2).filter(|p| p[0] > p[1]).count() == 1);
    let each = |of: &dyn Fn(f64, f64) -> Value| -> Value {
        let mut sign = 1.0;
        let mut before = 0.0;
        let mut all = Vec::new();
        for position in &positions {
            sign = if *position < before { -1.0 } else { sign };
            before = *position;
            all.push(of(sign, 10.0 + 10.0 * position));
        }
        all.into()
    };
    output.is(&at("values[]"), each(&|_, w| json!(w)));
    output.each(&at("span_m"), 1.0);
    output.is(&at("grid"), json!([1, 2, 1, 2]));
    let ends = |position: &f64| position.rem_euclid(1.0).abs() <= 0.0;
    output.is(&at("proved"), positions.iter().map(ends).collect::<Vec<_>>());
    let down = 0.1 * H;
    output.is(&at("pull_n[]"), each(&|s, w| json!([s * w * down, -w])));
    let [low, high] = [std::f64::consts::FRAC_PI_6, 5.0 * std::f64::consts::FRAC_PI_6];
    let angles = |s: f64, _: f64| if s > 0.0 { json!([low, high]) } else { json!([high, low]) };
    output.is(&at("angles_rad[]"), each(&angles));
    output.is(&at("energy_j"), each(&|s, w| json!(-s * w * DEPTH)));
    output.is(&at("axial_n[]"), each(&|s, w| json!(vec![s * w * 0.1 * AXIAL; 2])));
    output.each(&at("index_in_plane"), 0);
    output.is(&at("index_in_space"), each(&|s, _| json!(i32::from(s < 0.0))));
    columns_of_branches(&std::fs::read_to_string(folder.path().join("v.csv")).unwrap());
}

fn columns_of_branches(text: &str) {
    let mut output = Output::csv("trace --csv", "branches_over_gravity", text);
    let branches = output.numbers("branch");
    let positions = output.numbers("position");
    let each = |of: &dyn Fn(f64, f64) -> Value| -> Value {
        let rows = branches.iter().zip(&positions);
        rows.map(|(branch, at)| of(3.0 - 2.0 * branch, 10.0 + 10.0 * at)).collect()
    };
    output.each("path", 1);
    output.is("gravity_m_s2", each(&|_, w| json!(w)));
    output.each("span_m", 1.0);
    let ends: Vec<bool> = positions.iter().map(|at| at.rem_euclid(1.0).abs() <= 0.0).collect();
    output.is("proved", ends.clone());
    let grid: Vec<Value> = positions
        .iter()
        .zip(&ends)
        .map(|(at, end)| if *end { json!(at + 1.0) } else { json!("") })
        .collect();
    output.is("grid", grid);
    output.each("event", "");
    output.is("pull_horizontal_n", each(&|s, w| json!(s * w * 0.1 * H)));
    output.is("pull_vertical_n", each(&|_, w| json!(-w)));
    output.is("energy_j", each(&|s, w| json!(-s * w * DEPTH)));
    output.each("index_in_plane", 0);
    output.is("index_in_space", each(&|s, _| json!(i32::from(s < 0.0))));
    let [low, high] = [std::f64::consts::FRAC_PI_6, 5.0 * std::f64::consts::FRAC_PI_6];
    let angles = |s: f64, _: f64| if s > 0.0 { json!([low, high]) } else { json!([high, low]) };
    output.is("angle_#_rad", each(&angles));
    output.is("axial_#_n", each(&|s, w| json!(vec![s * w * 0.1 * AXIAL; 2])));
}

/// Three bars between level anchors: pairs meet and end at a span of √(3/2) m, as reflected images
/// of each other; beyond two equilibria are left. And 4 m are too far.
#[test]
fn folds_of_the_level_chain() {
    let folder = folder();
    let command =
        "trace --case three-equal-bars --vary anchors.end_m.z=0 --vary anchors.end_m.x=1.1,1.3,4";
    let mut output = Output::told("folds_of_the_level_chain", &folder, command);
    let at = |key: &str| format!("traces[].events[].{key}");
    output.is(&at("id"), json!([1, 2, 3, 4, 5]));
    output.is(&at("kind"), json!(["fold", "fold", "fold", "fold", "straight"]));
    let span = 1.5_f64.sqrt();
    let spans = [span, span, span, span, 3.0];
    output.near(&at("span_m"), 1e-10, json!(spans));
    output.near(&at("values[]"), 1e-10, json!(spans.map(|span| [0.0, span])));
    // 1.1, 1.3 and 4 m stand at 0, 1/2 and 1.
    let fold = (span - 1.1) / 0.4;
    let positions = [fold, fold, fold, fold, 0.5 + 1.7 / 5.4];
    output.near(&at("position"), 1e-9, json!(positions));
    // As far from the closed form as is admitted, at most; `1e-15` are digits of the parameter.
    let found = output.numbers(&at("position"));
    let errors = output.numbers(&at("position_error"));
    for ((found, wanted), error) in found.iter().zip(positions).zip(&errors) {
        assert!((found - wanted).abs() <= error + 1e-15 && *error < 1e-9, "{found} {error}");
    }
    let found = output.numbers(&at("values[]"));
    let errors = output.numbers(&at("values_error[]"));
    let wanted = spans.iter().flat_map(|span| [0.0, *span]);
    for ((found, wanted), error) in found.iter().zip(wanted).zip(&errors) {
        assert!((found - wanted).abs() <= error + 1e-15 && *error < 1e-9, "{found} {error}");
    }
    output.within(&at("residual"), 0.0..=NOTHING);
    output.within(&at("singular"), 0.0..=1e-4);
    // Each closes the chain, and its energy is that of its angles: centres of three bars.
    let angles = output.numbers(&at("angles_rad[]"));
    let energies = output.numbers(&at("energy_j"));
    assert_eq!((angles.len(), energies.len()), (15, 5));
    for ((angles, energy), span) in angles.chunks(3).zip(&energies).zip(spans) {
        let x: f64 = angles.iter().map(|angle| angle.sin()).sum();
        let z: f64 = angles.iter().map(|angle| -angle.cos()).sum();
        assert!((x - span).abs() < 1e-9 && z.abs() < 1e-9, "{angles:?}");
        let [a, b, c] = [angles[0].cos(), angles[1].cos(), angles[2].cos()];
        let wanted = -9.806_65 * (2.5 * a + 1.5 * b + 0.5 * c);
        assert!((energy - wanted).abs() < 1e-9, "{energy} {wanted}");
    }
    // Each branch that ends in an event is named by it, two by two.
    let named = output.numbers(&at("branches[]"));
    let ends = output.numbers("traces[].branches[].end.event");
    assert_eq!((named.len(), ends.len()), (10, 10));
    // Its last point says so, too.
    assert_eq!(output.numbers("traces[].branches[].points[].event"), ends);
    for (k, pair) in named.chunks(2).enumerate() {
        let count = ends.iter().filter(|event| (*event - (k + 1) as f64).abs() < 0.5).count();
        assert!(count == 2 && pair[0] < pair[1], "{named:?} {ends:?}");
    }
    // The two that are left end where the chain is straight.
    assert!((named[8] - 1.0).abs() < 0.5 && (named[9] - 10.0).abs() < 0.5, "{named:?}");
    output.is("traces[].points[].status", json!(["complete", "complete", "refused"]));
    output.is("traces[].points[].count", json!([10, 2]));
    let reason = "the anchors \"0\" and \"3\" are 4 m apart and the members between them reach only 3 m: 1 m are missing";
    output.is("traces[].points[].reason", reason);
}
