//! `funicular study` as its users meet it.

use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::Value;

use crate::run::{fails, ran, refused, says, stderr, stdout};

pub fn study(folder: &Path, arguments: &[&str]) -> Output {
    ran(folder, &[&["study"], arguments].concat())
}

/// A folder of this test alone, with two bars of 1 m and 2 kg between level anchors.
pub fn folder(name: &str) -> PathBuf {
    let path = crate::run::folder(name);
    let two = "name = \"two\"\ngravity_m_s2 = 10\n\
               anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
               bars = [{ length_m = 1, mass_kg = 2, count = 2 }]\n";
    std::fs::write(path.join("two.toml"), two).unwrap();
    path
}

#[test]
fn tables_fit_80_columns_and_figures_have_their_axes() {
    let folder = folder("figure");
    let vary = ["--vary", "bars.2.mass_kg=1,5", "--vary", "anchors.end_m.x=0.2..2.4:60"];
    let output = study(&folder, &[&["two.toml", "--svg", "sag.svg"], &vary[..]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    assert!(said.contains("bars.2.mass_kg = 5"), "{said}");
    assert!(said.contains("24 of 60 points"), "{said}");
    for file in ["sag-1.svg", "sag-2.svg"] {
        let drawn = std::fs::read_to_string(folder.join(file)).unwrap();
        says(&drawn, &["sag / m", "force / N", "anchors.end_m.x / m", "largest tension"]);
        roxmltree::Document::parse(&drawn).unwrap();
    }
}

#[test]
fn what_is_refused_everywhere_leaves_files_alone() {
    let folder = folder("refused");
    std::fs::write(folder.join("kept.csv"), "mine").unwrap();
    let far = ["two.toml", "--vary", "anchors.end_m.x=3,4", "--csv", "kept.csv"];
    let table = [
        (&far[..], "no value of the parameters"),
        (&["two.toml", "--vary", "bars.3.mass_kg=1"], "bars.3"),
        (&["two.toml", "--vary", "anchors.end_m.x=1", "--csv", "two.toml"], "two.toml"),
        (&["--case", "lamp", "--vary", "joints.lamps.mass_kg=1"], "did you mean `lamp`"),
        (&["--case", "lamp", "--vary", "joints.P.mass_kg=1"], "joints: A, B, lamp"),
        (&["--case", "lamp", "--vary", "joints.lamp.at_m.x=1"], "joint `lamp` is free"),
        (&["--case", "lamp", "--vary", "joints.A.mass_kg=1"], "joint `A` is an anchor"),
        (&["--case", "lamp", "--vary", "joints.B.at_m.x=8,9"], "no value of the parameters"),
        (&["--case", "bridle", "--vary", "anchors.end_m.x=1"], "not a chain between two anchors"),
        (&["two.toml", "--vary", "joints.3.mass_kg=1"], "joints: 0, 1, 2"),
    ];
    refused(&folder, &["study"], &table);
    assert_eq!(std::fs::read_to_string(folder.join("kept.csv")).unwrap(), "mine");
}

/// Cells of a CSV file by the names of their columns, line by line.
fn columns(path: &Path) -> Vec<std::collections::BTreeMap<String, String>> {
    let csv = std::fs::read_to_string(path).unwrap();
    let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned));
    let head: Vec<String> = lines.next().unwrap().collect();
    lines.map(|line| head.iter().cloned().zip(line).collect()).collect()
}

