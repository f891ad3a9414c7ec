//! System files with one number changed.

use funicular::prelude::*;
use serde_json::{Value, json};

/// A bridle in space with a cable, a spring, a slider and forces, of which the spring and the cable
/// are given by what they bear at their lengths: nothing about it is symmetric, and no two numbers
/// are the same.
pub fn bridle() -> Value {
    json!({
        "gravity_m_s2": 9.81,
        "floor_m": -9.5,
        "joints": {
            "A": { "at_m": [-2, -1, 0.3] },
            "B": { "at_m": [2, -0.5, 0] },
            "C": { "at_m": [0.2, 2.1, -0.2] },
            "D": { "at_m": [0, -1.9, -1.1], "along": [0, 3, -4], "mass_kg": 0.55 },
            "P": { "mass_kg": 2.2, "force_n": [0.3, 0.1, 0.05] },
            "Q": { "mass_kg": 0.7 },
        },
        "bars": [
            { "from": "A", "to": "Q", "length_m": 1.5, "mass_kg": 0.8, "length_tolerance_m": 1e-6 },
            { "from": "Q", "to": "P", "length_m": 1.45, "mass_kg": 0.5, "centre_m": 0.4,
              "inertia_kg_m2": [0.07, 0.11, 0.12], "stiffness_n": 310, "prestress_n": 17,
              "forces": [{ "force_n": [-0.1, 0.6, 0.25], "at_m": 0.35 }, { "force_n": [0.2, 0, 0] }] },
            { "from": "B", "to": "P", "length_m": 2.6, "mass_kg": 1 },
            { "from": "C", "to": "P", "length_m": 2.8, "mass_kg": 0.45, "kind": "cable",
              "stiffness_n": 520, "prestress_n": 21 },
            { "from": "D", "to": "P", "length_m": 1.95, "mass_kg": 0.6, "centre_m": 0.975 },
        ],
    })
}

pub fn problem(text: &Value) -> Problem {
    Problem::parse(&text.to_string(), "edited.json").unwrap()
}

/// The entry of a file that a path names, counting bars from 1; an entry that is not there is made.
pub fn entry<'a>(text: &'a mut Value, path: &str) -> &'a mut Value {
    path.split('.').fold(text, |at, word| match at {
        Value::Array(list) => {
            let axis = ["x", "y", "z"].iter().position(|axis| *axis == word);
            &mut list[axis.unwrap_or_else(|| word.parse::<usize>().unwrap() - 1)]
        }
        Value::Object(table) => table.entry(word).or_insert(Value::Null),
        _ => panic!("{path} at {word}"),
    })
}

/// The problem of a file with one number changed.
pub fn edited(text: &Value, path: &str, value: f64) -> Problem {
    let mut text = text.clone();
    *entry(&mut text, path) = json!(value);
    problem(&text)
}
