//! `funicular trace` and `funicular basins` as their users meet them.

use crate::run::{first_line, folder, funicular, good, json, refused, says, words};
use serde_json::Value;

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn people_get_a_table() {
    let level = "trace --case three-equal-bars --vary anchors.end_m.z=0 \
                 --vary anchors.end_m.x=0.3..1.5:13";
    let said = good(".", &level.split(' ').collect::<Vec<_>>());
    says(&said, &["fold: two branches", "branch point", "1.2247448713916", "each finds exactly"]);
}

/// Digits shown are digits known: where two curves touch, each has a fold, known to half of the digits.
#[test]
fn of_curves_that_touch_the_digits_that_are_known_are_told() {
    let vary = ["--vary", "anchors.end_m.x=1", "--vary", "anchors.end_m.z=-2.5..-1.4:12"];
    let said = good(".", &[&["trace", "--case", "three-equal-bars"], &vary[..]].concat());
    let words = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("fold: two branches") && words.contains("degenerate at"), "{said}");
    assert!(!said.contains("-2.000000000") && !said.contains("1.999999999"), "{said}");
}

/// At mass 0 there is nothing to weigh.
#[test]
fn a_path_to_no_mass_prints_no_number_that_is_none() {
    let vary = ["trace", "--case", "three-equal-bars", "--vary", "bars.*.mass_kg=0..1:3"];
    let said = good(".", &vary);
    assert!(!said.contains("NaN") && !said.contains("index in space"), "{said}");
}

#[test]
fn a_product_has_a_path_for_each_combination() {
    let out = folder("product");
    let svg = out.join("masses.svg");
    let masses = ["--vary", "bars.2.mass_kg=0.5,2", "--vary", "anchors.end_m.z=-2.5..-1.5:3"];
    let product = [&["trace", "--case", "three-equal-bars"], &masses[..]].concat();
    let files = ["--json", "--svg", svg.to_str().unwrap()];
    let found = json(&funicular(&[&product[..], &files].concat()));
    assert_eq!(found["traces"].as_array().unwrap().len(), 2);
    assert_eq!(found["traces"][1]["points"][0]["values"][0], 2.0);
    assert!(out.join("masses-1.svg").exists() && out.join("masses-2.svg").exists());
    // Each says for which values it is.
    let said = text(&funicular(&product).stdout);
    for mass in ["0.5", "2"] {
        let head =
            format!("bars.2.mass_kg, anchors.end_m.z (bars.2.mass_kg = {mass} kg): 3 points");
        assert!(said.contains(&head), "{head} is not in\n{said}");
    }
}

#[test]
fn where_nothing_is_decided_nothing_is_claimed() {
    let output =
        funicular(&["trace", "--case", "level-odd", "--vary", "gravity_m_s2=1,2,3", "--json"]);
    assert_eq!(output.status.code(), Some(3));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(!json["traces"][0]["checks"]["undecided"].as_array().unwrap().is_empty());
    let output = funicular(&["trace", "--case", "level-odd", "--vary", "gravity_m_s2=1"]);
    assert_eq!(output.status.code(), Some(3));
    let said = text(&output.stdout);
    assert!(said.contains("nothing was decided") && !said.contains("each finds"), "{said}");
}

/// Every column that is written is explained in the help.
#[test]
fn the_columns_are_in_the_help() {
    let csv = folder("columns").join("two.csv");
    let vary = ["--vary", "anchors.end_m.z=-1.5,-1.4", "--csv", csv.to_str().unwrap()];
    good(".", &[&["trace", "--case", "three-equal-bars"], &vary[..]].concat());
    let help = text(&funicular(&["trace", "--help"]).stdout);
    let written = std::fs::read_to_string(csv).unwrap();
    for column in written.lines().next().unwrap().split(',') {
        let bar = |name: &str| name.contains("_2_") || name.contains("_3_");
        let parameter = column.starts_with("anchors.");
        assert!(bar(column) || parameter || help.contains(column), "{column} is not in\n{help}");
    }
}

#[test]
fn errors_point_at_what_is_wrong() {
    let vary = ["trace", "--case", "three-equal-bars", "--vary"];
    let table: [(&[&str], _); 5] = [
        (&["loads=0..1", "--branches=65"], "0..=64"),
        (&["loads=0..1", "--max-points=0"], "1.."),
        (&["bars.2.mas_kg=1,2"], "did you mean `mass_kg`?"),
        (&["bars.9.mass_kg=1,2"], "there is no bar 9"),
        (&["anchors.end_m.z=-9,-8"], "no value of the parameters describes a chain"),
    ];
    refused(".", &vary, &table);
    let output = funicular(&["trace", "--case", "three-equal-bars"]);
    assert_eq!(output.status.code(), Some(2));
    let output = funicular(&["trace", "--case", "thirty-bars", "--vary", "gravity_m_s2=1,2"]);
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr);
    // What would work is named, and no time for what is refused.
    assert!(said.contains("30 bars") && said.contains("funicular study FILE --vary"), "{said}");
    assert!(!said.contains("are expected"), "{said}");
}

/// Before a census is taken: the million points of this would take minutes.
#[test]
fn more_points_than_memory_are_refused_beforehand() {
    let start = std::time::Instant::now();
    let vary = ["trace", "--case", "two-bars", "--vary", "gravity_m_s2=1..2:1000000"];
    let output = funicular(&vary);
    assert_eq!(output.status.code(), Some(2));
    let error = words(&output);
    assert!(error.contains("100000 allowed") && error.contains("--max-points"), "{error}");
    assert!(start.elapsed().as_secs() < 20);
}

/// Twelve bars take a second or so at each point.
#[test]
fn a_long_trace_says_so_before_it_begins() {
    let out = folder("long");
    let text = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [1, 0, -1]\n\n[[bars]]\nlength_m = 1\n\
                mass_kg = 1\ncount = 12\n";
    std::fs::write(out.join("twelve.toml"), text).unwrap();
    let line = first_line(&out, &["trace", "twelve.toml", "--vary", "anchors.end_m.x=1..5:1000"]);
    // 0.3 s for ten bars, 2.1 times as long for each bar more: 1323 s for a thousand points.
    assert!(line.contains("this trace: about 22 minutes of one processor"), "{line}");
}

#[test]
fn basins_are_drawn_for_both_solvers() {
    let out = folder("basins");
    good(
        ".",
        &["basins", "--case", "three-equal-bars", "--size", "24", "--out", out.to_str().unwrap()],
    );
    for solver in ["lagrange", "energy"] {
        for suffix in ["", "-iterations"] {
            let picture =
                std::fs::read_to_string(out.join(format!("{solver}{suffix}.svg"))).unwrap();
            assert!(picture.contains("data:image/png;base64,iVBORw0KGgo"), "{solver}{suffix}");
            assert!(picture.contains("start of bar 1 from the vertical"));
            assert!(roxmltree::Document::parse(&picture).is_ok());
        }
    }
    // A minimiser reaches minima only.
    let energy = std::fs::read_to_string(out.join("energy.svg")).unwrap();
    assert!(energy.contains("minimum") && !energy.contains("no minimum"));
    let lagrange = std::fs::read_to_string(out.join("lagrange.svg")).unwrap();
    assert!(lagrange.contains("no minimum"));
    let to = out.to_str().unwrap();
    let output = funicular(&["basins", "--case", "two-bars", "--bars", "1,3", "--out", to]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("the chain has bars 1 to 2"));
}
