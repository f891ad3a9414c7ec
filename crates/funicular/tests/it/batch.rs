//! Many systems at a time: several files, and a system in every line.

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Output, Stdio};

use crate::run::{Running, folder, good, program, ran};
use serde_json::Value;

/// A mass of 2 kg on two massless cables: by the triangle 3, 4, 5 each pulls with 5/4 of 10 N.
const LAMP: &str = r#"{"gravity_m_s2": 10, "joints": {"A": {"at_m": [-3, 0, 0]}, "B": {"at_m": [3, 0, 0]}, "P": {"mass_kg": 2}}, "bars": [{"from": "A", "to": "P", "length_m": 5, "mass_kg": 0, "kind": "cable"}, {"from": "P", "to": "B", "length_m": 5, "mass_kg": 0, "kind": "cable"}]}"#;

/// Six bars of 1 kg between level anchors this far apart.
fn chain(span_m: f64) -> String {
    format!(
        r#"{{"anchors": {{"start_m": [0, 0, 0], "end_m": [{span_m}, 0, 0]}}, "bars": [{{"length_m": 0.5, "mass_kg": 1, "count": 6}}]}}"#
    )
}

fn objects(output: &Output) -> Vec<Value> {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// An answer without what differs from run to run.
fn without_times(mut answer: Value) -> Value {
    for e in answer["equilibria"].as_array_mut().unwrap() {
        e["evidence"]["solve_s"].take();
    }
    answer
}

#[test]
fn every_line_is_answered_in_its_place_and_errors_end_nothing() {
    let folder = folder("lines");
    let unknown = chain(2.0).replace("mass_kg", "mass");
    let far = chain(3.5);
    let lines = [&chain(1.0), LAMP, "", &unknown, "[joints]", &far, &chain(2.0)];
    std::fs::write(folder.join("all.jsonl"), lines.join("\n")).unwrap();
    let output = ran(&folder, &["solve", "--batch", "all.jsonl"]);
    assert_eq!(output.status.code(), Some(2));
    let answers = objects(&output);
    let numbers: Vec<_> = answers.iter().map(|answer| answer["line"].as_u64().unwrap()).collect();
    assert_eq!(numbers, [1, 2, 4, 5, 6, 7]);
    for k in [0, 5] {
        // Half of 6 kg at each anchor, by symmetry.
        let up = answers[k]["equilibria"][0]["reactions_n"]["0"][2].as_f64().unwrap();
        assert!((up - 3.0 * 9.806_65).abs() < 1e-9, "{up}");
        assert_eq!(answers[k]["agreement"]["verdict"], "agreed");
    }
    let axial = answers[1]["equilibria"][0]["bars"][0]["axial_n"].as_f64().unwrap();
    assert!((axial - 12.5).abs() < 1e-9, "{axial}");
    assert_eq!(answers[2]["key"], "bars[1].mass");
    assert_eq!(answers[2]["error"], "unknown key `mass`");
    // Where the key stands in its line, from 1.
    let column = unknown.find("\"mass\"").unwrap() as u64 + 1;
    assert!(answers[2]["column"].as_u64().unwrap().abs_diff(column) <= 1, "{}", answers[2]);
    assert!(answers[2]["help"].as_str().unwrap().contains("mass_kg"));
    assert!(answers[3]["error"].as_str().unwrap().contains("object of JSON"));
    assert!(answers[4]["error"].as_str().unwrap().contains("apart"), "{}", answers[4]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("6 systems: 3 done, 3 that cannot be used"), "{said}");
    // The bars at rest are those of a file of their own; a batch takes no census.
    std::fs::write(folder.join("one.json"), chain(1.0)).unwrap();
    let alone = ran(&folder, &["solve", "one.json", "--json", "--census=never"]);
    let mut alone: Value = serde_json::from_slice(&alone.stdout).unwrap();
    alone["line"] = 1.into();
    assert_eq!(without_times(alone), without_times(answers[0].clone()));
}

#[test]
fn a_batch_from_standard_input_is_the_same_on_any_number_of_threads() {
    let folder = folder("stdin");
    let mut text = String::new();
    for k in 0..300 {
        let line = if k % 7 == 3 { LAMP.to_owned() } else { chain(0.2 + 0.009 * f64::from(k)) };
        writeln!(text, "{line}").unwrap();
    }
    let by = |threads: &str| {
        let mut child = program(&folder, &["solve", "--batch", "-", "--threads", threads])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut to = child.stdin.take().unwrap();
        let sent = text.clone();
        let writer = std::thread::spawn(move || to.write_all(sent.as_bytes()).unwrap());
        let output = child.wait_with_output().unwrap();
        writer.join().unwrap();
        assert_eq!(output.status.code(), Some(0));
        objects(&output).into_iter().map(without_times).collect::<Vec<_>>()
    };
    let [one, three] = ["1", "3"].map(by);
    assert_eq!(one.len(), 300);
    assert_eq!(one, three);
    assert!(one.iter().zip(1_u64..).all(|(answer, line)| answer["line"] == line));
}

#[test]
fn a_census_is_taken_where_it_is_asked_for() {
    let folder = folder("census");
    std::fs::write(folder.join("a.jsonl"), chain(1.0)).unwrap();
    let looked_up = |option: &[&str]| {
        let output = ran(&folder, &[&["solve", "--batch", "a.jsonl"], option].concat());
        let ladder = &objects(&output)[0]["equilibria"][0]["evidence"]["ladder"];
        let rungs = ladder.as_array().unwrap();
        rungs.iter().any(|rung| rung["rung"] == "verified" && rung["reached"] == true)
    };
    assert!(looked_up(&["--census"]) && looked_up(&["--census=always"]));
    assert!(!looked_up(&[]) && !looked_up(&["--census=never"]));
}

#[test]
fn an_empty_batch_is_done_and_a_missing_one_is_bad_input() {
    let folder = folder("empty");
    std::fs::write(folder.join("none.jsonl"), "\n\n").unwrap();
    let output = ran(&folder, &["solve", "--batch", "none.jsonl"]);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(0), 0));
    for arguments in [
        &["--batch", "nowhere"][..],
        &["--batch", "."],
        &["--batch", "none.jsonl", "--csv", "a.csv"],
        &["--batch", "none.jsonl", "--format", "csv"],
        &["--batch", "none.jsonl", "--units", "kN"],
    ] {
        assert_eq!(ran(&folder, &[&["solve"], arguments].concat()).status.code(), Some(2));
    }
}