#[test]
fn systems_by_name_vary_in_loads_supports_and_stiffness() {
    let folder = folder("systems");
    // Cables of 3 and 4 m over 5 m: a right angle, so that they pull with 4/5 and 3/5 of the
    // weight.
    let vary = ["--case", "lamp", "--vary", "joints.lamp.mass_kg=1..3:3", "--csv", "lamp.csv"];
    let output = study(&folder, &vary);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    let rows = columns(&folder.join("lamp.csv"));
    assert_eq!(rows.len(), 3);
    for (k, row) in rows.iter().enumerate() {
        let number = |name: &str| row[name].parse::<f64>().unwrap();
        let weight = 9.80665 * (k + 1) as f64;
        for (name, wanted) in [
            ("tension_n", 0.8 * weight),
            ("sag_m", 2.4),
            ("lowest_x_m", 1.8),
            ("A_z_n", 0.64 * weight),
            ("B_z_n", 0.36 * weight),
            ("B_x_n", 0.48 * weight),
            ("rise_2_deg", (0.6_f64).asin().to_degrees()),
        ] {
            assert!((number(name) - wanted).abs() < 1e-9 * weight.max(60.0), "{name}");
        }
        assert_eq!((row["lowest_joint"].as_str(), row["agrees"].as_str()), ("lamp", "true"));
    }

    // A weight on an elastic thread of 2 m is (m g / EA) 2 m lower, on the floor if that is nearer.
    let thread = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 3 } }\n\
                  bars = [{ from = \"A\", to = \"P\", length_m = 2, mass_kg = 0, kind = \"cable\" }]\n";
    std::fs::write(folder.join("thread.toml"), thread).unwrap();
    let vary = ["thread.toml", "--vary", "bars.*.stiffness_n=60,300", "--json"];
    let floor = ["--vary", "floor_m=-5,-2.5"];
    let output = study(&folder, &[&vary[..], &floor].concat());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let points = json["points"].as_array().unwrap();
    let depth = |k: usize| -points[k]["lowest_m"][2].as_f64().unwrap();
    for (k, wanted) in [3.0, 2.5, 2.2, 2.2].into_iter().enumerate() {
        assert!((depth(k) - wanted).abs() < 1e-9, "{k}: {}", depth(k));
    }
    // Half a metre longer the thread bears 60 N / 4, the floor the rest.
    assert!((points[1]["reactions_n"]["A"][2].as_f64().unwrap() - 15.0).abs() < 1e-8);
    assert_eq!(json["system"]["joints"], 2);

    // A chain with a lamp at its middle joint is a system, with its anchors where they were.
    let lamp = "gravity_m_s2 = 10\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
                bars = [{ length_m = 1, mass_kg = 0, count = 2 }]\nloads = [{ joint = 1, mass_kg = 4 }]\n";
    std::fs::write(folder.join("loaded.toml"), lamp).unwrap();
    let vary = ["loaded.toml", "--vary", "anchors.end_m.x=1.2,1.6", "--csv", "loaded.csv"];
    let output = study(&folder, &vary);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let rows = columns(&folder.join("loaded.csv"));
    for (row, wanted) in rows.iter().zip([20.0 / 0.8, 20.0 / 0.6]) {
        assert!((row["tension_n"].parse::<f64>().unwrap() - wanted).abs() < 1e-9, "{row:?}");
    }
    // Its end has two names.
    let twice = ["loaded.toml", "--vary", "anchors.end_m.x=1.2,1.6", "--vary", "joints.2.at_m.x=1"];
    fails(&study(&folder, &twice), 2, "set one number");
}

/// The keys of the format's page that hold numbers, as `joints.NAME.at_m`.
fn keys_with_numbers() -> Vec<&'static str> {
    let page = include_str!("../../../model/FORMAT.md");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` | "));
    let numbers = rows.filter(|(_, row)| row.starts_with("number |") || row.starts_with("`["));
    numbers.map(|(key, _)| key).filter(|key| !key.contains(':')).collect()
}

/// Keys that vary, each held against the edited file in `branches`.
const PARAMETERS: &str = "gravity_m_s2 floor_m anchors.start_m anchors.end_m joints.NAME.at_m joints.NAME.mass_kg \
    joints.NAME.force_n bars.length_m bars.mass_kg bars.centre_m bars.inertia_kg_m2 \
    bars.stiffness_n bars.prestress_n bars.length_tolerance_m";

/// Keys with numbers that do not vary: of a load on a chain `joints.K` is varied, and where a joint is
/// drawn decides which equilibrium is meant. What people know of a bar is made into other keys where
/// the file is read. Strengths and tolerances change nothing.
const NO_PARAMETERS: &str = "bars.mass_kg_per_m bars.diameter_m bars.density_kg_m3 bars.young_pa bars.force_n_per_m \
    bars.temperature_k bars.expansion_per_k joints.NAME.near_m loads.mass_kg loads.force_n \
    loads.force_n_per_m joints.NAME.along joints.NAME.normal bars.forces.force_n \
    bars.forces.at_m bars.strength_n bars.compression_n bars.bending_n_m2 bars.safety safety \
    bars.stiffness_tolerance bars.mass_tolerance_kg joints.NAME.mass_tolerance_kg \
    joints.NAME.at_tolerance_m joints.NAME.force_tolerance_n tolerances.length_tolerance_m \
    tolerances.stiffness_tolerance tolerances.mass_tolerance_kg tolerances.at_tolerance_m \
    tolerances.force_tolerance_n";

#[test]
fn every_number_of_a_file_is_a_parameter_or_listed_as_none() {
    let mut known: Vec<_> = PARAMETERS.split(' ').chain(NO_PARAMETERS.split(' ')).collect();
    let mut keys = keys_with_numbers();
    known.sort_unstable();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys, known);
}

/// A prestress that a length cannot have is refused at its bar.
#[test]
fn what_no_length_bears_is_told_with_its_bar() {
    let folder = folder("string");
    let text = r#"{"joints": {"A": {"at_m": [0,0,0]}, "B": {"at_m": [2,0,0]}, "P": {"mass_kg": 1}},
        "bars": [{"from":"A","to":"P","length_m":1,"mass_kg":0,"stiffness_n":1000,"prestress_n":100},
                 {"from":"P","to":"B","length_m":1,"mass_kg":0,"stiffness_n":1000,"prestress_n":100}]}"#;
    std::fs::write(folder.join("string.json"), text).unwrap();
    let output = study(&folder, &["string.json", "--vary", "bars.2.prestress_n=-1000,100"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("bar 2: a prestress must be greater than -EA"), "{said}");
}

