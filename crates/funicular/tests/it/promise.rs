//! Agreed means right: systems that once ended as agreed, proved or confirmed and were not.
//!
//! Expected forces of overdetermined frames are those of NumPy's `lstsq` at the shape that SciPy's
//! `least_squares` finds for the lengths: least $\sum t^2 l$ under balance.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use crate::run::{good, holding, run};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/promise");

/// What a command prints of a file of the folder, and its exit code.
fn said(arguments: &[&str]) -> (Option<i32>, String) {
    let (code, text, _) = run(Path::new(FOLDER), arguments);
    (code, text)
}

fn solved(file: &str) -> Value {
    let text = good(FOLDER, &["solve", file, "--json"]);
    let answer: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(answer["agreement"]["verdict"], "agreed", "{file}");
    answer
}

fn axial_n(answer: &Value, solver: usize) -> Vec<f64> {
    let bars = answer["equilibria"][solver]["bars"].as_array().unwrap();
    bars.iter().map(|bar| bar["axial_n"].as_f64().unwrap()).collect()
}

#[test]
fn overdetermined_frames_bear_the_share_of_equally_stiff_bars() {
    let frames: [(&str, &[f64]); 3] = [
        ("1-tetrapod.json", &[-7.908_031_9, 19.061_756_256, -29.887_541_991, 13.167_457_291]),
        ("1-1e61.json", &[-13.444_564_652, -0.151_755_43, -7.395_033_532, 0.937_709_492]),
        (
            "1-only_this.json",
            &[
                -6.852_318_514, 62.782_638_126, -54.058_160_269, -40.102_182_168, 0.0,
                -47.770_424_759, -14.815_667_035, -28.780_654_545,
            ],
        ),
    ];
    for (file, expected) in frames {
        let answer = solved(file);
        for solver in 0..2 {
            let found = axial_n(&answer, solver);
            assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 2e-8, "{file} {solver}: {found} {expected}");
            }
        }
        let (_, text) = said(&["solve", file]);
        assert!(text.contains(" any"), "{file}: no bar of a self-stress is open:\n{text}");
    }
    // The same through the commands that repeat the question.
    let vary = ["study", "1-tetrapod.json", "--vary", "joints.P.mass_kg=2", "--json"];
    let (code, text) = said(&vary);
    let study: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(code, Some(0));
    let largest = study["points"][0]["compression_n"][1].as_f64().unwrap();
    assert!((largest - 29.887_541_991).abs() < 2e-8, "{largest}");
}

