//! The equilibrium next to a shape, in every command that takes one: two springs that stand up as a
//! gable or hang down, in closed forms.

use std::path::Path;

use crate::run::{column, fed, program, stdout, words};
use funicular::prelude::*;
use serde_json::Value;

/// Feet 6 m apart, bars of 5 m and EA = 1000 N: unloaded the ridge is 4 m above or below the feet.
const GABLE: &str = r#"{"name": "gable", "gravity_m_s2": 10, "plane": "xz",
"joints": {"A": {"at_m": [-3, 0, 0]}, "B": {"at_m": [3, 0, 0]}, "P": {"mass_kg": 10}},
"bars": [{"from": "A", "to": "P", "length_m": 5, "mass_kg": 0, "stiffness_n": 1000},
{"from": "B", "to": "P", "length_m": 5, "mass_kg": 0, "stiffness_n": 1000}]}"#;

const UP: &str = "joint,x_m,y_m,z_m\nA,-3,0,0\nB,3,0,0\nP,0.1,0,3.9\n";

/// Upward force of both bars on the ridge at a height, N: each has the length l = √(9 + h²) and pushes
/// with 1000 N (5 − l)/5 along itself.
fn held_n(height_m: f64) -> f64 {
    let length_m = 3.0_f64.hypot(height_m);
    400.0 * (5.0 - length_m) * height_m / length_m
}

/// The height at which they hold this load: on the branch that stands, where the force falls with
/// the height, from where it is largest, l = (5 · 9)^(1/3), to 4 m; by bisection.
fn height_m(load_n: f64) -> f64 {
    let (mut low, mut high) = ((45.0_f64.cbrt().powi(2) - 9.0).sqrt(), 4.0);
    assert!(held_n(low) > load_n);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        *(if held_n(middle) > load_n { &mut low } else { &mut high }) = middle;
    }
    low
}

/// What the program says, with the words of its errors in one line.
fn run(folder: &Path, arguments: &[&str], input: &str) -> (Option<i32>, String, String) {
    let output = fed(program(folder, arguments), input);
    let error = words(&output).replace(" \u{2502}", "");
    (output.status.code(), stdout(&output), error)
}