/// Ctrl-C while lines still come: what was written are whole lines.
#[cfg(unix)]
#[test]
fn an_interrupted_batch_leaves_whole_lines() {
    let folder = folder("interrupt");
    let mut command = program(&folder, &["solve", "--batch", "-", "--summary"]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut running = Running(command.spawn().unwrap());
    let mut to = running.0.stdin.take().unwrap();
    // More than are answered while `kill` begins on a loaded machine, and few enough to be held where nothing is interrupted.
    let feed = std::thread::spawn(move || {
        (0..1_000_000).take_while(|_| writeln!(to, "{}", chain(1.0)).is_ok()).count()
    });
    let mut from = BufReader::new(running.0.stdout.take().unwrap());
    let mut first = String::new();
    from.read_line(&mut first).unwrap();
    running.signal("INT");
    let mut rest = String::new();
    std::io::Read::read_to_string(&mut from, &mut rest).unwrap();
    assert_eq!(running.code(), Some(130));
    feed.join().unwrap();
    assert!(rest.is_empty() || rest.ends_with('\n'));
    for line in rest.lines() {
        assert!(serde_json::from_str::<Value>(line).is_ok(), "{line}");
    }
}

#[test]
fn several_files_are_answered_in_their_order_with_the_worst_exit_code() {
    let folder = folder("files");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write("a.json", &chain(1.0));
    write("lamp.json", LAMP);
    write("bad.json", "{\"anchors\": 1}");
    let text = good(&folder, &["solve", "a.json", "lamp.json"]);
    let [a, lamp] = ["=== a.json ===", "=== lamp.json ==="].map(|head| text.find(head).unwrap());
    assert!(a < lamp && text[a..lamp].contains("Agreement: agreed"), "{text}");
    assert!(text[lamp..].contains("Largest tension: 12.5 N"), "{text}");

    let output = ran(&folder, &["solve", "bad.json", "a.json", "gone.json"]);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("=== gone.json ===") && text.contains("Agreement: agreed"), "{text}");
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("bad.json:1:") && said.contains("gone.json"), "{said}");

    let output = ran(&folder, &["solve", "bad.json", "a.json", "--json", "--summary"]);
    let mut answers = serde_json::Deserializer::from_slice(&output.stdout).into_iter::<Value>();
    let [bad, a] = [answers.next().unwrap().unwrap(), answers.next().unwrap().unwrap()];
    assert!(answers.next().is_none());
    assert!(bad["file"] == "bad.json" && bad["error"].as_str().unwrap().contains("anchors"));
    assert!(a["file"] == "a.json" && a["agreement"]["verdict"] == "agreed");
    assert!(a["equilibria"][0].get("joints").is_none());

    let output = ran(&folder, &["solve", "a.json", "lamp.json", "--svg", "p.svg"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("--svg"));
}

/// Every line has the work of its own, a chain too, and one that needs more takes itself alone and names the
/// bound.
#[test]
fn a_line_ends_with_its_work() {
    let folder = folder("work");
    // A third cable of the lamp's, so that it is no row between two anchors.
    let net = LAMP.replace(r#""joints": {"#, r#""joints": {"C": {"at_m": [0, 3, 0]}, "#).replace(
        r#""bars": ["#,
        r#""bars": [{"from": "C", "to": "P", "length_m": 5, "mass_kg": 0, "kind": "cable"}, "#,
    );
    let lines = format!("{net}\n{}\n", chain(1.0));
    std::fs::write(folder.join("all.jsonl"), lines.repeat(10)).unwrap();
    for (work, agree) in [("1", [false, false]), ("50", [false, true]), ("200", [true, true])] {
        let arguments = ["solve", "--batch", "all.jsonl", "--summary", "--max-work", work];
        let bounded = ran(&folder, &arguments);
        assert_eq!(bounded.status.code(), Some(if agree[0] { 0 } else { 3 }), "{work}");
        let answers = objects(&bounded);
        assert_eq!(answers.len(), 20);
        for (answer, agrees) in answers.iter().zip(agree.iter().cycle()) {
            assert_eq!(answer["agreement"]["verdict"] == "agreed", *agrees, "{work}: {answer}");
            for failure in answer["failures"].as_array().into_iter().flatten() {
                assert_eq!(failure["refusal"]["max_work"].to_string(), work, "{failure}");
            }
        }
    }
}
