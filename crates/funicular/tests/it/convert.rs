//! `funicular convert`: files that other programs, and this one, read.

use funicular::Problem;
use funicular::prelude::System;

use crate::run::{good, holding, refused, run};

/// A lamp of 40 N on two elastic cables of 2.5 and 3.2 m, stretched to the triangle 3, 4, 5: 32 and 24 N.
const LAMP: &str = "name = \"lamp\"\ngravity_m_s2 = 10\n\
    joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [5, 0, 0] }, P = { mass_kg = 4 } }\n\
    bars = [{ from = \"A\", to = \"P\", length_m = 2.5, mass_kg = 0, kind = \"cable\", stiffness_n = 160 },\n\
    { from = \"P\", to = \"B\", length_m = 3.2, mass_kg = 0, kind = \"cable\", stiffness_n = 96 }]\n";

#[test]
fn what_is_written_is_read_again() {
    let folder = holding([("lamp.toml", LAMP)]);
    for (file, what) in [
        ("lamp.vtu", "an unstructured grid for ParaView"),
        ("lamp.dxf", "a drawing for CAD"),
        ("lamp.obj", "solids for 3D programs"),
        ("lamp.GLTF", "solids for 3D programs"),
        ("lamp.xml", "a model for MuJoCo"),
        ("lamp.txt", "an input file of MoorDyn"),
        ("lamp.json", "a graph for COMPAS"),
        ("lamp.csv", "a table of joints"),
    ] {
        let (code, text, said) = run(&folder, &["convert", "lamp.toml", "--to", file]);
        assert_eq!((code, text), (Some(0), format!("{file}: {what}; agreed\n")), "{said}");
        assert!(folder.path().join(file).metadata().unwrap().len() > 200);
    }
    // Both answers, and no forces.
    let table = std::fs::read_to_string(folder.path().join("lamp.csv")).unwrap();
    assert!(
        table.starts_with("solver,joint,x_m,y_m,z_m,") && table.lines().count() == 7,
        "{table}"
    );
    good(&folder, &["judge", "lamp.toml", "--answer", "lamp.vtu"]);
    for file in ["lamp.txt", "lamp.json"] {
        let text = good(&folder, &["solve", file, "--json"]);
        let answer: serde_json::Value = serde_json::from_str(&text).unwrap();
        let place = |k: usize| answer["equilibria"][0]["joints"][2]["at_m"][k].as_f64().unwrap();
        assert!((place(0) - 1.8).hypot(place(2) + 2.4) < 1e-9, "{file}: {text}");
    }
}

#[test]
fn what_cannot_be_written_leaves_no_file() {
    let folder = holding([("lamp.toml", LAMP)]);
    let table = [
        (&["lamp.toml", "--to", "lamp.step"][..], "there are .vtu, .dxf"),
        (&["lamp.toml", "--to", "lamp"], "no format has the ending of lamp"),
        (&["lamp.toml", "--to", "lamp.toml"], "it is lamp.toml, which is read"),
        (&["--case", "lamp", "--to", "out.txt"], "MoorDyn has no line that does not stretch"),
        (&["--case", "pratt-truss", "--to", "out.json"], "graph has no support that slides"),
        (&["lamp.toml"], "--to"),
    ];
    refused(&folder, &["convert"], &table);
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
    assert_eq!(std::fs::read_to_string(folder.path().join("lamp.toml")).unwrap(), LAMP);
}

/// A rope from A over W to P and one from A over P to W, both through the span from W to P; the second stays slack: the
/// first bears W where both its spans lean alike, by 3-4-5 with 8 m and 4.8 m of level distance.
const CROSSED: &str = "name = \"crossed\"\ngravity_m_s2 = 10\n\
    joints = { A = { at_m = [0, 0, 0] }, P = { at_m = [4.8, 0, 0] }, W = { mass_kg = 16 } }\n\
    bars = [{ from = \"A\", via = [\"W\"], to = \"P\", length_m = 8, kind = \"cable\", strength_n = 437.5, safety = 3 },\n\
    { from = \"A\", via = [\"P\"], to = \"W\", length_m = 9, kind = \"cable\" }]\n";

/// Forces of ropes that share their joints are told apart in every file that is read again, and in any order of its
/// lines where these are numbered.
#[test]
fn ropes_that_share_their_joints_are_read_again() {
    let folder = holding([("crossed.toml", CROSSED)]);
    let (code, ..) = run(&folder, &["convert", "crossed.toml", "--to", "crossed.vtu"]);
    assert_eq!(code, Some(0));
    let solve =
        ["solve", "crossed.toml", "--json", "--csv", "joints.csv", "--bars-csv", "bars.csv"];
    let text = good(&folder, &solve);
    std::fs::write(folder.path().join("crossed.json"), text).unwrap();
    let text = good(&folder, &["solve", "crossed.toml", "--json", "--columns"]);
    std::fs::write(folder.path().join("columns.json"), text).unwrap();
    let bars = std::fs::read_to_string(folder.path().join("bars.csv")).unwrap();
    let mut turned: Vec<_> = bars.lines().collect();
    turned[1..].reverse();
    std::fs::write(folder.path().join("turned.csv"), turned.join("\n")).unwrap();
    for answer in [
        &["crossed.vtu"][..],
        &["crossed.json"],
        &["columns.json"],
        &["joints.csv", "--members", "bars.csv"],
        &["joints.csv", "--members", "turned.csv"],
    ] {
        let judge = [&["judge", "crossed.toml", "--check", "--answer"], answer].concat();
        let text = good(&folder, &judge);
        // 160 N between two spans that lean by 3-4-5: 100 N.
        let line =
            "Weakest: member from A to P, at 22.9 % of its strength: safety 4.37, 3 required.\n";
        assert!(
            text.contains("The forces are those of the answer.") && text.contains(line),
            "{text}"
        );
    }
    // One edge bears both ropes in a graph, and MoorDyn knows no ropes.
    let table = [(&["crossed.json"][..], "two edges"), (&["crossed.txt"], "does not stretch")];
    refused(&folder, &["convert", "crossed.toml", "--to"], &table);
}