#[track_caller]
fn json(folder: &Path, arguments: &[&str]) -> Value {
    let (code, out, error) = run(folder, arguments, "");
    assert_eq!(code, Some(0), "{arguments:?}: {out}{error}");
    serde_json::from_str(&out).unwrap()
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("gable.json", GABLE), ("up.csv", UP)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

#[track_caller]
fn close(found: &Value, wanted: f64, within: f64) {
    let found = found.as_f64().unwrap();
    assert!((found - wanted).abs() <= within, "{found} is not {wanted} within {within:e}");
}

#[test]
fn a_shape_is_csv_or_an_answer_or_a_grid() {
    let folder = folder();
    let at = folder.path();
    let solve = |near: &[&str]| json(at, &[&["solve", "gable.json", "--json"], near].concat());
    // Without a shape it is the lowest, which hangs.
    let lowest = solve(&[]);
    assert!(lowest["equilibria"][0]["joints"][2]["at_m"][2].as_f64().unwrap() < -4.0);
    assert_eq!(
        (lowest["near"].is_null(), &lowest["equilibria"][1]["evidence"]["rung"]),
        (true, &"optimal".into())
    );
    let up = solve(&["--near", "up.csv"]);
    std::fs::write(at.join("up.json"), up.to_string()).unwrap();
    let grid = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"2\">\
        <Points><DataArray NumberOfComponents=\"3\" format=\"ascii\">-3 0 0 3 0 0 0.1 0 3.9</DataArray></Points>\
        <Cells><DataArray Name=\"connectivity\" format=\"ascii\">0 2 1 2</DataArray>\
        <DataArray Name=\"offsets\" format=\"ascii\">2 4</DataArray><DataArray Name=\"types\" format=\"ascii\">3 3</DataArray>\
        </Cells></Piece></UnstructuredGrid></VTKFile>";
    std::fs::write(at.join("up.vtu"), grid).unwrap();
    let height = height_m(100.0);
    for (name, moved) in [
        ("up.csv", 0.1_f64.hypot(3.9 - height)),
        ("up.json", 0.0),
        ("up.vtu", 0.1_f64.hypot(3.9 - height)),
    ] {
        let found = solve(&["--near", name]);
        for e in found["equilibria"].as_array().unwrap() {
            close(&e["joints"][2]["at_m"][2], height, 1e-9);
            assert_eq!(e["stability"]["index_in_space"], 0);
        }
        close(&found["near"]["moved_m"], moved, 1e-9);
        close(
            &found["near"]["lower_j"],
            lowest["equilibria"][0]["energy_j"].as_f64().unwrap(),
            1e-9,
        );
    }
    // From standard input, and a line for people.
    let (code, out, _) = run(at, &["solve", "gable.json", "--near", "-"], UP);
    assert!(
        code == Some(0) && out.contains("The stable equilibrium next to the shape given"),
        "{out}"
    );
    assert!(
        out.split_whitespace().collect::<Vec<_>>().join(" ").contains("another is lower, by"),
        "{out}"
    );
}

/// The second line bears twice the load.
#[test]
fn every_line_of_a_batch_is_solved_next_to_the_shape() {
    let folder = folder();
    let line = GABLE.replace('\n', " ");
    let lines = format!("{line}\n{}\n", line.replace("\"mass_kg\": 10", "\"mass_kg\": 20"));
    let (code, out, error) =
        run(folder.path(), &["solve", "--batch", "-", "--near", "up.csv"], &lines);
    assert_eq!(code, Some(0), "{error}");
    let heights: Vec<f64> = out
        .lines()
        .map(|line| {
            let found: Value = serde_json::from_str(line).unwrap();
            found["equilibria"][1]["joints"][2]["at_m"][2].as_f64().unwrap()
        })
        .collect();
    assert!(
        (heights[0] - height_m(100.0)).abs() < 1e-9 && (heights[1] - height_m(200.0)).abs() < 1e-9
    );
    // Both cannot be read from there.
    let (code, _, error) = run(folder.path(), &["solve", "--batch", "-", "--near", "-"], &lines);
    assert!(code == Some(2) && error.contains("cannot both come from standard input"), "{error}");
}

/// The gable stands under up to 310 N; the lowest equilibrium always hangs.
#[test]
fn a_study_follows_the_branch_that_it_begins_on() {
    let folder = folder();
    let study = |vary: &str, near: &[&str]| {
        let vary = format!("joints.P.mass_kg={vary}");
        let arguments = [&["study", "gable.json", "--json", "--vary", &vary], near].concat();
        let (code, out, error) = run(folder.path(), &arguments, "");
        let found: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{error}"));
        (code, found["points"].as_array().unwrap().clone())
    };
    let near = ["--near", "up.csv"];
    let (code, points) = study("0.5..30.5:31", &near);
    assert_eq!((code, points.len()), (Some(0), 31));
    for point in points {
        let height = height_m(10.0 * point["values"][0].as_f64().unwrap());
        close(&point["rises_deg"][0], height.atan2(3.0).to_degrees(), 1e-8);
        assert_eq!(point["agrees"], true);
    }
    for point in study("0.5..30.5:31", &[]).1 {
        assert!(point["rises_deg"][0].as_f64().unwrap() < -50.0, "{point}");
    }
    // Beyond, the branch ends, and no other is followed.
    let (code, points) = study("20.5..40.5:5", &near);
    let ended = |point: &Value| {
        let reason = point["reason"].as_str();
        reason.is_some_and(|words| {
            ["the branch ends here", "not converged"].iter().any(|end| words.contains(end))
        })
    };
    let ends: Vec<bool> = points.iter().map(ended).collect();
    assert_eq!((code, ends), (Some(3), vec![false, false, false, true, true]), "{points:?}");
}

/// Each bar has the stiffness 200 N/m along itself, and the force −200 N/m (5 − l) turns with it.
#[test]
fn modes_derivatives_and_motions_are_those_of_the_shape() {
    let folder = folder();
    let at = folder.path();
    let height = height_m(100.0);
    let length = 3.0_f64.hypot(height);
    let [level, upright] = [3.0 / length, height / length];
    let turned = -200.0 * (5.0 - length) / length;
    let stiffness = [[level, upright], [upright, level]]
        .map(|[along, across]| 400.0 * along * along + 2.0 * turned * across * across);
    let near = ["gable.json", "--near", "up.csv"];
    let found = json(at, &[&["modes"], &near[..], &["--json"]].concat());
    let modes = found["equilibria"][0]["modes"].as_array().unwrap();
    assert_eq!((found["equilibria"].as_array().unwrap().len(), modes.len()), (1, 2));
    for (mode, stiffness) in modes.iter().zip(stiffness) {
        close(&mode["omega2_s2"], stiffness / 10.0, 1e-8);
    }
    let problem = Problem::parse(GABLE, "gable.json").unwrap();
    let shape = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.1, 0.0, 3.9]];
    let derivatives = Derivatives::new().run(&problem.near(&shape).unwrap()).unwrap();
    let change =
        derivatives.gradient("joints.P.at_m.z").unwrap().by("joints.P.force_n.z").unwrap().value;
    assert!((change - 1.0 / stiffness[1]).abs() < 1e-9, "{change}");
    let (code, out, _) = run(
        at,
        &[&["derivatives"], &near[..], &["--of", "joints.P.at_m.z", "--json"]].concat(),
        "",
    );
    let by_weight: Value = serde_json::from_str(&out).unwrap();
    assert!(code == Some(0), "{by_weight}");
    let motion = ["--from", "rest", "--time", "1", "--out", "rest.csv"];
    let (code, out, error) = run(at, &[&["simulate"], &near[..], &motion[..]].concat(), "");
    assert_eq!(code, Some(0), "{out}{error}");
    let rest = std::fs::read_to_string(at.join("rest.csv")).unwrap();
    let heights = column(&rest, "joint_P_z_m");
    assert!(heights.len() > 100 && heights.iter().all(|z| (z - height).abs() < 1e-9));
}

