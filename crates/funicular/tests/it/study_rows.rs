//! `funicular study` over rows of bars: their bars by name and range, their counts, and riders on them.

use serde_json::Value;

use crate::run::{fails, stderr, stdout};
use crate::study::{folder, study};

/// A rope of four bars to a weight, and one bar on.
fn rope(mass_kg: f64) -> String {
    format!(
        r#"{{"joints": {{"A": {{"at_m": [0,0,0]}}, "B": {{"at_m": [3,0,0]}}, "P": {{"mass_kg": 5}}}},
        "bars": [{{"from":"A","to":"P","length_m":0.5,"mass_kg":{mass_kg},"count":4}},
                 {{"from":"P","to":"B","length_m":2,"mass_kg":1}}]}}"#
    )
}

/// A rope of 2.5 m in five bars from A to P, another of 2.5 m from P to B, 3 m apart.
const COUNTED: &str = "name = 'counted'\ngravity_m_s2 = 10\n\
    joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 1 } }\n\
    bars = [\n{ from = 'A', to = 'P', length_m = 0.5, mass_kg = 0.4, count = 5, forces = [{ force_n = [0, 1, 0] }] },\n\
    { from = 'P', to = 'B', length_m = 2.5, mass_kg = 1 }]\n";

/// (`branches` holds it against the edited file.)
#[test]
fn a_count_is_that_of_the_file() {
    let folder = folder("count");
    std::fs::write(folder.join("counted.toml"), COUNTED).unwrap();
    // A chain: two bars of 2.5 m over 3 m hang 2 m deep.
    let chain = "anchors = { start_m = [0, 0, 0], end_m = [3, 0, 0] }\n\
                 bars = [{ length_m = 1.25, mass_kg = 1, count = 4 }]\n";
    std::fs::write(folder.join("chain.toml"), chain).unwrap();
    let output =
        study(&folder, &["chain.toml", "--vary", "bars.4.count=2,8", "--csv", "c.csv", "--json"]);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["units"][0], "bars");
    assert!((json["points"][0]["sag_m"].as_f64().unwrap() - 2.0).abs() < 1e-12);
    let csv = std::fs::read_to_string(folder.join("c.csv")).unwrap();
    let cells: Vec<_> = csv.lines().map(|line| line.split(',').count()).collect();
    assert_eq!(cells, [cells[0]; 3], "{csv}");
    for (vary, wanted) in [
        ("bars.1.count=0", "`0` is not a count"),
        ("bars.1.count=2..1", "`2..1` is not a count"),
        ("bars.*.count=2", "these bars are of several rows"),
        ("bars.1.count=4000000000", "a whole number from 1 to"),
    ] {
        fails(&study(&folder, &["counted.toml", "--vary", vary]), 2, wanted);
    }
    let arguments = ["--vary", "bars.1.mass_kg=1", "--vary", "bars.1.count=2"];
    let output = study(&folder, &[&["counted.toml"], &arguments[..]].concat());
    assert!(stderr(&output).contains("a row with a count has equal bars"), "{}", stderr(&output));
}

/// A rope of 10 m and a tenth of a kilogram a metre, whose rider is at another place of it.
#[test]
fn a_rider_moves_along_its_rope() {
    let folder = folder("rider");
    let text = "joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, rider = { mass_kg = 5 } }\n\
                bars = [{ from = 'A', to = 'rider', length_m = 1, mass_kg = 0.1, count = 4 },\n\
                { from = 'rider', to = 'B', length_m = 3, mass_kg = 0.3, count = 2 }]\n";
    std::fs::write(folder.join("rider.toml"), text).unwrap();
    let arguments = ["--vary", "joints.rider.share=0.25..0.75:3", "--of", "joints.rider", "--json"];
    let output = study(&folder, &[&["rider.toml"], &arguments[..]].concat());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&json["units"][0], &json["of"][2]), (&"1".into(), &"joints.rider.z".into()));
    // With half of the rope on either side of 6 m it hangs in the middle.
    let [x, _, z] = [0, 1, 2].map(|k| json["points"][1]["of"][k].as_f64().unwrap());
    assert!(x.abs() < 1e-2 && z < -3.9, "{x} {z}");
    for (vary, wanted) in [
        ("joints.A.share=0.5", "not where two rows of bars meet"),
        ("joints.rider.share=1", "length"),
    ] {
        fails(&study(&folder, &["rider.toml", "--vary", vary]), 2, wanted);
    }
}

#[test]
fn parameters_in_step_have_a_column_each() {
    let folder = folder("zip");
    std::fs::write(folder.join("rope.json"), rope(0.1)).unwrap();
    let vary = ["--zip", "--vary", "joints.P.mass_kg=11,12", "--vary", "bars.5.mass_kg=21,22"];
    let output = study(&folder, &[&["rope.json"], &vary[..]].concat());
    let said = stdout(&output);
    assert!(
        said.contains("joints.P.mass_kg") && said.lines().all(|l| l.chars().count() <= 80),
        "{said}"
    );
    for pair in [["11", "21"], ["12", "22"]] {
        let row = |line: &str| line.split_whitespace().take(2).eq(pair);
        assert!(said.lines().any(row), "{said}");
    }
}
