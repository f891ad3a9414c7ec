//! What drawings of CAD programs have besides lines: layers that are off, blocks, code pages, texts beside their joints.

use std::fmt::Write as _;

use formats::FormatError;
use formats::system::{ForeignSystem, Source};
use model::system::Joint;

/// Legs of 5 and 13 m from a top to two anchors.
const LEGS: &str = "0 LINE;8 bars;10 0;20 0;30 0;11 3;21 0;31 4;0 LINE;8 bars;10 3;20 0;30 4;11 3;21 12;31 -1;\
     0 POINT;8 anchors;10 0;20 0;30 0;0 POINT;8 anchors;10 3;20 12;30 -1;";

/// The groups of a drawing, each `code value`.
fn dxf(tables: &str, blocks: &str, entities: &str) -> String {
    let all = format!(
        "0 SECTION;2 TABLES;{tables}0 ENDSEC;0 SECTION;2 BLOCKS;{blocks}0 ENDSEC;\
         0 SECTION;2 ENTITIES;{LEGS}{entities}0 ENDSEC;0 EOF"
    );
    all.split(';').map(|group| group.replacen(' ', "\n", 1) + "\n").collect()
}

fn read(text: &str) -> Result<ForeignSystem, FormatError> {
    Source::Dxf.parse(text, "x")
}

/// The number of members, and the note of what is not read.
fn members(text: &str) -> (usize, String) {
    let read = read(text).unwrap();
    let skipped = read.notes.iter().find(|note| note.starts_with("not read")).cloned();
    (read.system.members().len(), skipped.unwrap_or_default())
}

fn names(text: &str) -> (Vec<String>, Vec<String>) {
    let read = read(text).unwrap();
    let names = read.system.joints().iter().map(|joint| joint.name.to_string()).collect();
    (names, read.notes)
}

/// A name at a place.
fn named(name: &str, [x, y, z]: [f64; 3]) -> String {
    format!("0 TEXT;8 names;10 {x};20 {y};30 {z};40 0.2;1 {name};")
}

#[test]
fn what_is_not_seen_is_no_member() {
    let tables = "0 TABLE;2 LAYER;0 LAYER;2 Cold;70 1;62 7;0 LAYER;2 off;70 64;62 -7;0 LAYER;2 on;70 4;62 3;";
    let line = |groups: &str| format!("0 LINE;{groups};10 0;20 0;30 0;11 3;21 12;31 -1;");
    for (groups, said) in [
        ("8 on", ""),
        ("8 on;60 0", ""),
        ("8 COLD", "not read: 1 LINE on layers that are off"),
        ("8 off", "not read: 1 LINE on layers that are off"),
        ("8 on;60 1", "not read: 1 LINE invisible"),
        ("8 on;67 1", "not read: 1 LINE on paper"),
    ] {
        let wanted = if said.is_empty() { 3 } else { 2 };
        assert_eq!(members(&dxf(tables, "", &line(groups))), (wanted, said.to_owned()), "{groups}");
    }
    // Its arcs do not matter, nor do anchors without a line.
    let way = "0 POLYLINE;8 off;66 1;70 8;0 VERTEX;8 off;10 0;20 0;30 0;42 1;0 VERTEX;8 off;10 3;20 12;30 -1;\
               0 SEQEND;0 POINT;8 anchors;60 1;10 9;20 9;";
    let said = "not read: 1 POINT invisible, 1 POLYLINE on layers that are off".to_owned();
    assert_eq!(members(&dxf(tables, "", way)), (2, said));
}

#[test]
fn blocks_with_lines_are_refused() {
    let blocks = "0 BLOCK;8 0;2 tri;70 0;0 LINE;8 0;10 0;20 0;11 1;21 1;0 ENDBLK;8 0;\
                  0 BLOCK;2 outer;0 INSERT;2 inner;0 ENDBLK;0 BLOCK;2 inner;0 INSERT;2 tri;0 ENDBLK;\
                  0 BLOCK;2 far;70 4;1 other.dwg;0 ENDBLK;\
                  0 BLOCK;2 sheet;0 INSERT;2 title;0 ENDBLK;0 BLOCK;2 title;0 TEXT;1 a;0 ENDBLK;";
    let insert = |name: &str| dxf("", blocks, &format!("0 INSERT;8 bars;2 {name};10 0;20 0;"));
    for name in ["title", "sheet"] {
        assert_eq!(members(&insert(name)), (2, "not read: 1 INSERT".to_owned()));
    }
    for name in ["tri", "inner", "outer", "far", "nowhere"] {
        let text = insert(name);
        let error = read(&text).unwrap_err();
        assert_eq!(error.what.to_string(), format!("the block {name:?} is not understood"));
        assert_eq!(text.lines().nth(error.line.unwrap()), Some("INSERT"));
        assert!(error.help.unwrap().ends_with("explode the blocks"));
    }
}