/// Forces that balance with a self-stress of any size: seen as long as it hides no load, refused where
/// it does. The self-stress of four bars is that of the determinants of the other three.
#[test]
fn forces_beside_which_no_load_is_seen_are_not_confirmed() {
    let anchors = [[3.0, 2.0, 1.0], [2.0, 1.0, 3.0], [3.0, 1.0, -1.0], [3.0, 0.0, 3.0_f64]];
    let lengths = [45.0, 25.0, 48.0, 25.0].map(f64::sqrt);
    let along: [[f64; 3]; 4] = std::array::from_fn(|k| {
        let from_p = [anchors[k][0] + 1.0, anchors[k][1] + 3.0, anchors[k][2] - 3.0];
        from_p.map(|part| part / lengths[k])
    });
    let stress: [f64; 4] = std::array::from_fn(|k| {
        let [a, b, c] = [1, 2, 3].map(|next| along[(k + next) % 4]);
        let across =
            [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        let det: f64 = a.iter().zip(across).map(|(a, b)| a * b).sum();
        if k % 2 == 0 { det } else { -det }
    });
    let borne = [-7.908_031_9, 19.061_756_256, -29.887_541_991, 13.167_457_291];
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let text = std::fs::read_to_string(Path::new(FOLDER).join("1-tetrapod.json")).unwrap();
    let one: Value = serde_json::from_str(&text).unwrap();
    // So many of them side by side, each with its load.
    let judged = |frames: usize, size_n: f64| {
        let (mut joints, mut bars) = (serde_json::Map::new(), Vec::new());
        let (mut places, mut forces) =
            ("joint,x_m,y_m,z_m\n".to_owned(), "from,to,axial_n\n".to_owned());
        for frame in 0..frames {
            let name = |joint: &str| format!("{joint}.{frame}");
            let own = one["joints"].as_object().unwrap();
            joints.extend(own.iter().map(|(joint, of)| (name(joint), of.clone())));
            for (k, bar) in one["bars"].as_array().unwrap().iter().enumerate() {
                let mut bar = bar.clone();
                bar["from"] = name(&format!("A{k}")).into();
                bar["to"] = name("P").into();
                bars.push(bar);
                let axial_n = borne[k] + size_n * stress[k];
                writeln!(forces, "{},{},{axial_n}", name(&format!("A{k}")), name("P")).unwrap();
            }
            writeln!(places, "{},-1,-3,3", name("P")).unwrap();
        }
        let system = serde_json::json!({ "joints": joints, "bars": bars });
        std::fs::write(path("frames.json"), system.to_string()).unwrap();
        std::fs::write(path("places.csv"), places).unwrap();
        std::fs::write(path("forces.csv"), forces).unwrap();
        let files = ["--answer", "places.csv", "--members", "forces.csv", "--json"];
        let (code, text, _) = run(&folder, &[&["judge", "frames.json"][..], &files].concat());
        let answer: Value = serde_json::from_str(&text).unwrap();
        (code, answer["finding"].as_str().unwrap().to_owned())
    };
    // Six digits of 1e5 N still show the 20 N of the load.
    for size_n in [0.0, 1.0, 1e5] {
        assert_eq!(judged(1, size_n), (Some(0), "confirmed".to_owned()), "{size_n}");
    }
    for size_n in [1e9, 9.12e12, 1e30] {
        assert_eq!(judged(1, size_n), (Some(3), "loads_hidden".to_owned()), "{size_n}");
    }
    // Six digits of 3e7 N are more than any of three loads, and less than all of them.
    let most = stress.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    assert_eq!(judged(3, 3e7 / most), (Some(3), "loads_hidden".to_owned()));
    assert_eq!(judged(3, 1e5 / most), (Some(0), "confirmed".to_owned()));
}

/// A millionth more on one leg is no rounding: bad input, with the misfits and what helps.
#[test]
fn lengths_that_cannot_be_assembled_are_refused() {
    let text = std::fs::read_to_string(Path::new(FOLDER).join("1-tetrapod.json")).unwrap();
    let longer = text.replace("6.708203932499369", "6.708213932499369");
    assert_ne!(text, longer);
    let folder = holding([("longer.json", &longer)]);
    let (code, text, _) = run(&folder, &["solve", "longer.json", "--json"]);
    assert_eq!(code, Some(2), "{text}");
    let answer: Value = serde_json::from_str(&text).unwrap();
    for failure in answer["failures"].as_array().unwrap() {
        assert_eq!(failure["refusal"]["kind"], "misfit");
        assert_eq!(failure["refusal"]["misfits"].as_array().unwrap().len(), 4);
        assert!(failure["reason"].as_str().unwrap().contains("length_tolerance_m"));
    }
    let tolerant =
        longer.replace("\"mass_kg\": 0.0", "\"mass_kg\": 0.0, \"length_tolerance_m\": 1e-4");
    std::fs::write(folder.path().join("tolerant.json"), tolerant).unwrap();
    assert_eq!(run(&folder, &["solve", "tolerant.json"]).0, Some(0));
    let falls = "plane = \"xz\"\njoints = { P = { near_m = [0, 0, 0], mass_kg = 1 }, Q = { near_m = [1, 0, 0] } }\n\
                 bars = [{ from = \"P\", to = \"Q\", mass_kg = 0 }]\n";
    std::fs::write(folder.path().join("falls.toml"), falls).unwrap();
    assert_eq!(run(&folder, &["solve", "falls.toml"]).0, Some(2));
}

/// A moment about the bar, which nothing feels, changes no frequency.
#[test]
fn a_moment_about_the_axis_changes_no_frequency() {
    let frequencies = |file: &str| {
        let (code, text) = said(&["modes", file, "--json"]);
        assert_eq!(code, Some(0), "{file}");
        let modes: Value = serde_json::from_str(&text).unwrap();
        let modes = modes["equilibria"][0]["modes"].as_array().unwrap().clone();
        let swings = modes.iter().filter(|mode| !mode["what"].as_str().unwrap().contains("spin"));
        swings.map(|mode| mode["omega2_s2"].as_f64().unwrap()).collect::<Vec<f64>>()
    };
    let plain = frequencies("5-inertia_default.json");
    let spinning = frequencies("5-inertia_same_plus_spin.json");
    assert!(!plain.is_empty() && plain.len() == spinning.len());
    for (one, other) in plain.iter().zip(&spinning) {
        assert!((one - other).abs() <= 1e-9 * one.abs(), "{one} {other}");
    }
}

/// One solver has no answer: so has the study.
#[test]
fn a_study_ends_as_solve_does() {
    let solve = said(&["solve", "7-study_exit0.json"]).0;
    let study =
        said(&["study", "7-study_exit0.json", "--vary", "joints.P0.mass_kg=3068.785648936557"]).0;
    assert_eq!(study, solve);
}
