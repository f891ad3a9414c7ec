//! `solve` into columns, line by line and of several files: the numbers of the level V and the
//! lamp.

use serde_json::{Value, json};

use super::output::Output;
use super::solve::{AXIAL, DEPTH, LAMP, LEVEL_V, refusals_of_a_fall, system_of_level_v};

use crate::run::{good, holding, ran};

#[test]
fn columns_of_answers() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    std::fs::write(folder.path().join("lamp.toml"), LAMP).unwrap();
    let files = ["--csv", "lamp.csv", "--bars-csv", "lamp-bars.csv"];
    good(&folder, &[&["solve", "lamp.toml"], &files[..]].concat());
    let test = "columns_of_answers";
    let solvers = |count: usize| json!([vec!["lagrange"; count], vec!["energy"; count]]);
    let mut output = Output::csv("solve --csv", test, &read("lamp.csv"));
    output.is("solver", solvers(3));
    output.repeat(json!({
        "joint": ["A", "B", "P"], "x_m": [0.0, 5.0, 1.8], "y_m": 0.0, "z_m": [0.0, 0.0, -2.4],
        "reaction_x_n": [-9.6, 9.6, 0.0], "reaction_y_n": 0.0, "reaction_z_n": [12.8, 7.2, 0.0],
    }));
    let mut output = Output::csv("solve --bars-csv", test, &read("lamp-bars.csv"));
    output.is("solver", solvers(2));
    output.repeat(json!({ "bar": [1, 2], "from": ["A", "P"], "to": ["P", "B"] }));
    for force in ["axial_n", "axial_from_n", "axial_to_n", "axial_max_n"] {
        output.each(force, json!([16.0, 12.0]));
    }
    for (end, sign) in [("start", 1.0), ("end", -1.0)] {
        output.each(&format!("{end}_x_n"), json!([-9.6 * sign, -9.6 * sign]));
        output.each(&format!("{end}_y_n"), 0.0);
        output.each(&format!("{end}_z_n"), json!([12.8 * sign, -7.2 * sign]));
    }
}

/// The level V in one line, a misspelt one, and one that cannot hang.
#[test]
fn lines_of_a_batch() {
    let v = r#"{"name":"level V","gravity_m_s2":10,"anchors":{"start_m":[0,0,0],"end_m":[1,0,0]},"bars":[{"length_m":1,"mass_kg":1,"count":2}]}"#;
    let falls = r#"{"gravity_m_s2":10,"joints":{"A":{"at_m":[0,0,0]},"P":{"mass_kg":1}},"bars":[{"from":"A","to":"P","length_m":1,"mass_kg":0,"kind":"strut"}]}"#;
    let wrong = v.replace("mass_kg", "masskg");
    let folder = holding([("three.jsonl", format!("{v}\n{wrong}\n{falls}\n"))]);
    let result = ran(&folder, &["solve", "--batch", "three.jsonl"]);
    assert_eq!(result.status.code(), Some(2));
    let text = String::from_utf8(result.stdout).unwrap();
    let (first, rest) = text.split_once('\n').unwrap();
    answered(first, "line", &json!(1), "lines_of_a_batch");
    let mut output = Output::lines("solve --batch, refused", "lines_of_a_batch", rest);
    output.is("line", json!([2, 3]));
    output.says("error", &["unknown key `masskg`", "moves on without end"]);
    output.is("key", "bars[1].masskg");
    // Where the key begins in its line, in characters from 1.
    output.is("column", wrong.find("\"masskg\"").unwrap() + 1);
    output.says("help", &["did you mean `mass_kg`?"]);
    refusals_of_a_fall(&mut output);
}

/// An answer among others is the object of one answer, with the place of its system before it.
fn answered(text: &str, origin: &str, place: &Value, test: &'static str) {
    let mut object: Value = serde_json::from_str(text).unwrap();
    let found = object.as_object_mut().unwrap().remove(origin);
    assert_eq!(found.as_ref(), Some(place));
    let mut output = Output::json("solve", test, &object.to_string());
    system_of_level_v(&mut output);
    output.each("equilibria[].energy_j", -10.0 * DEPTH);
    output.each("equilibria[].bars[].axial_n", AXIAL);
    if origin == "line" {
        // A batch looks nothing up in a census unless it is told to.
        output.each("equilibria[].evidence.ladder[].reason.because", "not_asked");
    }
}

/// The same of files, each with its name.
#[test]
fn several_files() {
    let folder = tempfile::tempdir().unwrap();
    let falls = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
                 bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"strut\" }]\n";
    let far = LEVEL_V.replace("[1, 0, 0]", "[4, 0, 0]");
    for (name, text) in [("v.toml", LEVEL_V), ("falls.toml", falls), ("far.toml", &far)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let result = ran(&folder, &["solve", "v.toml", "falls.toml", "far.toml", "--json"]);
    let text = String::from_utf8(result.stdout).unwrap();
    let mut objects = serde_json::Deserializer::from_str(&text).into_iter::<Value>();
    let first = objects.next().unwrap().unwrap().to_string();
    answered(&first, "file", &json!("v.toml"), "several_files");
    let rest: Vec<String> = objects.map(|object| object.unwrap().to_string()).collect();
    let rest = rest.join("\n");
    let mut output = Output::lines("solve of several files, refused", "several_files", &rest);
    output.is("file", json!(["falls.toml", "far.toml"]));
    output.says(
        "error",
        &["moves on without end", "4 m apart and the members between them reach only 2 m"],
    );
    output.is("help", "move the anchors together or lengthen the bars");
}
