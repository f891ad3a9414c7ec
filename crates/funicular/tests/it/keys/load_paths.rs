//! `trace` over a range: a gable of two elastic bars, which bears `P = 2 EA (w/l) (l0 - l)/l0` at the
//! height w, and a joint on a cable and a bar over a floor.

use serde_json::{Value, json};

use super::output::Output;
use super::table;

use crate::load_paths::RING;
use crate::run::holding;

/// EA = 1 N, feet 2 m apart, the apex 0.5 m above them on a line, 1 N down.
#[test]
fn load_path_of_a_gable() {
    let [mut output, mut columns] = table::outputs("load_path_of_a_gable");
    let l0 = 1.25_f64.sqrt();
    let l = l0.cbrt();
    let w = (l * l - 1.0).sqrt();
    let point = output.numbers("load_paths[].events[].point")[0];
    let at = |key: &str| format!("load_paths[].points[].{key}");
    let heights = output.numbers(&at("of[]"));
    let each = |of: &dyn Fn(f64, f64) -> Value| -> Value {
        heights.iter().map(|w| of(*w, w.hypot(1.0))).collect()
    };
    let load = |w: f64, l: f64| 2.0 * w / l * (l0 - l) / l0;
    output.is(&at("values[]"), each(&|w, l| json!(load(w, l))));
    let places = |w: f64, _: f64| json!([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, w]);
    output.is(&at("joints_m[][]"), each(&places));
    output.is(&at("axial_n[]"), each(&|_, l| json!([(l - l0) / l0, (l - l0) / l0])));
    // The load falls, and both bars are shortened.
    output.is(&at("energy_j"), each(&|w, l| json!(load(w, l) * w + (l - l0).powi(2) / l0)));
    output.near(
        &at("of[]"),
        1e-7,
        heights
            .iter()
            .enumerate()
            .map(|(k, height)| if (k as f64 - point).abs() < 0.5 { w } else { *height })
            .collect::<Vec<_>>(),
    );
    let unstable = heights.iter().enumerate().map(|(k, _)| i32::from(k as f64 > point + 0.5));
    output.is(&at("index"), unstable.collect::<Vec<_>>());
    let at = |key: &str| format!("load_paths[].confirmed.{key}");
    for all in ["points", "critical", "same_index"] {
        output.is(&at(all), heights.len());
    }
    let [tried, found] = ["minimised", "minima"].map(|key| output.numbers(&at(key))[0]);
    assert!(tried > 2.5 && (tried - found).abs() < 0.5, "{tried} {found}");
    columns.is("point", (0..heights.len()).collect::<Vec<_>>());
    columns.is("loads", each(&|w, l| json!(load(w, l))));
    columns.is("energy_j", each(&|w, l| json!(load(w, l) * w + (l - l0).powi(2) / l0)));
    let on = |value: Value| {
        move |k: usize| if (k as f64 - point).abs() < 0.5 { value.clone() } else { json!("") }
    };
    columns.is("event", (0..heights.len()).map(on(json!(0))).collect::<Vec<_>>());
    let unstable = (0..heights.len()).map(|k| i32::from(k as f64 > point + 0.5));
    columns.are(json!({ "index": unstable.collect::<Vec<_>>(), "joints.P.z": heights.clone() }));
    columns.is("P_z_m", heights.clone());
    columns.is("axial_#_n", each(&|_, l| json!([(l - l0) / l0, (l - l0) / l0])));
}

/// A bar between two springs, which falls to a side and goes round.
#[test]
fn paths_that_branch_off() {
    let file = RING.replace("[[bars]]\n", "[[bars]]\nmass_kg = 0\n");
    let command = "trace system.toml --vary loads=0,4,-4 --branches --linear-buckling";
    let folder = holding([("system.toml", file)]);
    drop(Output::ended(0, "paths_that_branch_off", folder, command).of("load paths"));
}