#[test]
fn a_shape_that_is_none_of_this_system_is_bad_input() {
    let folder = folder();
    for (name, text, says) in [
        ("unknown.csv", UP.replace('P', "Q"), "the system has no joint \"Q\""),
        ("missing.csv", UP[..UP.find('P').unwrap()].to_owned(), "no place for joint \"P\""),
        (
            "together.csv",
            UP.replace("0.1,0,3.9", "3,0,0"),
            "joints \"B\" and \"P\" are drawn at one place",
        ),
        ("nan.csv", UP.replace("3.9", "nan"), "z_m must be a finite number"),
        (
            "two.json",
            "{\"joints_m\": [[0, 0, 0], [1, 0, 0]]}".to_owned(),
            "2 joints, and the system 3",
        ),
        ("empty.csv", String::new(), "the file is empty"),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
        for command in [
            &["solve"][..],
            &["modes"],
            &["derivatives"],
            &["study", "--vary", "gravity_m_s2=9,10"],
        ] {
            let (code, out, error) =
                run(folder.path(), &[command, &["gable.json", "--near", name]].concat(), "");
            assert_eq!((code, out.as_str()), (Some(2), ""), "{name}: {error}");
            assert!(error.contains(says), "{name}: {error}");
        }
    }
    let (code, _, error) = run(folder.path(), &["solve", "gable.json", "--near", "none.csv"], "");
    assert!(code == Some(2) && error.contains("cannot be read"), "{error}");
    // A line of a batch has the same words.
    let line = GABLE.replace('\n', " ");
    let (code, out, _) =
        run(folder.path(), &["solve", "--batch", "-", "--near", "together.csv"], &line);
    assert!(code == Some(2) && out.contains("are drawn at one place"), "{out}");
}

/// What is found from a shape that is far from every equilibrium is said to be no neighbour of it.
#[test]
fn a_shape_far_from_every_equilibrium_is_said_to_be_so() {
    let folder = folder();
    for far in ["0,0,400", "300,0,-4", "0,0,0.01"] {
        let shape = UP.replace("0.1,0,3.9", far);
        let (code, out, error) =
            run(folder.path(), &["solve", "gable.json", "--near", "-"], &shape);
        let says = ["Not the neighbour of the shape given", "not converged", "no minimum near"];
        let said = out.clone() + &error;
        assert_eq!(code, Some(3), "{far}: {said}");
        assert!(says.iter().any(|words| said.contains(words)), "{far}: {said}");
    }
}
