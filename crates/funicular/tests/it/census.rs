//! `funicular census` as its users meet it: tables, JSON, figure, CSV, refusals, exit codes.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fmt::Write as _;
use std::process::Output;

use crate::run::{Running, assert_no_null, folder, refused, says, stdout, words};
use serde_json::Value;

/// Energy of E2 with the paper's zero, mgl (external: 40-digit root finding, and a Gröbner basis with real-root
/// counting).
const E2_MGL: f64 = 3.664_531_348_000_695;

/// Of the paper's case: 1 kg, 1 m, standard gravity.
const MGL: f64 = 9.80665;

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

fn close(value: &Value, expected: f64) {
    let value = number(value);
    assert!((value - expected).abs() <= ROUNDING * expected.abs().max(1.0), "{value} {expected}");
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
fn the_figure_holds_four_shapes_and_the_csv_all_joints() {
    let out = folder("paper");
    let [svg, csv] = ["shapes.svg", "shapes.csv"].map(|name| out.join(name));
    let [svg_path, csv_path] = [&svg, &csv].map(|path| path.to_str().unwrap());
    let output = funicular(&[
        "--case",
        "three-equal-bars",
        "--svg",
        svg_path,
        "--csv",
        csv_path,
        "--threads",
        "1",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    let text = std::fs::read_to_string(&svg).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let root = document.root_element();
    assert!(root.has_tag_name(("http://www.w3.org/2000/svg", "svg")));
    let children =
        |tag: &str| root.children().filter(|child| child.tag_name().name() == tag).count();
    assert_eq!((children("title"), children("desc")), (1, 1));
    let class = |node: &roxmltree::Node, class: &str| node.attribute("class") == Some(class);
    let shapes: Vec<_> = root.children().filter(|node| class(node, "shape")).collect();
    assert_eq!(shapes.len(), 4);
    for (shape, compressed) in shapes.iter().zip([1, 1, 2, 2]) {
        let count = |name: &str| shape.children().filter(|node| class(node, name)).count();
        assert_eq!((count("bar"), count("core")), (3, compressed));
        assert!(shape.children().any(|node| node.tag_name().name() == "title"));
        for bar in shape.children().filter(|node| class(node, "bar")) {
            let at = |name: &str| -> f64 { bar.attribute(name).unwrap().parse().unwrap() };
            // All bars are 1 m, and the anchors 2 m = 170 px apart.
            let length = (at("x2") - at("x1")).hypot(at("y2") - at("y1"));
            assert!((length - 85.0).abs() < 0.02, "{length}");
        }
    }
    let table = std::fs::read_to_string(&csv).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 1 + 4 * 4);
    assert_eq!((rows[1][0], rows[5][0], rows[16][0]), ("1", "1'", "2'"));
    let energy: f64 = rows[9][1].parse().unwrap();
    assert!((energy / MGL - (E2_MGL - 6.0)).abs() < ROUNDING);
    // Nothing else is left in the folder.
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 2);
}

#[test]
fn a_triangle_has_its_two_positions() {
    // Sides 3, 4 and 5: the joint is (9/5, ±12/5) from the start, in the vertical plane of the
    // anchors.
    let file = chain("triangle", [3.0, 4.0, 0.0], &[(3.0, 2.0), (4.0, 1.0)]);
    let value = json(&[&file], 0);
    assert_eq!(value["census"]["count"], 2);
    assert_eq!(value["census"]["circles"], false);
    assert_eq!(of_chain(&value)["circle_count"], Value::Null);
    // Half of all the weight, 1.5 kg, sits at the joint.
    for (k, height) in [(0, -2.4), (1, 2.4)] {
        let e = &value["equilibria"][k];
        let at_m = &e["joints"][1]["at_m"];
        for (part, wanted) in [1.8 * 0.6, 1.8 * 0.8, height].into_iter().enumerate() {
            close(&at_m[part], wanted);
        }
        close(&e["energy_j"], 1.5 * 9.80665 * height);
        assert_eq!(e["circle"], Value::Null);
    }
    // A manifold of dimension 0 has two points, and no direction in the plane at all.
    assert_eq!(of_chain(&value)["euler_characteristic"], 2);
    assert_eq!(value["equilibria"][1]["stability"]["index_in_space"], 1);
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
/// force; and four equilibria that have merged, where bar 1 hangs as heavily as bar 3 stands. (`keys::census` has their
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
    let output = funicular(&["--case", "five-in-space", "--max-bars", "5"]);
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn bad_input_is_refused_with_its_reason() {
    let single = chain("single", [1.0, 0.0, 0.0], &[(1.0, 1.0)]);
    let short = chain("short", [4.0, 0.0, 0.0], &[(1.0, 1.0); 3]);
    let weightless = chain("weightless", [1.0, 0.0, 0.0], &[(1.0, 0.0); 3]);
    let nowhere = folder("nowhere").join("missing").join("figure.svg");
    let directory = folder("directory");
    let table = [
        (&[single.as_str()][..], "cannot move"),
        (&[short.as_str()], "m are missing"),
        (&[weightless.as_str()], "no bar has mass"),
        (&["no-such-file.toml"], "no-such-file.toml"),
        (&["--case", "no-such-case"], "no case named"),
        (&[], "required"),
        (&["--case", "two-bars", "--max-bars", "0"], "max_bars must be from 1 to 24"),
        (&["--case", "two-bars", "--max-bars", "25"], "max_bars must be from 1 to 24"),
        (&["--case", "two-bars", "--max-bars", "many"], "invalid value"),
        (&["--case", "two-bars", "--threads", "1025"], "up to 1024 is wanted"),
        (&["--case", "two-bars", "--svg", nowhere.to_str().unwrap()], "there is no folder"),
        (&["--case", "two-bars", "--csv", directory.to_str().unwrap()], "it is a folder"),
    ];
    refused(".", &["census"], &table);
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let with = |threads: &str| {
        let mut value = json(&["--case", "five-in-space", "--threads", threads], 0);
        value["census"]["seconds"] = 0.into();
        value["census"]["parts"][0]["chain"]["statistics"]["seconds"] = 0.into();
        for e in value["equilibria"].as_array_mut().unwrap() {
            e["evidence"]["solve_s"] = 0.into();
        }
        value
    };
    assert_eq!(with("1"), with("3"));
}

/// An interruption in the middle of the work leaves no file behind, not even a part of one.
#[cfg(target_os = "linux")]
#[test]
fn an_interruption_leaves_nothing_half_written() {
    // Twenty different bars: minutes of work.
    let bars: Vec<(f64, f64)> =
        (0..20).map(|k| (0.5 + 0.017 * f64::from(k * k % 23), 1.0)).collect();
    let file = chain("long", [4.0, 0.0, 1.0], &bars);
    let out = folder("interrupted");
    let svg = out.join("figure.svg");
    let arguments = ["census", &file, "--max-bars", "20", "--json", "--svg"];
    // A script may have had signals ignored, and its children inherit that.
    let mut child = std::process::Command::new("env");
    child.arg("--default-signal").arg(assert_cmd::cargo::cargo_bin("funicular"));
    child.args(arguments).arg(svg).stdout(std::process::Stdio::null());
    let mut running = Running(child.spawn().unwrap());
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert!(running.0.try_wait().unwrap().is_none(), "still at work");
    running.signal("TERM");
    assert_eq!(running.code(), Some(130));
    assert_eq!(std::fs::read_dir(out).unwrap().count(), 0);
}

/// Thirteen bars close in many ways, whatever way is left to them.
pub fn thirteen_bars(name: &str, span: f64) -> String {
    let bars: Vec<(f64, f64)> =
        (0..13).map(|k| (1.0 + 0.37 * f64::from(k % 5), 1.0 + 0.11 * f64::from(k % 7))).collect();
    chain(name, [span, 0.0, -0.7], &bars)
}
