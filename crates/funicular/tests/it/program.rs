//! The program as its users meet it: exit codes, JSON keys, errors, files.

use std::path::PathBuf;
use std::process::Output;
use std::sync::LazyLock;

use crate::run::{fails, fed, folder, funicular, good, json, program, says, stderr, stdout};
use serde_json::Value;

fn file(folder: &str, text: &str) -> String {
    let path = crate::run::folder(folder).join("chain.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// `reproduce` with its files, run once for all tests.
pub static REPRODUCED: LazyLock<(Output, PathBuf)> = LazyLock::new(|| {
    let out = folder("reproduce").join("deep").join("report");
    (funicular(&["reproduce", "--out", out.to_str().unwrap()]), out)
});

#[test]
fn reproduce_finds_what_is_expected_and_writes_it() {
    let (output, out) = &*REPRODUCED;
    assert_eq!(output.status.code(), Some(0), "{}", stdout(output));
    let text = stdout(output);
    says(&text, &["refuted", "E2'", "Every verdict is the expected one", "100.00 %"]);
    let json: Value =
        serde_json::from_str(&std::fs::read_to_string(out.join("results.json")).unwrap()).unwrap();
    assert_eq!(json["schema_version"], 3);
    assert_eq!(json["all_as_expected"], true);
    assert!(json["figures"]["closure_curve"].as_array().unwrap().len() > 100);
    let report = std::fs::read_to_string(out.join("report.md")).unwrap();
    // Every table has as many cells in each row as in its head.
    for block in report.split("\n\n").filter(|block| block.starts_with('|')) {
        let cells = |line: &str| line.replace("\\|", "").matches('|').count();
        let head = cells(block.lines().next().unwrap());
        assert!(block.lines().all(|line| cells(line) == head), "{block}");
    }
    assert!(std::fs::read_to_string(out.join("comparison.csv")).unwrap().lines().count() > 100);
}

#[test]
fn summary_and_a_single_solver() {
    let arguments = "solve --case hundred-bars --json --summary --solver energy".split(' ');
    let json = json(&funicular(&arguments.collect::<Vec<_>>()));
    let equilibrium = &json["equilibria"][0];
    assert!(["joints", "bars", "reactions_n"].iter().all(|key| equilibrium[key].is_null()));
    assert!(json["agreement"].is_null());
    let ladder = equilibrium["evidence"]["ladder"].as_array().unwrap();
    assert_eq!(ladder[1]["reached"], false);
}

fn solved(folder: &str, text: &str, arguments: &[&str]) -> (Option<i32>, Value) {
    let path = file(folder, text);
    let output = funicular(&[&["solve", &path, "--json"], arguments].concat());
    let json = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{folder}: {error}\n{}", stderr(&output)));
    (output.status.code(), json)
}

/// Two bars without mass just fail to reach between two that hang plumb.
const JUST_BRIDGED: &str = "
[anchors]
start_m = [0, 0, 0]
end_m = [2.00000001, 0, 0]
[[bars]]
length_m = 1
mass_kg = 1
[[bars]]
length_m = 1
mass_kg = 0
count = 2
[[bars]]
length_m = 1
mass_kg = 1
";

/// Exit 0 means that nothing that was tried speaks against the answer; here a complete census is
/// taken.
#[test]
fn an_answer_that_the_census_refutes_is_no_success() {
    let heavy = JUST_BRIDGED.replace("2.00000001, 0, 0", "1.5, 0, -0.5").replace(
        "mass_kg = 1\n[[bars]]\nlength_m = 1\nmass_kg = 0\ncount = 2",
        "mass_kg = 1e12\n[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 2",
    );
    assert!(heavy.contains("1e12"));
    for (name, text) in [("refuted", JUST_BRIDGED), ("refuted-heavy", &heavy)] {
        for arguments in [&["--solver", "energy"][..], &["--solver", "lagrange"], &[]] {
            let (code, json) = solved(name, text, arguments);
            for answer in json["equilibria"].as_array().unwrap() {
                let ladder = &answer["evidence"]["ladder"];
                let refuted = ladder[3]["reason"]["kind"] == "refuted_by_census";
                assert!(refuted || ladder[3]["reached"] == true, "{name} {ladder:#}");
                assert!(code == Some(1) || !refuted, "{name} {arguments:?} {code:?} {ladder:#}");
            }
        }
    }
}

/// What one solver finds is shown, whatever the other does.
#[test]
fn the_answer_of_one_solver_is_kept_where_the_other_has_none() {
    let text = "
[anchors]
start_m = [0.0, 0.0, 0.0]
end_m = [7.988872883551471e-14, 0.0, -2.344069907932715]
[[bars]]
length_m = 1.8977526430056555
mass_kg = 1.4445710758355859
centre_m = 1.2723967321422471
[[bars]]
length_m = 0.9662752964852226
mass_kg = 1.3033106945140618
centre_m = 0.12310672070929912
[[bars]]
length_m = 0.5199585828249038
mass_kg = 2.208322628172228
centre_m = 0.23910237774903406
";
    let (code, json) = solved("refused", text, &[]);
    let answers = json["equilibria"].as_array().unwrap();
    let failures = json["failures"].as_array().unwrap();
    assert_eq!(answers.len() + failures.len(), 2);
    assert!(!answers.is_empty());
    if let [failure] = &failures[..] {
        assert!(code == Some(3) && json["agreement"].is_null());
        assert!(!failure["reason"].as_str().unwrap().is_empty());
        let agreed = &answers[0]["evidence"]["ladder"][1];
        assert_eq!(agreed["reason"]["kind"], "other_solver_without_answer");
        assert_eq!(agreed["reason"]["solver"], failure["solver"]);
    }
}

/// Bars of 2, 1 and 1 m that are folded to a hundred-millionth of their length, on a slope, are beyond
/// the full equations and beyond the second solver; a mass on a strut, which cannot pull, falls
/// for ever: JSON says so, and is JSON all the same.
#[test]
fn where_no_solver_has_an_answer_json_holds_the_refusals() {
    let folded = "anchors = { start_m = [0, 0, 0], end_m = [1e-8, 0, 1e-8] }\n\
                  bars = [{ length_m = 2, mass_kg = 1 }, { length_m = 1, mass_kg = 1, count = 2 }]\n";
    let falls = "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
                 bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"strut\" }]\n";
    for (name, text, arguments, solvers) in [
        ("folded", folded, &["--equations", "full"][..], &["lagrange", "energy"][..]),
        ("folded", folded, &["--solver", "energy", "--summary"], &["energy"]),
        ("falls", falls, &["--solver", "lagrange"], &["lagrange"]),
        ("falls", falls, &["--solver", "lagrange", "--summary"], &["lagrange"]),
    ] {
        let (code, json) = solved(name, text, arguments);
        assert_eq!(code, Some(3), "{name}: {json:#}");
        assert_eq!(json["schema_version"], 3);
        assert_eq!(json["system"]["name"], "unnamed");
        assert!(json["equilibria"].as_array().unwrap().is_empty());
        assert!(json["agreement"].is_null());
        let failures = json["failures"].as_array().unwrap();
        let names: Vec<_> = failures.iter().map(|failure| failure["solver"].as_str()).collect();
        assert_eq!(names, solvers.iter().copied().map(Some).collect::<Vec<_>>());
        for failure in failures {
            assert!(!failure["reason"].as_str().unwrap().is_empty());
            let refusal = failure["refusal"].as_object().unwrap();
            assert!(refusal["kind"].is_string() && refusal.len() > 1, "{refusal:?}");
        }
    }
}

/// Where all weight rests on the anchors every position is an equilibrium: every command says so.
#[test]
fn weight_on_the_anchors_alone_is_bad_input_for_every_command() {
    let path = file(
        "on-anchors",
        "anchors = { start_m = [0, 0, 0], end_m = [1.5, 0, 0] }\n\
         bars = [{ length_m = 1, mass_kg = 1, centre_m = 0 }, { length_m = 1, mass_kg = 0 }, \
         { length_m = 1, mass_kg = 1, centre_m = 1 }]\n",
    );
    for command in ["solve", "census"] {
        fails(&funicular(&[command, &path]), 2, "every position is an equilibrium");
    }
}

#[test]
fn a_plane_chain_has_no_rounding_across_its_plane() {
    let folder = folder("csv");
    let joints = folder.join("joints.csv");
    let arguments = ["solve", "--case", "ten-equal-bars", "--csv", joints.to_str().unwrap()];
    good(".", &arguments);
    let joints = std::fs::read_to_string(joints).unwrap();
    assert_eq!(joints.lines().count(), 1 + 2 * 11);
    // The chain hangs in the plane y = 0, whatever rounding says.
    assert!(joints.lines().skip(1).all(|line| line.split(',').nth(3) == Some("0.0")), "{joints}");
    let files = std::fs::read_dir(&folder).unwrap().count();
    assert_eq!(files, 1, "a temporary file is left behind");
}

#[test]
fn bad_input_ends_with_code_2_and_shows_the_line() {
    let path = file(
        "misspelt",
        "[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n[[bars]]\nlenght_m = 1\nmass_kg = 1\n",
    );
    let output = funicular(&["solve", &path]);
    assert_eq!(output.status.code(), Some(2));
    let text = stderr(&output);
    assert!(
        text.contains("lenght_m = 1")
            && text.contains("did you mean `length_m`?")
            && text.contains("5:1"),
        "{text}"
    );

    let path = file(
        "out-of-reach",
        "[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -9]\n[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 3\n",
    );
    fails(&funicular(&["solve", &path]), 2, "6 m are missing");

    let directory = folder("a-directory");
    for arguments in [
        vec!["solve", directory.to_str().unwrap()],
        vec!["solve", "no-such-file.toml"],
        vec!["solve", "--case", "no-such-case"],
        vec!["solve"],
        vec!["solve", "a.toml", "--case", "two-bars"],
        vec!["cases", "no-such-case"],
        vec!["walk"],
        vec![],
    ] {
        let output = funicular(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!stderr(&output).trim().is_empty(), "{arguments:?}");
        assert!(stdout(&output).is_empty(), "{arguments:?}");
    }
    // A folder that cannot be made is bad input too, said before the work.
    let path = file("not-a-folder", "");
    let output = funicular(&["reproduce", "--out", &path]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn a_new_file_can_be_solved_as_it_is_and_from_standard_input() {
    let new = funicular(&["new"]);
    assert_eq!(new.status.code(), Some(0));
    let output = fed(program(".", &["solve", "-"]), new.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = stdout(&output);
    // The weight between the anchors, 3.4 kg, and the forces of README.md.
    let words: Vec<&str> = text.split_whitespace().collect();
    for wanted in [["-8.09867", "0", "25.6669"], ["8.09867", "0", "7.67575"]] {
        assert!(words.windows(3).any(|three| three == wanted), "{text}");
    }
    assert!(text.contains("Agreement: agreed"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
}

/// A long chain is printed by quantities as well as by joints and bars, with the same numbers.
#[test]
fn columns_have_the_numbers_of_the_objects() {
    let json = |lists: &[&str]| -> Value {
        let asked = ["solve", "--case", "five-in-space", "--json", "--census=never"];
        serde_json::from_slice(&funicular(&[&asked, lists].concat()).stdout).unwrap()
    };
    let (objects, columns) = (json(&[]), json(&["--columns"]));
    for (one, all) in objects["equilibria"]
        .as_array()
        .unwrap()
        .iter()
        .zip(columns["equilibria"].as_array().unwrap())
    {
        for (list, key, column) in [
            ("joints", "at_m", "joints_m"),
            ("bars", "axial_n", "axial_n"),
            ("bars", "axial_from_n", "axial_from_n"),
            ("bars", "axial_to_n", "axial_to_n"),
            ("bars", "axial_max_n", "axial_max_n"),
            ("bars", "force_at_start_n", "start_forces_n"),
            ("bars", "force_at_end_n", "end_forces_n"),
        ] {
            let objects = one[list].as_array().unwrap().iter().map(|object| object[key].clone());
            assert_eq!(all[column], objects.collect::<Value>(), "{column}");
        }
        assert_eq!(one["reactions_n"], all["reactions_n"]);
        assert!(all["joints"].is_null() && all["bars"].is_null());
    }
}

/// The paper's equations are those of a row of bars, and are never left aside without a word.
#[test]
fn the_full_equations_are_refused_for_another_system() {
    let refused = funicular(&["solve", "--case", "bridle", "--equations", "full"]);
    fails(&refused, 2, "is for chains between two anchors");
    good(".", &["solve", "--case", "five-in-space", "--equations", "full"]);
}
