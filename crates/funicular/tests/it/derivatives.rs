//! `funicular derivatives`: by `lagrange`, against differences of answers of `energy`.

use funicular::prelude::*;
use serde_json::Value;

use crate::edited;

use crate::run::refused;

fn bridle() -> Problem {
    edited::problem(&edited::bridle())
}

/// Changes by these numbers of a file, and the gradients of the height of a joint and of the force of a bar, are
/// the differences of answers of `energy`: joints, axial forces and forces of the ground.
pub fn are_differences(text: &Value, joint: &str, bar: usize, parameters: &[(&str, f64)]) {
    let hanging = |parameter: &str, value: f64| {
        let problem = edited::edited(text, parameter, value);
        let answer = Solve::new().solvers(Solvers::Energy).run(&problem).unwrap();
        let found = &answer.equilibria()[0];
        [found.joints_m.concat(), found.axial_n.clone(), found.reactions_n.concat()]
    };
    let problem = edited::problem(text);
    let place = 3 * problem.system().joint(joint).unwrap() + 2;
    let derivatives = Derivatives::new().run(&problem).unwrap();
    let height = derivatives.gradient(&format!("joints.{joint}.at_m.z")).unwrap();
    let pull = derivatives.gradient(&format!("bars.{bar}.axial_n")).unwrap();
    for (parameter, at) in parameters {
        let step = 1e-3 * at.max(1.0);
        let (above, below) = (hanging(parameter, at + step), hanging(parameter, at - step));
        let change = derivatives.change(parameter).unwrap();
        let told = [
            change.joints_m.iter().flat_map(|(_, v)| *v).collect::<Vec<_>>(),
            change.axial_n.clone(),
            change.reactions_n.iter().flat_map(|(_, v)| *v).collect(),
        ];
        for (kind, told) in told.iter().enumerate() {
            let difference = above[kind].iter().zip(&below[kind]);
            let difference: Vec<_> = difference.map(|(a, b)| (a - b) / (2.0 * step)).collect();
            let size = difference.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            // The error of the differences: the square of the step, and the solver's own over it.
            let close = |a: f64, b: f64| (a - b).abs() < 2e-4 * size + 1e-8;
            // The supports are told, the joints differ in all.
            for (k, told) in told.iter().enumerate() {
                assert!(
                    close(*told, difference[k]),
                    "{parameter} {kind} {k}: {told} {difference:?}"
                );
            }
        }
        for (gradient, wanted) in [(&height, told[0][place]), (&pull, told[1][bar - 1])] {
            let by = gradient.by(parameter).unwrap().value;
            assert!((by - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{parameter}: {by}");
        }
    }
}

#[test]
fn changes_and_gradients_are_the_differences_of_the_other_solver() {
    let parameters = [
        ("bars.1.length_m", 1.5),
        ("bars.2.length_m", 1.45),
        ("bars.2.mass_kg", 0.5),
        ("bars.2.stiffness_n", 310.0),
        ("bars.2.prestress_n", 17.0),
        ("bars.3.mass_kg", 1.0),
        ("bars.4.length_m", 2.8),
        ("bars.4.stiffness_n", 520.0),
        ("bars.4.prestress_n", 21.0),
        ("bars.5.length_m", 1.95),
        ("joints.P.mass_kg", 2.2),
        ("joints.P.force_n.x", 0.3),
        ("joints.P.force_n.y", 0.1),
        ("joints.C.at_m.y", 2.1),
        ("joints.A.at_m.z", 0.3),
    ];
    are_differences(&edited::bridle(), "P", 4, &parameters);
}

#[test]
fn stiffness_of_anchors_is_symmetric_and_that_of_a_closed_form() {
    let derivatives = Derivatives::new().run(&bridle()).unwrap();
    let pairs = derivatives.anchor_stiffness().unwrap();
    assert_eq!(pairs.len(), 9);
    let pair = |of: &str, by: &str| {
        pairs.iter().find(|pair| pair.of == of && pair.by == by).unwrap().stiffness_n_m
    };
    for (a, b) in [("A", "B"), ("A", "C"), ("B", "B")] {
        for i in 0..3 {
            for k in 0..3 {
                assert!((pair(a, b)[i][k] - pair(b, a)[k][i]).abs() < 1e-8);
            }
        }
    }
    // An elastic thread of 2 m alone: EA / l along it, F / d across it.
    let thread = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, B = { at_m = [0, 0, -5] }, \
                  P = { mass_kg = 1 } }\n\
                  bars = [{ from = \"A\", to = \"P\", length_m = 2, mass_kg = 0, stiffness_n = 400 },\n\
                  { from = \"P\", to = \"B\", length_m = 2, mass_kg = 0, stiffness_n = 400 }]";
    let problem = Problem::parse(thread, "thread.toml").unwrap();
    let pairs = Derivatives::new().run(&problem).unwrap().anchor_stiffness().unwrap();
    // Two springs of 200 N/m in a row.
    assert!((pairs[0].stiffness_n_m[2][2] - 100.0).abs() < 1e-8, "{pairs:?}");
    assert!((pairs[1].stiffness_n_m[2][2] + 100.0).abs() < 1e-8, "{pairs:?}");
}

fn derivatives(arguments: &[&str]) -> std::process::Output {
    crate::run::funicular(&[&["derivatives"], arguments].concat())
}

#[test]
fn the_program_prints_tables_json_and_csv() {
    let chain = derivatives(&["--case", "two-bars", "--json"]);
    let json: Value = serde_json::from_slice(&chain.stdout).unwrap();
    let anchors = json["anchors"].as_array().unwrap();
    assert_eq!(
        (anchors.len(), &anchors[1]["of"], &anchors[1]["by"]),
        (4, &"0".into(), &"2".into())
    );
    for arguments in [
        &["--case", "bridle"][..],
        &["--case", "bridle", "--by", "bars.1.length_m"],
        &["--case", "net", "--of", "bars.1.axial_n"],
    ] {
        let output = derivatives(arguments);
        let said = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    }
}

#[test]
fn what_has_no_derivative_is_refused() {
    // The example of the paper hangs from anchors above each other and turns freely.
    let output = derivatives(&["--case", "three-equal-bars"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("no derivative here"), "{said}");

    // So does a triangle of rods below one rod, whatever is asked.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("turning.json");
    let turning = r#"{"joints": {"A": {"at_m": [0,0,0]}, "P": {}, "Q": {"mass_kg":1}, "R": {"mass_kg":2}},
        "bars": [{"from":"A","to":"P","length_m":1,"mass_kg":0}, {"from":"P","to":"Q","length_m":1,"mass_kg":0},
                 {"from":"P","to":"R","length_m":1,"mass_kg":0}, {"from":"Q","to":"R","length_m":1,"mass_kg":0}]}"#;
    std::fs::write(&path, turning).unwrap();
    for asked in [&[][..], &["--of", "joints.Q.at_m.x"], &["--by", "bars.1.length_m"]] {
        let output = derivatives(&[&[path.to_str().unwrap()], asked].concat());
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(3), "{said}");
        assert!(said.contains("1 motion meets no stiffness"), "{said}");
    }

    let table: [(&[&str], _); 6] = [
        (&["--of", "joints.A.at_m.x"], "no derivatives of `joints.A.at_m.x`"),
        (&["--of", "bars.9.axial_n"], "there is no bar `9`"),
        (&["--by", "gravity_m_s2"], "no derivatives by `gravity_m_s2`"),
        (&["--by", "bars.*.mass_kg"], "no derivatives by `bars.*.mass_kg`"),
        (&["--by", "joints.lamps.mass_kg"], "did you mean `lamp`"),
        (&["--by", "bars.3.mass_kg"], "there is no bar 3"),
    ];
    refused(".", &["derivatives", "--case", "lamp"], &table);
}
