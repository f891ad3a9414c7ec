//! An answer of the library as text is what the program prints.

use std::fmt::Display;

use funicular::judge::{fit, parse};
use funicular::prelude::*;

use crate::program::REPRODUCED;
use crate::run::{funicular, stdout};

/// Without lines that say how long something took.
fn timeless(text: &str) -> String {
    let timed = |line: &&str| !line.contains(" cells") && !line.contains(" a second, ");
    text.lines().filter(timed).flat_map(|line| [line, "\n"]).collect()
}

/// The program says the same, with words of its own before or behind it at most.
fn assert_said(arguments: &[&str], answer: &impl Display) {
    let printed = timeless(&stdout(&funicular(arguments)));
    let text = timeless(&answer.to_string());
    assert!(text.lines().count() > 1, "{text}");
    assert!(printed.contains(&text), "{printed}\n--- the library:\n{text}");
}

#[test]
fn shapes_and_lists() {
    let lamp = Problem::case("lamp").unwrap();
    assert_said(&["solve", "--case", "lamp"], &Solve::new().run(&lamp).unwrap());
    let bars = Problem::case("three-equal-bars").unwrap();
    assert_said(&["solve", "--case", "three-equal-bars"], &Solve::new().run(&bars).unwrap());
    for (case, problem) in [("lamp", &lamp), ("three-equal-bars", &bars)] {
        assert_said(&["census", "--case", case], &Census::new().run(problem).unwrap());
    }
    assert_said(&["modes", "--case", "three-equal-bars"], &Modes::new().run(&bars).unwrap());
}

#[test]
fn numbers_over_numbers() {
    let bars = Problem::case("three-equal-bars").unwrap();
    let vary = "anchors.end_m.z=-2.9..-0.5:5";
    let over = ["--case", "three-equal-bars", "--vary", vary];
    let with = |command: &'static str| [&[command], &over[..]].concat();
    assert_said(&with("study"), &Study::new().vary(vary).unwrap().run(&bars).unwrap());
    assert_said(&with("trace"), &Trace::new().vary(vary).unwrap().run(&bars).unwrap());
    let derivatives = Derivatives::new().run(&Problem::case("lamp").unwrap()).unwrap();
    let asked = |option, of| ["derivatives", "--case", "lamp", option, of];
    let (of, by) = ("joints.lamp.at_m.z", "bars.1.length_m");
    assert_said(&asked("--of", of), &derivatives.gradient(of).unwrap());
    assert_said(&asked("--by", by), &derivatives.change(by).unwrap());
}

#[test]
fn judgements() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("answer.csv");
    let table = "joint,x_m,y_m,z_m\n1,0,0.5,-0.9\n2,0,0.6,-1.8\n";
    std::fs::write(&file, table).unwrap();
    let problem = Problem::case("three-equal-bars").unwrap();
    let name = file.to_str().unwrap();
    let answer = parse(table, name).unwrap().remove(0);
    let answer = fit(&problem.system(), answer).unwrap();
    let judged = Judge::new().run(&problem, &answer).unwrap();
    assert_said(&["judge", "--case", "three-equal-bars", "--answer", name], &judged);
}

#[test]
fn starts_and_motions() {
    let bars = Problem::case("three-equal-bars").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("sweep");
    let arguments = ["--seeds", "200", "--out", out.to_str().unwrap()];
    let case = ["--case", "three-equal-bars"];
    let swept = Sweep::new(200).run(&bars).unwrap();
    assert_said(&[&["sweep"], &case[..], &arguments].concat(), &swept);
    let out = folder.path().join("basins");
    let arguments = ["--size", "8", "--out", out.to_str().unwrap()];
    let basins = Basins::new().size(8).run(&bars).unwrap();
    assert_said(&[&["basins"], &case[..], &arguments].concat(), &basins);
    let moved = Simulate::new().push("1", [0.0, 0.5, 0.0]).time_s(0.1).run(&bars).unwrap();
    let arguments = ["--push", "1=0,0.5,0", "--time", "0.1"];
    assert_said(&[&["simulate"], &case[..], &arguments].concat(), &moved);
}

#[test]
fn the_paper() {
    // At last it says how long it took, and the program where its files are.
    let answer = Reproduce::new().run().unwrap().to_string();
    let but_last = |text: &str| text.trim_end().rsplit_once(" in ").unwrap().0.to_owned();
    let printed = stdout(&REPRODUCED.0);
    assert!(answer.lines().count() > 50, "{answer}");
    assert_eq!(but_last(&printed), but_last(&answer));
}