/// Half of the shorter leg is 2.5 m.
#[test]
fn a_name_is_that_of_the_nearest_joint() {
    let top = [3.0, 0.0, 4.0];
    let near = |z: f64| named("Top", [3.0, 0.0, 4.0 + z]);
    let left = "1 names are not next to a joint without a name: left out";
    for (entities, wanted, all) in [
        (near(2.49), "Top", true),
        (near(2.51), "2", false),
        (near(0.1) + &named("Other", [3.0, -0.05, 4.0]), "Other", false),
        (near(0.1) + &named("Other", [3.0, 11.0, -1.0]), "Top", true),
        (named("first", top) + &named("second", top), "first", false),
    ] {
        let (names, notes) = names(&dxf("", "", &entities));
        assert_eq!(names[1], wanted, "{entities}");
        assert_eq!(notes.iter().all(|note| note != left), all, "{notes:?}");
    }
}

/// 24 joints in a row that bends, each with a name beside it in another direction.
#[test]
fn the_nearest_of_many_joints() {
    let place = |k: i32| [f64::from(k), f64::from(k % 4), f64::from(k % 3)];
    let mut entities = String::new();
    let mut last = [0.0; 3];
    for k in 1..24 {
        let [x, y, z] = place(k);
        let [a, b, c] = last;
        let _ = write!(entities, "0 LINE;8 0;10 {a};20 {b};30 {c};11 {x};21 {y};31 {z};");
        last = [x, y, z];
        entities += &named(&format!("n{k}"), [x - 0.2, y + 0.1 * f64::from(k % 5), z - 0.3]);
    }
    let text = dxf("", "", &entities);
    let read = read(&text).unwrap().system;
    for k in 1..24 {
        let found = read.joints().iter().find(|joint| joint.name == format!("n{k}"));
        assert_eq!(found.and_then(Joint::drawn_m), Some(place(k)), "{k}");
    }
}

#[test]
fn letters_of_old_drawings() {
    let text = |name: &str, head: &str| {
        let text = dxf("", "", &named(name, [3.0, 0.0, 4.0]));
        format!("0\nSECTION\n2\nHEADER\n{head}0\nENDSEC\n{text}").into_bytes()
    };
    let page = |name: &str| format!("9\n$DWGCODEPAGE\n  3\n{name}\n");
    let bytes = |head: &str| {
        let mut bytes = text("?1#", head);
        let at = bytes.iter().position(|byte| *byte == b'?').unwrap();
        (bytes[at], bytes[at + 2]) = (0xe4, 0x80);
        bytes
    };
    let top = |bytes: Vec<u8>| names(&Source::text("DXF", bytes).unwrap()).0[1].clone();
    assert_eq!(top(bytes("")), "\u{e4}1\u{20ac}");
    assert_eq!(top(bytes(&page("ansi_1252"))), "\u{e4}1\u{20ac}");
    assert_eq!(top(bytes(&page("ANSI_1251"))), "\u{fffd}1\u{fffd}");
    assert_eq!(top(text("\u{e4}", &page("ANSI_1252"))), "\u{e4}");
    for (written, wanted) in [
        ("Spitze \\U+00E4", "Spitze \u{e4}"),
        ("\\U+00e4\\U+D83C\\U+DFAAb", "\u{e4}\u{1f3aa}b"),
        ("a\\U+00Eg\\U+", "a\\U+00Eg\\U+"),
        ("\\U+00\u{e4}\u{e4}", "\\U+00\u{e4}\u{e4}"),
    ] {
        assert_eq!(top(text(written, "")), wanted);
    }
    assert!(Source::text("obj", vec![0xe4]).is_err());
}

#[test]
fn an_anchor_is_held_in_one_way() {
    let twice = |layer: &str| dxf("", "", &format!("0 POINT;8 {layer};10 0;20 0;30 0;"));
    assert!(read(&twice("supports")).is_ok());
    let text = twice("supports_free_x");
    let error = read(&text).unwrap_err();
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| *line == "POINT").unwrap();
    let says = format!("the anchor in line {first}, held in another way, is there twice");
    assert_eq!(error.what.to_string(), says);
    assert_eq!(error.line.map(|line| line > first && lines[line] == "POINT"), Some(true));
}

#[test]
fn a_drawing_without_a_unit_is_read_in_m() {
    let head = |unit: &str| format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n");
    let body = dxf("", "", "");
    for (head, says) in [
        (String::new(), "drawn in no unit: read in m"),
        (head("0"), "drawn in no unit: read in m"),
        (head("6"), "drawn in m"),
    ] {
        let read = read(&(head + &body)).unwrap();
        assert!(read.notes.iter().any(|note| note == says), "{:?}", read.notes);
        assert!((read.system.members()[1].body.length_m() - 13.0).abs() < 1e-15);
    }
}
