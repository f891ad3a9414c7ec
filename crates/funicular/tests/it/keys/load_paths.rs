//! `trace` over a range: a gable of two elastic bars, which bears `P = 2 EA (w/l) (l0 - l)/l0` at the
//! height w, and a joint on a cable and a bar over a floor.

use serde_json::{Value, json};

use super::output::Output;
use crate::load_paths::RING;

use crate::run::{good, holding};

/// EA = 1 N, feet 2 m apart, the apex 0.5 m above them on a line, 1 N down.
const GABLE: &str = "name = \"gable\"\n[joints]\nA = { at_m = [-1, 0, 0] }\nB = { at_m = [1, 0, 0] }\n\
    P = { at_m = [0, 0, 0.5], near_m = [0, 0, 0.5], free = \"z\", force_n = [0, 0, -1] }\n\
    [[bars]]\nfrom = \"A\"\nto = \"P\"\nmass_kg = 0\nstiffness_n = 1\n\
    [[bars]]\nfrom = \"P\"\nto = \"B\"\nmass_kg = 0\nstiffness_n = 1\n";

#[test]
fn load_path_of_a_gable() {
    let folder = holding([("gable.toml", GABLE)]);
    let command = "trace gable.toml --vary loads=0..1 --csv gable.csv";
    let mut output = Output::told("load_path_of_a_gable", &folder, command).of("load paths");
    output.is("schema_version", 3);
    let l0 = 1.25_f64.sqrt();
    output.system("gable", [3, 2], [2.0 * l0, 0.0, 9.806_65]);
    output.are(json!({ "parameters[]": "loads", "units[]": "1", "of[]": "joints.P.z" }));
    let at = |key: &str| format!("load_paths[].events[].{key}");
    let l = l0.cbrt();
    let [w, limit] = [(l * l - 1.0).sqrt(), 2.0 * (l * l - 1.0).sqrt() / l * (l0 - l) / l0];
    let wanted = json!({
        "kind": "limit-point", "values[]": limit, "index[]": [0, 1], "turns": true,
    });
    output.are_at(at, wanted);
    output.encloses(&at("enclosed[]"), limit);
    output.is(&at("mode[][]"), json!([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]));
    for none in ["slack[]", "taut[]", "lands[]", "leaves[]"] {
        output.is(&at(none), json!([]));
    }
    // 2 EA w / l0^2 for both bars together; a foot that comes nearer makes the gable steeper.
    output.is(&at("by_length[]"), json!([w / (l0 * l0), w / (l0 * l0)]));
    let by_place = json!([w / l0, 0.0, 0.0, -w / l0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    output.is(&at("by_place[][]"), by_place);
    let point = output.numbers(&at("point"))[0];
    output.is("load_paths[].end", "range");
    output.is("load_paths[].proved.first", "limit-point");
    output.is("load_paths[].proved.to", limit);
    output.encloses("load_paths[].proved.between[]", limit);
    output.within("load_paths[].proved.boxes", 2.0..=64.0);
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
    output.is(&at("event"), json!([0]));
    let unstable = heights.iter().enumerate().map(|(k, _)| i32::from(k as f64 > point + 0.5));
    output.is(&at("index"), unstable.collect::<Vec<_>>());
    let at = |key: &str| format!("load_paths[].confirmed.{key}");
    for all in ["points", "critical", "same_index"] {
        output.is(&at(all), heights.len());
    }
    for one in ["singular", "flat"] {
        output.is(&at(one), 1);
    }
    let [tried, found] = ["minimised", "minima"].map(|key| output.numbers(&at(key))[0]);
    assert!(tried > 2.5 && (tried - found).abs() < 0.5, "{tried} {found}");
    output.within(&at("statics"), 0.0..=1e-10);
    let mut output =
        Output::file("load paths --csv", "load_path_of_a_gable", folder.path().join("gable.csv"));
    output.each("path", 1);
    output.is("point", (0..heights.len()).collect::<Vec<_>>());
    output.is("loads", each(&|w, l| json!(load(w, l))));
    output.is("energy_j", each(&|w, l| json!(load(w, l) * w + (l - l0).powi(2) / l0)));
    let on = |value: Value| {
        move |k: usize| if (k as f64 - point).abs() < 0.5 { value.clone() } else { json!("") }
    };
    output.is("event", (0..heights.len()).map(on(json!(0))).collect::<Vec<_>>());
    let unstable = (0..heights.len()).map(|k| i32::from(k as f64 > point + 0.5));
    output.are(json!({ "index": unstable.collect::<Vec<_>>(), "joints.P.z": heights.clone() }));
    for (name, wanted) in [("A_x_m", -1.0), ("B_x_m", 1.0), ("P_x_m", 0.0)] {
        output.each(name, wanted);
    }
    for name in ["A_y_m", "A_z_m", "B_y_m", "B_z_m", "P_y_m"] {
        output.each(name, 0.0);
    }
    output.is("P_z_m", heights.clone());
    output.is("axial_#_n", each(&|_, l| json!([(l - l0) / l0, (l - l0) / l0])));
}

/// A joint at -1 m + F/20 N/m as long as the cable above it is taut, and -1 m + F/10 N/m where it is not;
/// the floor is at -1.5 m.
#[test]
fn kinks_of_a_cable_and_a_floor() {
    let file = "floor_m = -1.5\n[joints]\nT = { at_m = [0, 0, 0] }\nB = { at_m = [0, 0, 1] }\n\
        P = { at_m = [0, 0, -1], near_m = [0, 0, DRAWN], free = \"z\" }\n\
        [[bars]]\nfrom = \"T\"\nto = \"P\"\nkind = \"cable\"\nlength_m = 1\nmass_kg = 0\nstiffness_n = 10\n\
        [[bars]]\nfrom = \"B\"\nto = \"P\"\nlength_m = 2\nmass_kg = 0\nstiffness_n = 20\n";
    let folder = tempfile::tempdir().unwrap();
    let of = |vary: &str, drawn: &str| {
        std::fs::write(folder.path().join("kinks.toml"), file.replace("DRAWN", drawn)).unwrap();
        let text = good(&folder, &["trace", "kinks.toml", "--vary", vary, "--json"]);
        Output::json("load paths", "kinks_of_a_cable_and_a_floor", &text)
    };
    let at = |key: &str| format!("load_paths[].events[].{key}");
    let mut down = of("joints.P.force_n.z=4..-15", "-0.7");
    let wanted = json!({
        "kind": ["kink", "kink"], "values[]": [0.0, -10.0], "taut[]": [1], "lands[]": ["P"],
        "mode[]": [], "slack[]": [], "leaves[]": [], "turns": [false, false],
    });
    down.are_at(at, wanted);
    down.is("load_paths[].proved.because", "the system has a floor");
    let mut up = of("joints.P.force_n.z=-15..4", "-1.4");
    let wanted = json!({
        "kind": ["kink", "kink"], "values[]": [-10.0, 0.0], "slack[]": [1], "leaves[]": ["P"],
        "mode[]": [], "taut[]": [], "lands[]": [], "turns": [false, false],
    });
    up.are_at(at, wanted);
    up.is("load_paths[].proved.because", "the system has a floor");
}

/// A bar between two springs, which falls to a side and goes round.
#[test]
fn paths_that_branch_off() {
    let file = RING.replace("[[bars]]\n", "[[bars]]\nmass_kg = 0\n");
    let command = "trace system.toml --vary loads=0,4,-4 --branches --linear-buckling";
    let mut output = Output::alone("paths_that_branch_off", file, command).of("load paths");
    output.is("load_paths[].end", json!(["range", "joins"]));
    for key in ["branches_from", "joins"] {
        output.is(&format!("load_paths[].{key}.path"), 0);
        output.is(&format!("load_paths[].{key}.event"), 0);
    }
    output.near("load_paths[].linear_buckling", 1e-6, vec![2000.0 / 101_f64.powf(1.5)]);
}

/// Two rigid bars of 1 m between anchors 1 m apart hang or stand.
#[test]
fn load_path_of_rigid_bars() {
    let file = "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [1, 0, 0] }\nP = { mass_kg = 1 }\n\
        [[bars]]\nfrom = \"A\"\nto = \"P\"\nmass_kg = 0\nlength_m = 1\n\
        [[bars]]\nfrom = \"P\"\nto = \"B\"\nmass_kg = 0\nlength_m = 1\n";
    let mut output =
        Output::alone("load_path_of_rigid_bars", file, "trace system.toml --vary loads=1..2")
            .of("load paths");
    output.is("load_paths[].equilibria_at_every_load", 2);
}

#[test]
fn why_load_paths_end() {
    let folder = tempfile::tempdir().unwrap();
    // Below no load at all its mass would be negative.
    let heavy = GABLE.replace("force_n = [0, 0, -1]", "mass_kg = 0.01");
    for (name, file) in [("gable.toml", GABLE), ("heavy.toml", &heavy)] {
        std::fs::write(folder.path().join(name), file).unwrap();
    }
    let ends = |arguments: &[&str], why: &str| {
        let all = [&["trace"], arguments, &["--json"]].concat();
        let mut output = Output::json("load paths", "why_load_paths_end", &good(&folder, &all));
        output.are(json!({ "load_paths[].end": why, "load_paths[].events[]": [] }));
    };
    ends(&["gable.toml", "--vary", "loads=0..1", "--max-points", "5"], "max-points");
    ends(&["heavy.toml", "--vary", "loads=0.1,0,-1"], "numbers");
}
