//! `funicular study` over rows of bars: their bars by name and range, their counts, and riders on them.

use funicular::prelude::*;
use serde_json::Value;

use crate::run::{stderr, stdout};
use crate::study::{folder, study};

/// A rope of four bars to a weight, and one bar on.
fn rope(mass_kg: f64) -> String {
    format!(
        r#"{{"joints": {{"A": {{"at_m": [0,0,0]}}, "B": {{"at_m": [3,0,0]}}, "P": {{"mass_kg": 5}}}},
        "bars": [{{"from":"A","to":"P","length_m":0.5,"mass_kg":{mass_kg},"count":4}},
                 {{"from":"P","to":"B","length_m":2,"mass_kg":1}}]}}"#
    )
}

#[test]
fn rows_and_ranges_of_bars_are_those_of_the_file() {
    let folder = folder("rows");
    std::fs::write(folder.join("rope.json"), rope(0.1)).unwrap();
    let edited = Problem::parse(&rope(0.7), "rope.json").unwrap();
    let solved = Solve::new().run(&edited).unwrap();
    let wanted = solved.equilibria()[0].energy_j;
    for vary in ["bars.A-P.*.mass_kg=0.7", "bars.A-P.mass_kg=0.7", "bars.1-4.mass_kg=0.7"] {
        let output = study(&folder, &["rope.json", "--vary", vary, "--json"]);
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        let energy = json["points"][0]["energy_j"].as_f64().unwrap();
        assert!((energy - wanted).abs() < 1e-12 * wanted.abs(), "{vary}: {energy} {wanted}");
    }
    for (vary, wanted) in [
        ("bars.A-Q.*.mass_kg=1", "there is no row of bars `A-Q`"),
        ("bars.2-9.mass_kg=1", "there is no bar 9"),
        ("bars.3-2.mass_kg=1", "`3-2` is no bar"),
    ] {
        let output = study(&folder, &["rope.json", "--vary", vary]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(wanted), "{}", stderr(&output));
    }
    let twice = ["--vary", "bars.A-P.*.mass_kg=1", "--vary", "bars.4.mass_kg=2"];
    let output = study(&folder, &[&["rope.json"], &twice[..]].concat());
    assert!(stderr(&output).contains("set one number"), "{}", stderr(&output));
}

/// A rope of 2.5 m in five bars from A to P, another of 2.5 m from P to B, 3 m apart.
const COUNTED: &str = "name = 'counted'\ngravity_m_s2 = 10\n\
    joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 1 } }\n\
    bars = [\n{ from = 'A', to = 'P', length_m = 0.5, mass_kg = 0.4, count = 5, forces = [{ force_n = [0, 1, 0] }] },\n\
    { from = 'P', to = 'B', length_m = 2.5, mass_kg = 1 }]\n";

/// A count changes as in the file, with length, mass and loads of the row as they are.
#[test]
fn a_count_is_that_of_the_file() {
    let folder = folder("count");
    std::fs::write(folder.join("counted.toml"), COUNTED).unwrap();
    for vary in ["bars.1.count=1..4", "bars.2-5.count=1,2..4", "bars.A-P.count=1,2,3,4"] {
        let arguments = ["--vary", vary, "--of", "joints.P.z", "--of", "joints.A-P.3.y", "--json"];
        let output = study(&folder, &[&["counted.toml"], &arguments[..]].concat());
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(json["units"][0], "bars");
        for (count, point) in (1_u32..).zip(json["points"].as_array().unwrap()) {
            let part = 5.0 / f64::from(count);
            let row = format!(
                "length_m = {:?}, mass_kg = {:?}, count = {count}, forces = [{{ force_n = [0, {part:?}, 0] }}]",
                0.5 * part,
                0.4 * part
            );
            let (before, after) = COUNTED.split_once("length_m = 0.5").unwrap();
            let after = after.split_once("}] }").unwrap().1;
            let text = format!("{before}{row} }}{after}");
            let solved = Solve::new().run(&Problem::parse(&text, "x.toml").unwrap()).unwrap();
            let (system, found) = (solved.system(), &solved.equilibria()[0]);
            assert_eq!(point["rises_deg"].as_array().unwrap().len(), system.members().len());
            let wanted = found.joints_m[system.joint("P").unwrap()][2];
            assert!((point["of"][0].as_f64().unwrap() - wanted).abs() < 1e-12, "{vary} {count}");
            let third = system.joint("A-P.3").map(|joint| found.joints_m[joint][1]);
            let off = point["of"][1].as_f64().zip(third).map(|(a, b)| (a - b).abs() < 1e-12);
            assert_eq!((off, point["of"][1].is_null()), (third.map(|_| true), third.is_none()));
        }
    }
    // A chain: two bars of 2.5 m over 3 m hang 2 m deep.
    let chain = "anchors = { start_m = [0, 0, 0], end_m = [3, 0, 0] }\n\
                 bars = [{ length_m = 1.25, mass_kg = 1, count = 4 }]\n";
    std::fs::write(folder.join("chain.toml"), chain).unwrap();
    let output =
        study(&folder, &["chain.toml", "--vary", "bars.4.count=2,8", "--csv", "c.csv", "--json"]);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!((json["points"][0]["sag_m"].as_f64().unwrap() - 2.0).abs() < 1e-12);
    let csv = std::fs::read_to_string(folder.join("c.csv")).unwrap();
    let cells: Vec<_> = csv.lines().map(|line| line.split(',').count()).collect();
    assert_eq!(cells, [cells[0]; 3], "{csv}");
    for (vary, wanted) in [
        ("bars.1.count=0", "`0` is no count"),
        ("bars.1.count=2..1", "`2..1` is no count"),
        ("bars.*.count=2", "these bars are of several rows"),
        ("bars.1.count=4000000000", "a whole number from 1 to"),
    ] {
        let output = study(&folder, &["counted.toml", "--vary", vary]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(wanted), "{}", stderr(&output));
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
    for (point, first_m) in json["points"].as_array().unwrap().iter().zip([2.5, 5.0, 7.5]) {
        // As with these lengths and masses in the file.
        let [a, b] = [first_m / 4.0, (10.0 - first_m) / 2.0];
        let text = text
            .replace(
                "length_m = 1, mass_kg = 0.1",
                &format!("length_m = {a:?}, mass_kg = {:?}", 0.1 * a),
            )
            .replace(
                "length_m = 3, mass_kg = 0.3",
                &format!("length_m = {b:?}, mass_kg = {:?}", 0.1 * b),
            );
        let solved = Solve::new().run(&Problem::parse(&text, "x.toml").unwrap()).unwrap();
        let wanted = solved.equilibria()[0].joints_m[solved.system().joint("rider").unwrap()];
        for (found, wanted) in point["of"].as_array().unwrap().iter().zip(wanted) {
            assert!((found.as_f64().unwrap() - wanted).abs() < 1e-9, "{first_m} {found} {wanted}");
        }
    }
    for (vary, wanted) in [
        ("joints.A.share=0.5", "not where two rows of bars meet"),
        ("joints.rider.share=1", "length"),
    ] {
        let output = study(&folder, &["rider.toml", "--vary", vary]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(wanted), "{}", stderr(&output));
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
