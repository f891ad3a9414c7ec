//! `solve --tolerances`: ranges, and why there are none.

use std::path::Path;

use serde_json::{Value, json};

use super::output::Output;

use crate::run::{good, holding, run};

/// 2 kg and half a kilogram more or less on a bar of 3 m, straight below an anchor that is known to 0.1 m: the
/// force is that of the weight, 20 N and 5, and P moves with the anchor. Uniform draws deviate by the
/// tolerance over the root of three.
#[test]
fn tolerances_of_a_plumb_bob() {
    let text = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0], at_tolerance_m = 0.1 }, \
                P = { mass_kg = 2, mass_tolerance_kg = 0.5 } }\n\
                bars = [{ from = \"A\", to = \"P\", length_m = 3, mass_kg = 0, strength_n = 50 }]";
    let folder = holding([("bob.toml", text)]);
    let arguments =
        ["solve", "bob.toml", "--tolerances", "--json", "--monte-carlo", "400", "--seed", "7"];
    let command = "solve bob.toml --tolerances --monte-carlo 400 --seed 7";
    let mut output = Output::told("tolerances_of_a_plumb_bob", &folder, command);
    output.is("tolerances.is_proved", true);
    output.is("tolerances.is_stable", true);
    output.is("tolerances.boxes", 1);
    output.is("tolerances.free_turns", 0);
    let [x, y, z, mass] =
        ["A.at_m.x", "A.at_m.y", "A.at_m.z", "P.mass_kg"].map(|n| format!("joints.{n}"));
    output.is("tolerances.numbers[].name", json!([x, y, z, mass]));
    output.is("tolerances.numbers[].given", json!([0.0, 0.0, 0.0, 2.0]));
    output.is("tolerances.numbers[].within", json!([0.1, 0.1, 0.1, 0.5]));
    output.is("tolerances.joints[].name", json!(["A", "P"]));
    // A bound of what vanishes is as wide as the rounding of all forces.
    let rounding = 1e-10;
    for (least, most) in [("least", "most"), ("least_reached", "most_reached")] {
        let path = |of: &str, end: &str| format!("tolerances.{of}.{end}");
        output.near(
            &path("joints[].at_m[]", least),
            rounding,
            json!([-0.1, -0.1, -0.1, -0.1, -0.1, -3.1]),
        );
        output.near(
            &path("joints[].at_m[]", most),
            rounding,
            json!([0.1, 0.1, 0.1, 0.1, 0.1, -2.9]),
        );
        output.near(&path("joints[].reaction_n[]", least), rounding, json!([0.0, 0.0, 15.0]));
        output.near(&path("joints[].reaction_n[]", most), rounding, json!([0.0, 0.0, 25.0]));
        output.near(&path("bars[].axial_n", least), rounding, 15.0);
        output.near(&path("bars[].axial_n", most), rounding, 25.0);
    }
    output.each("tolerances.joints[].at_m[].is_hull", true);
    output.each("tolerances.joints[].reaction_n[].is_hull", true);
    output.each("tolerances.bars[].axial_n.is_hull", true);
    // What no unknown moves depends on its own number alone, which is not named.
    let none = Value::Null;
    output.is("tolerances.joints[].at_m[].most_by", json!([none, none, none, x, y, z]));
    output.is("tolerances.joints[].at_m[].most_change", json!([none, none, none, 0.1, 0.1, 0.1]));
    output.is("tolerances.joints[].reaction_n[].most_by", json!([none, none, mass]));
    output.is("tolerances.joints[].reaction_n[].most_change", json!([none, none, 5.0]));
    // Nothing holds P but its bar.
    output.is("tolerances.joints[].reaction_n", none.clone());
    output.is("tolerances.bars[].axial_n.most_by", mass);
    output.is("tolerances.bars[].axial_n.most_change", 5.0);
    output.is("tolerances.bars[].bar", 1);
    output.is("tolerances.bars[].utilisation[]", json!([0.3, 0.5]));
    // P hangs as far below its anchor wherever that is.
    for (end, name) in ["joint", "from", "to"].into_iter().zip(["P", "A", "A"]) {
        output.is(&format!("tolerances.sag.{end}"), name);
    }
    for end in ["least", "most", "least_reached", "most_reached"] {
        output.near(&format!("tolerances.sag.depth_m.{end}"), rounding, 3.0);
    }
    output.are(json!({
        "tolerances.sag.depth_m.is_hull": true, "tolerances.sag.depth_m.most_by": none.clone(),
        "tolerances.sag.depth_m.most_change": none.clone(), "tolerances.draws.count": 400,
        "tolerances.draws.solved": 400, "tolerances.draws.outside": 0, "tolerances.draws.seed": 7,
        "tolerances.draws.distribution": "uniform",
    }));
    // Of 400 draws the mean is known to 1/20 of the deviation, and that to 1/40 of itself: four times that.
    let third = 3.0_f64.sqrt().recip();
    output.near("tolerances.bars[].drawn_n.mean", 0.03, 20.0);
    output.near("tolerances.bars[].drawn_n.deviation", 0.1, 5.0 * third);
    output.near(
        "tolerances.joints[].drawn_m[].mean",
        0.012,
        json!([0.0, 0.0, 0.0, 0.0, 0.0, -3.0]),
    );
    output.near("tolerances.joints[].drawn_m[].deviation", 0.006, json!(vec![0.1 * third; 6]));
    for (which, deviation) in [("normal", 0.986_58 / 3.0), ("ends", 1.0)] {
        let text = good(&folder, &[&arguments[..], &["--distribution", which]].concat());
        let found: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(found["tolerances"]["draws"]["distribution"], which);
        let drawn = found["tolerances"]["bars"][0]["drawn_n"]["deviation"].as_f64().unwrap();
        assert!((drawn - 5.0 * deviation).abs() < 0.5 * deviation, "{which}: {drawn}");
    }
    columns_of_a_plumb_bob(folder.path());
}

fn columns_of_a_plumb_bob(folder: &Path) {
    let files = ["--csv", "joints.csv", "--bars-csv", "bars.csv"];
    good(folder, &[&["solve", "bob.toml", "--tolerances"][..], &files].concat());
    let columns = |kind: &'static str, file: &str| {
        let text = std::fs::read_to_string(folder.join(file)).unwrap();
        Output::csv(kind, "tolerances_of_a_plumb_bob", &text)
    };
    let rounding = 1e-10;
    let mut joints = columns("solve --tolerances --csv", "joints.csv");
    joints.is("joint", json!(["A", "P"]));
    for (axis, at, pull) in [("x", 0.0, [0.0; 2]), ("y", 0.0, [0.0; 2]), ("z", -3.0, [15.0, 25.0])]
    {
        let ends = ["least", "most"].into_iter().zip([-0.1, 0.1]).zip(pull);
        for ((end, off), pull) in ends {
            joints.near(&format!("{axis}_{end}_m"), rounding, json!([off, at + off]));
            joints.near(&format!("reaction_{axis}_{end}_n"), rounding, json!([pull, ""]));
        }
    }
    let mut bars = columns("solve --tolerances --bars-csv", "bars.csv");
    bars.are(json!({ "bar": 1, "from": "A", "to": "P" }));
    for (end, wanted) in [("least", 15.0), ("most", 25.0)] {
        bars.near(&format!("{end}_n"), rounding, wanted);
        bars.near(&format!("{end}_reached_n"), rounding, wanted);
        bars.near(&format!("{end}_utilisation"), rounding, wanted / 50.0);
    }
    bars.are(json!({ "is_hull": true, "most_by": "joints.P.mass_kg", "most_change_n": 5.0 }));
}