/// Drawn, read as a drawing, and written as a system file: the same system each time.
#[test]
fn a_drawing_is_a_system_to_be_edited() {
    let folder = tempfile::tempdir().unwrap();
    for case in ["pratt-truss", "geiger-dome"] {
        let convert = ["convert", "--case", case, "--to", "drawn.dxf"];
        assert_eq!(run(&folder, &convert).0, Some(0));
        let (code, text, said) = run(&folder, &["convert", "drawn.dxf", "--to", "drawn.toml"]);
        assert_eq!((code, text.as_str()), (Some(0), "drawn.toml: a system file\n"), "{said}");
        assert!(said.contains("note: a drawing has no masses: each member has 1 kg/m"), "{said}");
        let read = |file: &str| Problem::read(folder.path().join(file)).unwrap();
        let (drawn, again) = (read("drawn.dxf"), read("drawn.toml"));
        assert_eq!(drawn, again);
        let (drawn, first) = (drawn.system(), Problem::case(case).unwrap().system());
        let ends = |system: &System| -> Vec<_> {
            system
                .members()
                .iter()
                .map(|m| (m.kind, system.joints()[m.from].name.to_string()))
                .collect()
        };
        assert_eq!(ends(&drawn), ends(&first));
    }
    assert_eq!(run(&folder, &["convert", "--case", "tackle", "--to", "rope.dxf"]).0, Some(0));
    let told = "a rope (\"ropes\"), over whatever it runs, is not understood";
    refused(&folder, &["solve"], &[(&["rope.dxf"], told)]);
    let all = model::cases::all().iter().map(|case| case.name);
    for name in all.chain(model::cases::exhibits().map(|exhibit| exhibit.name)) {
        let problem = Problem::case(name).unwrap();
        assert_eq!(Problem::parse(&problem.to_toml(), "again.toml").unwrap(), problem, "{name}");
    }
}

/// Two cables, 3 and 4 m long between anchors 5 m apart, of 1 kg/m: half of both weighs on the joint where they meet at
/// a right angle, 0.8 of it along the first, which is steeper, and 0.6 along the second.
const DRAWN: &str = "v 0 0 0\nv 5 0 0\nv 1.8 0 -2.4\ng cables\nl 1 3 2\ng anchors\np 1 2\n";

#[test]
fn every_command_takes_a_drawing() {
    let folder = holding([("lamp.obj", DRAWN)]);
    let text = good(&folder, &["solve", "lamp.obj", "--json"]);
    std::fs::write(folder.path().join("lamp.json"), &text).unwrap();
    let answer: serde_json::Value = serde_json::from_str(&text).unwrap();
    let weight_n = 3.5 * model::STANDARD_GRAVITY_M_S2;
    for (bar, share) in [(0, 0.8), (1, 0.6)] {
        let axial_n = answer["equilibria"][0]["bars"][bar]["axial_n"].as_f64().unwrap();
        assert!((axial_n - share * weight_n).abs() < 1e-9 * weight_n, "{axial_n}");
    }
    for arguments in [
        &["judge", "lamp.obj", "--answer", "lamp.json"][..],
        &["modes", "lamp.obj"],
        &["census", "lamp.obj"],
        &["page", "lamp.obj", "--out", "lamp.html"],
        &["study", "lamp.obj", "--vary", "gravity_m_s2=5,10"],
        &["simulate", "lamp.obj", "--time", "0.01"],
    ] {
        let (code, text, said) = run(&folder, arguments);
        assert_eq!(code, Some(0), "{arguments:?}: {text}{said}");
        assert!(text.contains("1 kg/m") || said.contains("1 kg/m"), "{arguments:?}: {text}{said}");
        assert!(said.lines().all(|line| line.chars().count() <= 80), "{said}");
    }
    std::fs::write(folder.path().join("none.obj"), DRAWN.replace("g anchors", "g dots")).unwrap();
    let none =
        ["there is no anchor", "help: mark each anchor"].map(|told| (&["none.obj"][..], told));
    refused(&folder, &["solve"], &none);
}

/// A graph for COMPAS has no floor: its push would be left over at the joint.
#[test]
fn what_a_floor_pushes_is_no_graph_for_compas() {
    let system = "floor_m = -1\n[joints]\nA = { at_m = [0, 0, 0] }\nP = { mass_kg = 2 }\n[[bars]]\nfrom = \"A\"\n\
                  to = \"P\"\nlength_m = 3\nmass_kg = 0\nkind = \"cable\"\n";
    let folder = holding([("low.toml", system)]);
    let convert = ["convert", "low.toml", "--to", "low.json"];
    refused(&folder, &convert, &[(&[], "has no floor that pushes (joint \"P\")")]);
    assert!(!folder.path().join("low.json").exists());
}
