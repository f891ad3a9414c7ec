//! Drawings of lines: DXF and OBJ.

use std::fmt::Write as _;

use formats::export::{Shape, Target};
use formats::system::{Source, parse_dxf, parse_obj};
use model::system::{Joint, Kind, Member, Support, System};
use model::{Bar, Vector};

use crate::refused;

/// The groups of an entity, one a line: `code value`.
fn groups(text: &str) -> String {
    let mut out = String::new();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let (code, value) = line.split_once(' ').unwrap();
        let _ = write!(out, "  {code}\n{value}\n");
    }
    out
}

/// A drawing in a unit, with entities, each as `code value;code value`.
fn dxf(unit: &str, entities: &[&str]) -> String {
    let entities = entities.join("\n").replace(';', "\n");
    groups(&format!(
        "999 a remark\n0 SECTION\n2 HEADER\n9 $ACADVER\n1 AC1015\n9 $INSUNITS\n70 {unit}\n0 ENDSEC\n\
         0 SECTION\n2 BLOCKS\n0 LINE\n8 cables\n0 ENDSEC\n\
         0 SECTION\n2 ENTITIES\n{entities}\n0 ENDSEC\n0 EOF"
    ))
}

/// A mast of 3 m on a strut, a guy over two corners, and the same drawn once more as a polyline in space.
const ENTITIES: [&str; 7] = [
    "0 LINE;8 Struts;10 0;20 0;30 0;11 0;21 0;31 3000",
    "0 LWPOLYLINE;8 deck;90 3;70 1;38 0;10 0;20 0;10 4000;20 0;42 0.0;10 0;20 2000",
    "0 POLYLINE;8 CABLES 8mm;66 1;70 8;30 0",
    "0 VERTEX;8 0;10 4000;20 0;30 0.001",
    "0 VERTEX;8 0;10 0;20 0;30 3000\n0 VERTEX;8 0;10 0;20 2000;30 0\n0 SEQEND",
    "0 POINT;8 my anchors;10 4000;20 0\n0 POINT;8 my anchors;10 0;20 2000",
    "0 CIRCLE;8 0;10 1;20 1;40 5\n0 POINT;8 0;10 7;20 7\n0 TEXT;8 names;10 0;20 0;30 3000;1 top",
];

fn place(joint: &Joint) -> Vector {
    joint.drawn_m().unwrap()
}

fn ends(system: &System) -> Vec<(usize, usize, Kind)> {
    system.members().iter().map(|member| (member.from, member.to, member.kind)).collect()
}