/// A rope that may go slack within its tolerance, and one that may not reach: why nothing is proved.
#[test]
fn tolerances_without_a_proof() {
    let folder = tempfile::tempdir().unwrap();
    let text = |within_m: f64, third_m: f64| {
        format!(
            "joints = {{ A = {{ at_m = [-3, 0, 0] }}, B = {{ at_m = [3, 0, 0] }}, C = {{ at_m = [0, 0, -5] }}, \
             P = {{ mass_kg = 10 }} }}\nbars = [\
             {{ from = 'A', to = 'P', length_m = 5, mass_kg = 0, length_tolerance_m = {within_m} }}, \
             {{ from = 'B', to = 'P', length_m = 5, mass_kg = 0, length_tolerance_m = {within_m} }}, \
             {{ from = 'C', to = 'P', length_m = {third_m}, mass_kg = 0, kind = 'cable', stiffness_n = 1e4 }}]"
        )
    };
    for (within_m, third_m) in [(0.01, 1.001), (4.5, 9.0)] {
        std::fs::write(folder.path().join("ropes.toml"), text(within_m, third_m)).unwrap();
        let (code, said, _) = run(&folder, &["solve", "ropes.toml", "--tolerances", "--json"]);
        assert_eq!(code, Some(3), "{said}");
        let mut output = Output::json("solve", "", &said);
        output.is("tolerances.is_proved", false);
        let words =
            if third_m < 2.0 { "slack and taut: 3" } else { "times the tolerances it is proved" };
        output.says("tolerances.reason", &[words]);
        if third_m < 2.0 {
            output.is("tolerances.may_change[]", 3);
        } else {
            output.within("tolerances.part", 1e-3..=0.5);
        }
    }
}