/// Bars of 4 and 3 m between anchors 5 m apart, one of them 3 m lower: the joint is 12/5 m across the line
/// between the anchors, which is level to 4/5, so 3 m below it, and only 0.84 m below the lower anchor.
const SLOPED: &str = r#"{"anchors": {"start_m": [0,0,0], "end_m": [4,0,-3]},
    "bars": [{"length_m": 4, "mass_kg": 1}, {"length_m": 3, "mass_kg": 1}]}"#;

/// Two cables of 1.25 m over 2 m to a rider on an upright line: 0.75 m below the anchors. The rider is the lowest
/// support.
const RIDER: &str = r#"{"joints": {"A": {"at_m": [0,0,0]}, "B": {"at_m": [2,0,0]},
        "rider": {"at_m": [1,0,5], "along": [0,0,1], "mass_kg": 2}},
    "bars": [{"from":"A","to":"rider","length_m":1.25,"mass_kg":0,"kind":"cable"},
             {"from":"rider","to":"B","length_m":1.25,"mass_kg":0,"kind":"cable"}]}"#;

#[test]
fn sag_is_measured_from_the_line_that_a_row_spans() {
    let folder = folder("sag");
    std::fs::write(folder.join("sloped.json"), SLOPED).unwrap();
    std::fs::write(folder.join("rider.json"), RIDER).unwrap();
    // The parabola of the footbridge hangs 3 m deep between towers, three anchors lie at its deck.
    for (arguments, wanted) in [
        (&["sloped.json"][..], "Sag: 3 m, of joint 1 below the line from 0 to 2."),
        (&["rider.json"], "Sag: 0.75 m, of joint rider below the line from A to B."),
        (&["--case", "footbridge"], "Sag: 3 m, of joint l3 below the line from l0 to l6."),
    ] {
        let said = stdout(&ran(&folder, &[&["solve"], arguments].concat()));
        assert!(said.contains(wanted), "{said}");
    }
    let vary = ["rider.json", "--vary", "joints.rider.mass_kg=1,2", "--csv", "of.csv"];
    let of =
        ["joints.rider.z", "joints.rider.at_m.x", "sag.A-B", "height=-2", "bars.1.axial_max_n"];
    let of: Vec<&str> = of.into_iter().flat_map(|of| ["--of", of]).collect();
    let output = study(&folder, &[&vary[..], &of].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(
        said.contains("axial_max_n") && said.lines().all(|l| l.chars().count() <= 80),
        "{said}"
    );
    for (row, mass_kg) in columns(&folder.join("of.csv")).iter().zip([1.0, 2.0]) {
        // Each cable holds half the weight at the slope 3 of 5.
        let pull_n = mass_kg * 9.80665 / 2.0 / 0.6;
        for (name, wanted) in [
            ("sag_m", 0.75),
            ("joints.rider.z", -0.75),
            ("joints.rider.at_m.x", 1.0),
            ("sag.A-B", 0.75),
            ("height=-2", 1.25),
            ("bars.1.axial_max_n", pull_n),
        ] {
            let value: f64 = row[name].parse().unwrap();
            assert!((value - wanted).abs() < 1e-10, "{name}: {value}");
        }
    }
    for (of, wanted) in [
        ("joints.ridr.z", "did you mean `rider`"),
        ("sag.A-C", "there is no joint `C`"),
        ("bars.3.axial_n", "there is no bar `3`"),
        ("depth", "an answer has no number `depth`"),
    ] {
        let vary = ["rider.json", "--vary", "gravity_m_s2=1,2", "--of", of];
        fails(&study(&folder, &vary), 2, wanted);
    }
}

/// The largest tension of the lamp is the force at A for any mass: both curves are seen, as the upper
/// one is dashed, in the picture and in its legend.
#[test]
fn equal_curves_are_told_apart() {
    let folder = folder("equal");
    let vary = ["--case", "lamp", "--vary", "joints.lamp.mass_kg=1..5:5", "--svg", "lamp.svg"];
    let output = study(&folder, &vary);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let svg = std::fs::read_to_string(folder.join("lamp.svg")).unwrap();
    let of = |colour: &str, tag: &str| -> Vec<bool> {
        let lines = svg.lines().filter(|line| line.starts_with(tag) && line.contains(colour));
        lines.map(|line| line.contains("stroke-dasharray")).collect()
    };
    // Blue also is the sag and the first bar.
    assert_eq!(
        (of("#0072b2", "<polyline"), of("#0072b2", "<line")),
        (vec![false; 3], vec![false; 2])
    );
    assert_eq!((of("#009e73", "<polyline"), of("#009e73", "<line")), (vec![true], vec![true]));
}
