//! `funicular study` as its users meet it.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

fn study(folder: &Path, arguments: &[&str]) -> Output {
    Command::cargo_bin("funicular")
        .unwrap()
        .env("NO_COLOR", "1")
        .current_dir(folder)
        .arg("study")
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder of this test alone, with two bars of 1 m and 2 kg between level anchors.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("study").join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    let two = "name = \"two\"\ngravity_m_s2 = 10\n\
               anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
               bars = [{ length_m = 1, mass_kg = 2, count = 2 }]\n";
    std::fs::write(path.join("two.toml"), two).unwrap();
    path
}

#[test]
fn every_column_and_key_of_two_bars_is_that_of_a_v() {
    let folder = folder("closed");
    let arguments =
        ["two.toml", "--vary", "anchors.end_m.x=0.4..2.2:10", "--csv", "two.csv", "--json"];
    let output = study(&folder, &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["schema_version"], 2);
    assert_eq!(json["parameters"][0], "anchors.end_m.x");
    assert_eq!(json["units"][0], "m");
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 10);
    let csv = std::fs::read_to_string(folder.join("two.csv")).unwrap();
    let columns = csv.lines().next().unwrap().split(',').count();
    // The last cell is a sentence, with commas of its own.
    let mut lines = csv.lines().map(|line| line.splitn(columns, ',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let mut shapes = 0;
    for (k, (point, line)) in points.iter().zip(lines).enumerate() {
        assert_eq!(line.len(), head.len());
        let cell = |name: &str| line[head.iter().position(|column| *column == name).unwrap()];
        let number = |name: &str| cell(name).parse::<f64>().unwrap();
        let key = |name: &str| point[name].as_f64().unwrap();
        let distance = 0.4 + 0.2 * k as f64;
        assert!((point["values"][0].as_f64().unwrap() - distance).abs() < 1e-14);
        assert!((number("anchors.end_m.x") - distance).abs() < 1e-14);
        assert_eq!((cell("path"), point["path"].as_u64()), ("1", Some(1)));
        // At 2 m the chain is straight, beyond out of reach.
        if k >= 8 {
            assert_eq!(point["refused"], true);
            assert!(!point["reason"].as_str().unwrap().is_empty() && !cell("refused").is_empty());
            continue;
        }
        shapes += 1;
        // Each bar's weight of 20 N hangs half at the middle joint, half at an anchor.
        let sag = (1.0 - 0.25 * distance * distance).sqrt();
        let level = 10.0 / sag * 0.5 * distance;
        // At the anchor, where the bar bears its whole weight.
        let tension = level * 0.5 * distance + 20.0 * sag;
        let close = |x: f64, wanted: f64, what: &str| {
            assert!((x - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{what}: {x} {wanted}");
        };
        for (name, wanted) in [
            ("span_m", distance),
            ("sag_m", sag),
            ("energy_j", -40.0 * 0.5 * sag),
            ("lowest_x_m", 0.5 * distance),
            ("lowest_y_m", 0.0),
            ("lowest_z_m", -sag),
            ("tension_n", tension),
            ("start_x_n", -level),
            ("start_y_n", 0.0),
            ("start_z_n", 20.0),
            ("end_x_n", level),
            ("end_y_n", 0.0),
            ("end_z_n", 20.0),
            ("rise_1_deg", -sag.asin().to_degrees()),
            ("rise_2_deg", sag.asin().to_degrees()),
        ] {
            close(number(name), wanted, name);
        }
        for (name, wanted) in [("span_m", distance), ("sag_m", sag), ("energy_j", -20.0 * sag)] {
            close(key(name), wanted, name);
        }
        let list = |key: &str| -> Vec<f64> {
            point[key].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
        };
        close(list("lowest_m")[2], -sag, "lowest_m");
        close(list("tension_n")[1], tension, "tension_n");
        close(list("rises_deg")[1], sag.asin().to_degrees(), "rises_deg");
        close(point["reactions_n"]["end"][0].as_f64().unwrap(), level, "reactions_n");
        assert_eq!((cell("lowest_joint"), point["lowest_joint"].as_u64()), ("1", Some(1)));
        // The first of two equal ones, up to rounding either.
        assert!(["1", "2"].contains(&cell("tension_bar")));
        assert_eq!((cell("compression_n"), cell("compression_bar")), ("", ""));
        assert!(point["compression_n"].is_null());
        assert_eq!((cell("agrees"), point["agrees"].as_bool()), ("true", Some(true)));
        assert_eq!((cell("evidence"), point["rung"].as_str()), ("optimal", Some("optimal")));
        assert_eq!(point["check_failed"], false);
        assert!(key("joints_differ_m") < 1e-9 && key("forces_differ_n") < 1e-6);
        assert_eq!(cell("refused"), "");
    }
    assert_eq!(shapes, 8);
}

#[test]
fn tables_fit_80_columns_and_figures_have_their_axes() {
    let folder = folder("figure");
    let vary = ["--vary", "bars.2.mass_kg=1,5", "--vary", "anchors.end_m.x=0.2..2.4:60"];
    let output = study(&folder, &[&["two.toml", "--svg", "sag.svg"], &vary[..]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let said = text(&output.stdout);
    assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    assert!(said.contains("bars.2.mass_kg = 5"), "{said}");
    assert!(said.contains("24 of 60 points"), "{said}");
    for file in ["sag-1.svg", "sag-2.svg"] {
        let drawn = std::fs::read_to_string(folder.join(file)).unwrap();
        for word in ["sag / m", "force / N", "anchors.end_m.x / m", "largest tension"] {
            assert!(drawn.contains(word), "{file}: {word}");
        }
        roxmltree::Document::parse(&drawn).unwrap();
    }
}

#[test]
fn what_is_refused_everywhere_leaves_files_alone() {
    let folder = folder("refused");
    std::fs::write(folder.join("kept.csv"), "mine").unwrap();
    let far = ["two.toml", "--vary", "anchors.end_m.x=3,4", "--csv", "kept.csv"];
    for (arguments, wanted) in [
        (&far[..], "no value of the parameters"),
        (&["two.toml", "--vary", "bars.3.mass_kg=1"], "bars.3"),
        (&["two.toml", "--vary", "anchors.end_m.x=1", "--csv", "two.toml"], "two.toml"),
        (&["--case", "lamp", "--vary", "joints.lamps.mass_kg=1"], "did you mean `lamp`"),
        (&["--case", "lamp", "--vary", "joints.P.mass_kg=1"], "joints: A, B, lamp"),
        (&["--case", "lamp", "--vary", "joints.lamp.at_m.x=1"], "joint `lamp` is free"),
        (&["--case", "lamp", "--vary", "joints.A.mass_kg=1"], "joint `A` is an anchor"),
        (&["--case", "lamp", "--vary", "joints.B.at_m.x=8,9"], "no value of the parameters"),
        (&["--case", "bridle", "--vary", "anchors.end_m.x=1"], "no chain between two anchors"),
        (&["two.toml", "--vary", "bars.1.stiffness_n=1"], "a chain has no `bars.1.stiffness_n`"),
    ] {
        let output = study(&folder, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(wanted), "{}", text(&output.stderr));
    }
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
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let said = text(&output.stdout);
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
        assert!(!row.contains_key("span_m"));
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
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let rows = columns(&folder.join("loaded.csv"));
    for (row, wanted) in rows.iter().zip([20.0 / 0.8, 20.0 / 0.6]) {
        assert!((row["tension_n"].parse::<f64>().unwrap() - wanted).abs() < 1e-9, "{row:?}");
    }
    // Its end has two names.
    let twice = ["loaded.toml", "--vary", "anchors.end_m.x=1.2,1.6", "--vary", "joints.2.at_m.x=1"];
    let output = study(&folder, &twice);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("set one number"), "{}", text(&output.stderr));
}
