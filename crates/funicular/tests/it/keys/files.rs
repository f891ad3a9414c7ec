//! `solve` line by line and of several files: the numbers of the level V.

use serde_json::{Value, json};

use super::output::Output;
use super::solve::LEVEL_V;

use crate::run::{holding, ran};

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
    // Where the key begins in its line, in characters from 1.
    output.is("column", wrong.find("\"masskg\"").unwrap() + 1);
}

/// An answer among others is the object of one answer, with the place of its system before it.
fn answered(text: &str, origin: &str, place: &Value, test: &str) {
    let mut object: Value = serde_json::from_str(text).unwrap();
    let found = object.as_object_mut().unwrap().remove(origin);
    assert_eq!(found.as_ref(), Some(place));
    drop(Output::json("solve", test, &object.to_string()));
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
    drop(Output::lines("solve of several files, refused", "several_files", &rest));
}
