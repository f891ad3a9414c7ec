//! `funicular census` as its users meet it: tables, JSON, figure, CSV, refusals, exit codes.

use std::fmt::Write as _;
use std::process::Output;

use crate::run::{assert_no_null, folder, good, refused, says, stdout, words};
use serde_json::Value;

/// Values of order 10 in double precision, through a few operations.
pub const ROUNDING: f64 = 1e-13;

pub fn funicular(arguments: &[&str]) -> Output {
    crate::run::funicular(&[&["census"], arguments].concat())
}

/// A system file with these bars as (length, mass).
pub fn chain(name: &str, end_m: [f64; 3], bars: &[(f64, f64)]) -> String {
    let mut text =
        format!("name = \"{name}\"\n[anchors]\nstart_m = [0.0, 0.0, 0.0]\nend_m = {end_m:?}\n");
    for (length, mass) in bars {
        writeln!(text, "[[bars]]\nlength_m = {length:?}\nmass_kg = {mass:?}").unwrap();
    }
    let path = folder(name).join("chain.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// What is known of the one chain.
fn of_chain(value: &Value) -> &Value {
    &value["census"]["parts"][0]["chain"]
}

/// The JSON of a census that ends with this exit code.
pub fn json(arguments: &[&str], code: i32) -> Value {
    let output = funicular(&[arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(code), "{}", words(&output));
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(value["schema_version"], 3);
    let census = &value["census"];
    assert_eq!(
        census["count"].as_u64().unwrap(),
        value["equilibria"].as_array().unwrap().len() as u64
    );
    let parts = census["parts"].as_array().unwrap();
    let open = |part: &Value| {
        let of_chain = part["chain"]["undecided"].as_array().map_or(0, Vec::len) as u64;
        of_chain + part["net"]["undecided_boxes"].as_u64().unwrap_or_default()
    };
    assert_eq!(census["undecided_boxes"], parts.iter().map(open).sum::<u64>());
    assert!(
        parts
            .iter()
            .all(|part| part["chain"].is_null() || part["chain"]["check"]["passed"] == true)
    );
    let complete = census["complete"].as_bool().unwrap();
    // What is degenerate is named, but not in a complete list of isolated equilibria.
    assert_eq!(census["decided"].as_bool().unwrap(), code == 0);
    assert!(!complete || code == 0);
    for equilibrium in value["equilibria"].as_array().unwrap() {
        // Neither a NaN nor an infinity, which would come out as null.
        assert_no_null(equilibrium, &["circle", "gap", "index_in_plane"]);
        let reached = |rung: &str| {
            let ladder = equilibrium["evidence"]["ladder"].as_array().unwrap();
            ladder.iter().find(|s| s["rung"] == rung).unwrap()["reached"].as_bool().unwrap()
        };
        assert!(reached("verified") && !reached("agreed"));
        assert_eq!(reached("complete"), complete);
        if let Some(enclosed) = equilibrium["enclosures"]["energy_j"].as_array() {
            let energy = number(&equilibrium["energy_j"]);
            assert!(number(&enclosed[0]) <= energy && energy <= number(&enclosed[1]));
        }
    }
    value
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn the_paper_in_tables() {
    let output = funicular(&["--case", "three-equal-bars"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
    let text = stdout(&output);
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for wanted in [
        "4 equilibria in a vertical plane, 2 circles in space",
        "proved to be all",
        "2.3354686519993",
        "3.6645313480007",
        "286.079411207769",
        "-73.9205887922313",
        "TTC",
        "TCC",
        "verified  4 of 4",
        "complete  4 of 4",
        "optimal   2 of 4",
        "agreed    0 of 4",
        "Betti numbers [1, 1]",
        "every equilibrium listed is proved again without the search",
        "That the list is complete rests on the search",
    ] {
        let is_there = text.contains(wanted) || words.contains(wanted);
        assert!(is_there, "{wanted} is not in\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
}

#[test]
fn coincident_anchors_are_circles() {
    let value = json(&["--case", "slack"], 0);
    assert_eq!(value["census"]["circles"], true);
    assert_eq!(of_chain(&value)["betti"], serde_json::json!([1, 2, 1]));
    let text = stdout(&funicular(&["--case", "slack"]));
    assert!(text.contains("circles in space") && text.contains("proved to be all"), "{text}");
}

/// Six bars of 0.5 m between level anchors 2 m apart: the lengths fit into a straight line, in six
/// ways, and no equilibrium is near it.
#[test]
fn a_straight_position_is_named_and_apart_from_all_equilibria() {
    let file = chain("classroom", [2.0, 0.0, 0.0], &[(0.5, 1.0); 6]);
    let value = json(&[&file], 0);
    let census = &value["census"];
    assert_eq!((&census["complete"], &census["undecided_boxes"]), (&true.into(), &0.into()));
    let straight = of_chain(&value)["straight"].as_array().unwrap();
    assert_eq!(straight.len(), 6);
    assert_eq!(straight[0]["along"], serde_json::json!([1, 1, 1, 1, 1, -1]));
    assert_eq!(straight[0]["upright"], false);
    let text = stdout(&funicular(&[&file]));
    assert!(text.contains("In 6 positions the bars lie in the line"), "{text}");
    assert!(text.contains("no equilibrium is near") && text.contains("the search alone"), "{text}");
}

/// Bars of 1 m with 1 kg in positions that are not isolated: 1 + 1 − 1 = 1, three ways to hang upright, each under any
/// force; and four equilibria that have merged, where bar 1 hangs as heavily as bar 3 stands. (`keys/census.txt` has their
/// numbers.)
#[test]
fn what_is_not_isolated_is_told() {
    for (name, end, code, said) in [
        ("upright", [0.0, 0.0, -1.0], 0, "3 upright positions with any force: proved to be all"),
        ("step", [1.0, 0.0, -2.0], 3, "NOT proved to be all"),
    ] {
        let file = chain(name, end, &[(1.0, 1.0); 3]);
        assert_eq!(json(&[&file], code)["census"]["complete"], false);
        let text = stdout(&funicular(&[&file])).replace('\n', " ");
        assert!(text.contains(said), "{text}");
        assert_eq!(text.contains("Undecided: 1 box of pulls"), name == "step", "{text}");
    }
}

#[test]
fn a_nearly_straight_closure_is_undecided_and_says_so() {
    // 1 + 1 + 1 - 1 = 2, which is next to the distance of these anchors, but not that.
    let file = chain("straight", [1.2, 0.0, -1.6], &[(1.0, 1.0); 4]);
    json(&[&file], 3);
    let output = funicular(&[&file]);
    assert_eq!(output.status.code(), Some(3));
    let text = stdout(&output);
    says(
        &text,
        &["NOT proved to be all", "Undecided:", "unbounded", "complete  0 of", "straight position"],
    );
    // The figure says so too.
    let svg = folder("straight-figure").join("figure.svg");
    let output = funicular(&[&file, "--svg", svg.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    let text = std::fs::read_to_string(svg).unwrap();
    assert!(text.contains("not proved to be all") && text.contains("not drawn"));
    assert!(roxmltree::Document::parse(&text).is_ok());
}

#[test]
fn slack_families_are_listed_as_such() {
    // Weights on strings: massless bars that can hang slack in the middle.
    let file = chain(
        "strings",
        [0.3, 0.0, 0.5],
        &[(0.9, 0.0), (0.4, 3.0), (0.85, 0.0), (1.0, 0.0), (0.35, 2.0)],
    );
    let value = json(&[&file], 0);
    let chain = of_chain(&value);
    let families = chain["slack_families"].as_array().unwrap();
    assert!(!families.is_empty());
    assert_eq!(value["census"]["slack_families"], families.len());
    for family in families {
        assert_eq!((&family["signs"][2], &family["signs"][3]), (&0.into(), &0.into()));
        assert_eq!(family["dimension_in_plane"], 0);
        assert!(number(&family["energy_j"][0]) <= number(&family["energy_j"][1]));
    }
    assert_eq!(chain["alternating_sum"], chain["euler_characteristic"]);
    let text = stdout(&funicular(&[&file]));
    assert!(text.contains("families of slack bars") && text.contains(".."), "{text}");
}

#[test]
fn of_many_equilibria_the_first_are_printed_bar_by_bar() {
    // Seven different bars: more equilibria than are printed, and far more bars.
    let bars: Vec<(f64, f64)> =
        (0..7).map(|k| (0.5 + 0.037 * f64::from(k * k % 11), 1.0)).collect();
    let file = chain("many", [1.1, 0.0, 0.3], &bars);
    let value = json(&[&file], 0);
    let count = value["census"]["count"].as_u64().unwrap();
    assert!(count > 40, "{count}");
    let text = stdout(&funicular(&[&file]));
    let (_, angles) = text.split_once("Angles from the descending vertical").unwrap();
    let (angles, _) = angles.split_once("Evidence:").unwrap();
    // Eleven equilibria of seven bars are 77 lines, below the limit of 80.
    assert_eq!(angles.lines().filter(|line| line.contains("e-1")).count(), 77, "{text}");
    // The first and the eleventh are there, as in the JSON: ten digits say so.
    for k in [0, 10] {
        let angle = format!("{:?}", number(&value["equilibria"][k]["angles_deg"][6]));
        assert!(angles.contains(&angle[..11]), "{angle} is not in\n{angles}");
    }
    let more = format!("... and {} equilibria with their joints and members more", count - 11);
    assert!(angles.contains(&more) && angles.contains("--json or --csv FILE"), "{angles}");
    let more = format!("... and {} equilibria more", count - 40);
    assert!(text.contains(&more), "{text}");
}

#[test]
fn chains_out_of_reach_are_refused_with_their_cost() {
    let output = funicular(&["--case", "thirty-bars"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let text = words(&output);
    says(
        &text,
        &["30 bars", "patterns", "about", "no census goes beyond 24 bars", "funicular solve"],
    );
    let output = funicular(&["--case", "five-in-space", "--max-bars", "4"]);
    assert_eq!(output.status.code(), Some(2));
    let text = words(&output);
    assert!(
        text.contains("the limit is 4 bars") && text.contains("--max-bars 5 takes it"),
        "{text}"
    );
    // And that goes on.
    good(".", &["census", "--case", "five-in-space", "--max-bars", "5"]);
}

#[test]
fn bad_input_is_refused_with_its_reason() {
    let single = chain("single", [1.0, 0.0, 0.0], &[(1.0, 1.0)]);
    let short = chain("short", [4.0, 0.0, 0.0], &[(1.0, 1.0); 3]);
    let weightless = chain("weightless", [1.0, 0.0, 0.0], &[(1.0, 0.0); 3]);
    let nowhere = folder("nowhere").join("missing").join("figure.svg");
    let directory = folder("directory");
    let table = [
        (&[single.as_str()][..], "nothing can move"),
        (&[short.as_str()], "m are missing"),
        (&[weightless.as_str()], "no mass and no force act"),
        (&["no-such-file.toml"], "no-such-file.toml"),
        (&["--case", "no-such-case"], "no case named"),
        (&[], "required"),
        (&["--case", "two-bars", "--max-bars", "0"], "max_bars must be from 1 to 24"),
        (&["--case", "two-bars", "--max-bars", "25"], "max_bars must be from 1 to 24"),
        (&["--case", "two-bars", "--max-bars", "many"], "invalid value"),
        (&["--case", "two-bars", "--threads", "1025"], "up to 1024 is required"),
        (&["--case", "two-bars", "--svg", nowhere.to_str().unwrap()], "there is no folder"),
        (&["--case", "two-bars", "--csv", directory.to_str().unwrap()], "it is a folder"),
    ];
    refused(".", &["census"], &table);
}

/// Thirteen bars close in many ways, whatever way is left to them.
pub fn thirteen_bars(name: &str, span: f64) -> String {
    let bars: Vec<(f64, f64)> =
        (0..13).map(|k| (1.0 + 0.37 * f64::from(k % 5), 1.0 + 0.11 * f64::from(k % 7))).collect();
    chain(name, [span, 0.0, -0.7], &bars)
}