#[test]
fn lines_of_a_drawing_are_members_by_their_layers() {
    let read = parse_dxf(&dxf("4", &ENTITIES), "drawings/mast.dxf").unwrap();
    let system = &read.system;
    assert_eq!(system.name(), "mast");
    let places: Vec<Vector> = system.joints().iter().map(place).collect();
    assert_eq!(places, [[0.0; 3], [0.0, 0.0, 3.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    let (bar, strut, cable) = (Kind::Bar, Kind::Strut, Kind::Cable);
    let wanted =
        [(0, 1, strut), (0, 2, bar), (2, 3, bar), (3, 0, bar), (2, 1, cable), (1, 3, cable)];
    assert_eq!(ends(system), wanted);
    // 4 and 3 m by Pythagoras; a kilogram a metre.
    let guy = &system.members()[4];
    assert_eq!((guy.body.length_m(), guy.body.mass_kg(), guy.stiffness_n), (5.0, 5.0, None));
    let held = system.joints().iter().map(|joint| joint.support.is_fixed()).collect::<Vec<_>>();
    assert_eq!(held, [false, false, true, true]);
    let names: Vec<_> = system.joints().iter().map(|joint| joint.name.text()).collect();
    assert_eq!(names, ["1", "top", "3", "4"]);
    for says in
        ["drawn in mm", "has 1 kg/m", "not read: 1 CIRCLE, 1 POINT", "6 members between 4 joints"]
    {
        assert!(read.notes.iter().any(|note| note.contains(says)), "{says}: {:?}", read.notes);
    }
    for (unit, metres) in [("0", 1.0), ("1", 0.0254), ("2", 0.3048), ("5", 0.01), ("6", 1.0)] {
        let read = parse_dxf(&dxf(unit, &ENTITIES), "x").unwrap().system;
        let length_m = read.members()[0].body.length_m();
        assert!((length_m - 3000.0 * metres).abs() < 1e-9, "{unit}: {length_m}");
    }
}

/// A triangle drawn on paper, of two lines that meet within a part of 1e-6.
#[test]
fn a_flat_drawing_stands_in_its_plane() {
    for (gap, joints) in [("3.000002", 3), ("3.00002", 4)] {
        let text = dxf(
            "6",
            &[
                "0 LINE;8 0;10 0;20 0;30 7;11 3;21 -4;31 7",
                &format!("0 LINE;8 0;10 {gap};20 -4;30 7;11 6;21 0;31 7"),
                "0 POINT;8 ANCHORS;10 0;20 0\n0 POINT;8 ANCHORS_FREE_Y;10 6;20 0",
            ],
        );
        let read = parse_dxf(&text, "x").unwrap();
        assert_eq!(read.system.joints().len(), joints);
        let middle = &read.system.joints()[1];
        let at_m = [3.0, 0.0, -4.0];
        assert_eq!(middle.near_m, Some(at_m));
        assert_eq!(middle.support, Support::Plane { at_m, normal: [0.0, 1.0, 0.0] });
        let last = read.system.joints().last().unwrap();
        let at_m = [6.0, 0.0, 0.0];
        assert_eq!(last.support, Support::Line { at_m, direction: [0.0, 0.0, 1.0] });
        assert!(read.notes.iter().any(|note| note.contains("its y is up")));
    }
}

/// The error with its help, without its line, and what stands in that line.
fn wrong(from: &str, to: &str) -> [String; 2] {
    let entities = ENTITIES.join("\n");
    assert!(entities.contains(from), "{from}");
    let text = dxf("4", &[&entities.replacen(from, to, 1)]);
    let error = parse_dxf(&text, "x").unwrap_err();
    let line = text.lines().nth(error.line.unwrap() - 1).unwrap().trim().to_owned();
    [error.what.to_string() + error.help.as_deref().unwrap_or_default(), line]
}

#[test]
fn what_is_wrong_in_a_drawing_has_its_line() {
    let (arc, plane) =
        ("an arc of a polyline (group 42)", "a polyline in a plane of its own (groups 210 to 230)");
    let arc = format!("{arc} is not part of a system of bars at rest");
    let plane = format!("{plane} is not understooddraw it in 3D");
    for (from, to, says, line) in [
        (
            "10 4000;20 0\n0 POINT",
            "10 40;20 0\n0 POINT",
            "there is no line that ends at this anchor",
            "0",
        ),
        ("42 0.0", "42 0.5", &arc, "42"),
        ("70 8", "210 1;70 0", &plane, "0"),
        ("0 SEQEND", "", "there is no end of the polyline before it (SEQEND)", "0"),
        ("11 0", "11 nan", "the group 11 must be a finite number, found \"nan\"", "nan"),
        ("11 0", "12 0", "there is no group 11 of a LINE", "0"),
        ("70 1", "70 one", "the group 70 must be a whole number, found \"one\"", "0"),
        ("11 0;21 0;31 3000", "11 4000;21 0", "the line in line 31 is there twice", "0"),
    ] {
        assert_eq!(wrong(from, to), [says, line]);
    }
}

#[test]
fn what_is_no_drawing_is_said() {
    let says = |text: &str| parse_dxf(text, "x").unwrap_err();
    let error = says("AutoCAD Binary DXF\r\n\u{1a}\0");
    assert_eq!(
        (error.to_string(), error.help.is_some()),
        ("x: a binary DXF file is not understood".to_owned(), true)
    );
    assert_eq!(says("").to_string(), "x: there is no end of the drawing (EOF)");
    assert_eq!(
        says("hello\n").to_string(),
        "x:1: a group code must be a whole number, found \"hello\""
    );
    assert_eq!(says("0\n").to_string(), "x:1: there is no value of the group 0");
    assert_eq!(says("8\n0\n").to_string(), "x:1: there is no group 0 of an entity");
    assert_eq!(says(&dxf("6", &[])).to_string(), "x: there is no line that has a length");
    let unit = says(&dxf("20", &ENTITIES));
    assert_eq!(unit.to_string(), "x:14: the unit \"20\" ($INSUNITS) is not understood");
    let none = says(&dxf("4", &ENTITIES[..5]));
    assert_eq!(none.to_string(), "x: there is no anchor");
    assert!(none.help.unwrap().starts_with("mark each anchor by a POINT"));
    // Cut off anywhere, it is another drawing or none.
    let text = dxf("4", &ENTITIES);
    for end in 0..text.trim_end().len() {
        assert!(parse_dxf(&text[..end], "x").is_err(), "{end}");
    }
}

const OBJ: &str = "# a net\nmtllib a.mtl\nv 0 0 0\nv 4 0 0 1 0 0\nv 0 3 0.0\no frame\nl 1 2\nl 2/1 3/2\n\
    v 0 3 2\ng hung cables\nl -1 1 -2\ng anchors\np 1\np 2 -1\ng\np 3\nf 1 2 3\n";

#[test]
fn lines_of_an_obj_file_are_members_by_their_groups() {
    let read = parse_obj(OBJ, "folder/x.obj").unwrap();
    let system = &read.system;
    let (bar, cable) = (Kind::Bar, Kind::Cable);
    assert_eq!(ends(system), [(0, 1, bar), (1, 2, bar), (3, 0, cable), (0, 2, cable)]);
    let places: Vec<Vector> = system.joints().iter().map(place).collect();
    assert_eq!(places, [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 3.0, 2.0]]);
    let held = system.joints().iter().map(|joint| joint.support.is_fixed()).collect::<Vec<_>>();
    assert_eq!((held, system.name()), (vec![true, true, false, true], "x"));
    assert!(read.notes.iter().any(|note| note == "not read: 1 POINT, 1 f"), "{:?}", read.notes);
    refused("obj", OBJ, |text| parse_obj(text, "x"));
    let solid = parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "x").unwrap_err();
    assert_eq!(solid.to_string(), "x: there is no line (`l`) that has a length");
}

/// A mast on a strut with a bar and a cable, all of other lengths, as we draw it.
#[test]
fn our_own_drawing_is_read_again() {
    let places = [[0.0, 0.1, 0.0], [0.25, 0.0, 3.0], [4.0, 1.0, -0.5], [-2.0, 0.5, 0.75]];
    let joints = vec![
        Joint::anchor("foot", places[0]),
        Joint::free("the t\u{f6}p \\U+00E4 \u{1f3aa}").with_mass(2.0),
        Joint::free("A").held_by(Support::Line { at_m: places[2], direction: [0.0, 0.0, 1.0] }),
        Joint::free("B").held_by(Support::Plane { at_m: places[3], normal: [1.0, 0.0, 0.0] }),
    ];
    let body = Bar::homogeneous(9.0, 0.0).unwrap();
    let strut = Member::bar(0, 1, body).of_kind(Kind::Strut);
    let members = vec![strut, Member::cable(1, 2, body), Member::bar(3, 1, body)];
    let system = System::new("mast", 9.0, joints, members).unwrap();
    let (axial_n, reactions_n) = ([0.0; 3], [[0.0; 3]; 4]);
    let shape = Shape {
        system: &system,
        joints_m: &places,
        axial_n: &axial_n,
        reactions_n: &reactions_n,
        used: &[],
        moving: None,
    };
    let text = shape.text(Target::Dxf).unwrap();
    assert!(text.is_ascii());
    let read = Source::Dxf.parse(&text, "mast.dxf").unwrap().system;
    assert_eq!(ends(&read), ends(&system));
    for ((joint, other), at_m) in read.joints().iter().zip(system.joints()).zip(places) {
        assert_eq!((&joint.name, joint.drawn_m()), (&other.name, Some(at_m)));
        assert_eq!(joint.support, other.support);
    }
    // A direction that no name says is not taken for another one.
    let askew = text.replace("supports_free_z", "supports_sliding");
    assert!(
        parse_dxf(&askew, "x")
            .unwrap_err()
            .to_string()
            .contains("a support that slides obliquely (\"supports_sliding\") is not understood")
    );
    let length_m = (0.25_f64 * 0.25 + 0.1 * 0.1 + 9.0).sqrt();
    assert!((read.members()[0].body.length_m() - length_m).abs() < 1e-15);
    // No drawing says over what a rope runs.
    let rope = parse_dxf(&text.replacen("cables", "ropes", 1), "x").unwrap_err();
    assert_eq!((rope.line, text.lines().nth(rope.line.unwrap())), (Some(23), Some("LINE")));
    assert!(
        rope.to_string().ends_with("a rope (\"ropes\"), over whatever it runs, is not understood")
    );
    assert!(rope.help.unwrap().contains("`via`"));
}
