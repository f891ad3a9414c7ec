//! `census` by signs and pulls alone, beside the whole one.

use serde_json::json;

use super::output::Output;
use super::solve::LAMP;

use crate::run::{good, holding};

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
    drop(Output::json("census --list signs", test, &object.to_string()));
    drop(Output::file("census --list signs --csv", test, folder.path().join("lamp.csv")));
}
