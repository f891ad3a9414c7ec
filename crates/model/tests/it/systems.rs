//! Systems of bars: texts that describe one, and texts that do not, each with its exact error.

use model::Bar;
use model::system::{Joint, Kind, PointLoad, Support};
use model::system_file::{Described, parse, write_network};

use crate::support::{rows, system};

/// A lamp on two strands between level anchors.
const LAMP: &str = "name = \"lamp\"\n\n[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [2, 0, 0] }\n\
P = { mass_kg = 5 }\n\n[[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 0.5\nmass_kg = 1\ncount = 3\n\n\
[[bars]]\nfrom = \"P\"\nto = \"B\"\nlength_m = 1\nmass_kg = 0.5\n";

/// The text must be refused with this message (file, line, column, key, reason).
#[track_caller]
fn check(text: &str, message: &str) {
    let error = parse(text, "f").expect_err(text);
    assert_eq!(error.to_string(), message);
}

/// The lamp with one piece of its text replaced.
fn changed(old: &str, new: &str) -> String {
    assert!(LAMP.contains(old), "{old}");
    LAMP.replacen(old, new, 1)
}

#[test]
fn joints_stand_in_the_order_of_the_file_and_those_of_a_run_behind_them() {
    let lamp = system(LAMP);
    let names: Vec<_> = lamp.joints().iter().map(|joint| joint.name.text()).collect();
    assert_eq!(names, ["A", "B", "P", "A-P.1", "A-P.2"]);
    let ends: Vec<_> = lamp.members().iter().map(|member| (member.from, member.to)).collect();
    assert_eq!(ends, [(0, 3), (3, 4), (4, 2), (2, 1)]);
    assert_eq!(lamp.name(), "lamp");
    assert!((lamp.total_mass_kg() - 8.5).abs() < 1e-14);
    assert!((lamp.total_length_m() - 2.5).abs() < 1e-14);
    assert_eq!(lamp.joints()[2], Joint::free("P").with_mass(5.0));
}

#[test]
fn supports_loads_and_kinds_are_read() {
    let text = "[joints]\nA = { at_m = [0, 0, 0] }\nS = { at_m = [1, 0, 0], free = \"x\", mass_kg = 1 }\n\
        T = { at_m = [1, 1, 0], free = \"xy\" }\nU = { at_m = [2, 0, 0], along = [0, 3, 4] }\n\
        V = { at_m = [0, 2, 0], normal = [0, 0, -2], force_n = [1, 2, 3] }\n\
        [[bars]]\nfrom = \"A\"\nto = \"S\"\nlength_m = 2\nmass_kg = 1\n\
        forces = [{ force_n = [0, 12, 0] }, { force_n = [1, 0, 0], at_m = 0.5 }]\n\
        [[bars]]\nfrom = \"S\"\nto = \"T\"\nlength_m = 2\nmass_kg = 0\nkind = \"cable\"\nstiffness_n = 1e6\n\
        [[bars]]\nfrom = \"T\"\nto = \"U\"\nlength_m = 2\nmass_kg = 0\nkind = \"strut\"\n\
        [[bars]]\nfrom = \"U\"\nto = \"V\"\nlength_m = 2\nmass_kg = 0\n";
    let read = system(text);
    let support = |k: usize| read.joints()[k].support;
    assert_eq!(support(1), Support::Line { at_m: [1.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] });
    assert_eq!(support(2), Support::Plane { at_m: [1.0, 1.0, 0.0], normal: [0.0, 0.0, 1.0] });
    // 3, 4, 5: the classic right triangle.
    assert_eq!(support(3), Support::Line { at_m: [2.0, 0.0, 0.0], direction: [0.0, 0.6, 0.8] });
    assert_eq!(support(4), Support::Plane { at_m: [0.0, 2.0, 0.0], normal: [0.0, 0.0, -1.0] });
    let joint = Joint::free("V").with_force([1.0, 2.0, 3.0]);
    assert_eq!(read.joints()[4], joint.held_by(support(4)));
    let members = read.members();
    assert_eq!(
        members.iter().map(|m| m.kind).collect::<Vec<_>>(),
        [Kind::Bar, Kind::Cable, Kind::Strut, Kind::Bar]
    );
    assert_eq!(members[1].stiffness_n, Some(1e6));
    let load = |at_m, force_n| PointLoad { at_m, force_n, is_spread: false };
    assert_eq!(members[0].loads, [load(1.0, [0.0, 12.0, 0.0]), load(0.5, [1.0, 0.0, 0.0])]);
}

#[test]
fn json_says_the_same() {
    let json = r#"{
        "name": "lamp",
        "joints": {"A": {"at_m": [0, 0, 0]}, "B": {"at_m": [2, 0, 0]}, "P": {"mass_kg": 5}},
        "bars": [
            {"from": "A", "to": "P", "length_m": 0.5, "mass_kg": 1, "count": 3},
            {"from": "P", "to": "B", "length_m": 1, "mass_kg": 0.5}
        ]
    }"#;
    assert_eq!(system(json), system(LAMP));
    let wrong = json.replace("\"mass_kg\": 5", "\"mass\": 5");
    check(&wrong, "f:3:78: joints.P.mass: unknown key `mass`");
    check("{\"joints\": }", "f:1:12: not valid JSON: expected value");
}

#[test]
fn a_chain_gains_loads_at_its_joints() {
    let chain = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [2, 0, 0]\n[[bars]]\nlength_m = 0.5\nmass_kg = 1\n\
        count = 6\n";
    let loaded = |rest: &str| format!("{chain}[[loads]]\n{rest}");
    let read =
        system(&loaded("joint = 3\nmass_kg = 5\n[[loads]]\njoint = 3\nforce_n = [0, 1, 0]\n"));
    assert_eq!(read.joints()[3], Joint::free("3").with_mass(5.0).with_force([0.0, 1.0, 0.0]));
    assert_eq!(read.joints()[6].support, Support::Fixed { at_m: [2.0, 0.0, 0.0] });
    assert!(matches!(parse(chain, "f"), Ok(Described::Chain(_))));
    check(
        &loaded("joint = 6\nmass_kg = 5\n"),
        "f:9:9: loads[1].joint: joint \"6\" is an anchor: a load there goes straight into the ground",
    );
    check(
        &loaded("joint = 7\nmass_kg = 5\n"),
        "f:9:9: loads[1].joint: the value 7 is out of range",
    );
    check(&loaded("joint = 1\n"), "f:9:9: loads[1].joint: a load needs mass_kg or force_n");
    check(
        &loaded("joint = 1\nmass_kg = -1\n"),
        "f:10:11: loads[1].mass_kg: a mass must be zero or positive, and finite, got -1 kg",
    );
    check(
        &loaded("joint = 1\nforce_n = [0, nan, 0]\n"),
        "f:10:15: loads[1].force_n[2]: a force must be finite, got NaN N",
    );
}

#[test]
fn mistakes_are_told_where_they_stand() {
    for [old, new, message] in rows("lamp") {
        check(&changed(&old, &new), &message);
    }
}

#[test]
fn systems_without_an_answer_are_refused_with_their_numbers() {
    check(
        &changed("P = {", "Q = { mass_kg = 1 }\nR = { mass_kg = 1 }\nP = {").replace(
            "[[bars]]\nfrom = \"P\"",
            "[[bars]]\nfrom = \"Q\"\nto = \"R\"\nlength_m = 1\nmass_kg = 1\n[[bars]]\nfrom = \"P\"",
        ),
        "f:6:5: joints.Q: nothing holds joint \"Q\" and the joint connected with it: this part falls",
    );
    let light = LAMP.replace("mass_kg = 5", "mass_kg = 0").replace("mass_kg = 1", "mass_kg = 0");
    check(
        &light.replace("mass_kg = 0.5", "mass_kg = 0"),
        "f:3:1: joints: no mass and no force act on the system: without load every position is an \
         equilibrium",
    );
}

#[test]
fn systems_read_back_as_they_were() {
    let text = LAMP.replace(
        "P = { mass_kg = 5 }",
        "P = { mass_kg = 5, force_n = [0.1, 0, -0.3] }\n\
        \"a \\\"b\\\".c\" = { at_m = [1, 1, 1], along = [1, 2, 3] }\n\
        Q = { at_m = [1, 0.1, 1], normal = [1, -7, 3], mass_kg = 1e-3 }",
    ) + "[[bars]]\nfrom = \"P\"\nto = \"a \\\"b\\\".c\"\nlength_m = 1.1\nmass_kg = 0.1\ncentre_m = 0.3\n\
           stiffness_n = 123.4\n[[bars]]\nfrom = \"Q\"\nto = \"B\"\nlength_m = 2.1\nmass_kg = 0.1\n\
           kind = \"cable\"\nforces = [{ force_n = [1, 2, 3] }]\n";
    let first = system(&text);
    let again = system(&write_network(&first));
    assert_eq!(again, first);
}

/// A strand that hangs from a wall, with these keys more.
fn strand(keys: &str) -> String {
    format!(
        "[joints]\nA = {{ at_m = [0, 0, 0] }}\nP = {{}}\n\n[[bars]]\nfrom = \"A\"\nto = \"P\"\n\
         length_m = 5\nmass_kg = 3\n{keys}\n"
    )
}

#[test]
fn a_prestress_gives_the_unstretched_length() {
    // Under a quarter of EA a member is a quarter longer, under minus a half half as long.
    let text = strand(
        "stiffness_n = 1e3\nprestress_n = 250\ncentre_m = 2\nforces = [{ force_n = [0, 1, 0] }]",
    );
    let read = system(&text);
    let member = &read.members()[0];
    assert_eq!(member.body, Bar::new(4.0, 3.0, 1.6, Bar::slender_inertia(4.0, 3.0)).unwrap());
    assert_eq!(member.loads, [PointLoad { at_m: 2.0, force_n: [0.0, 1.0, 0.0], is_spread: false }]);
    assert_eq!(member.stiffness_n, Some(1e3));
    let pressed =
        system(&strand("kind = \"strut\"\nstiffness_n = 1e3\nprestress_n = -500\ncount = 2"));
    assert_eq!(pressed.members()[1].body, Bar::homogeneous(10.0, 3.0).unwrap());
    // Moments that are given go with the square of the length, that about the bar stays.
    let moments =
        system(&strand("stiffness_n = 1e3\nprestress_n = 250\ninertia_kg_m2 = [7, 25, 50]"));
    let shorter = Bar::new(4.0, 3.0, 2.0, [7.0, 16.0, 32.0]).unwrap();
    assert_eq!(moments.members()[0].body, shorter);
    // What is written are the numbers given, also such as are the defaults.
    let given = "length_m = 5.0\nmass_kg = 3.0\ncentre_m = 2.5\ninertia_kg_m2 = [0.0, 6.25, 6.25]\n\
                 stiffness_n = 0.3\nprestress_n = 0.1\nforces = [{ force_n = [0.0, 1.0, 0.0], at_m = 4.9 }]\n";
    let awkward = system(&strand(given.split_once("mass_kg = 3.0\n").unwrap().1));
    assert!(write_network(&awkward).ends_with(given), "{}", write_network(&awkward));
    for prestressed in [read, pressed, moments, awkward] {
        assert_eq!(system(&write_network(&prestressed)), prestressed);
    }
}

#[test]
fn a_prestress_that_contradicts_the_member_is_refused() {
    for [keys, message] in rows("strand") {
        check(&strand(&keys), &message);
    }
    let error = parse(&strand("prestress_n = \"1\"\nstiffness_n = 9"), "f").unwrap_err();
    assert!(error.to_string().contains("expected a number"), "{error}");
}

#[test]
fn prestressed_systems_need_no_load() {
    let text = "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [1, 0, 0] }\nP = {}\n\
        [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 0.4\nmass_kg = 0\nstiffness_n = 1e4\nprestress_n = 100\n\
        [[bars]]\nfrom = \"P\"\nto = \"B\"\nlength_m = 0.6\nmass_kg = 0\nstiffness_n = 1e4\nprestress_n = 100\n";
    assert!(system(text).is_unloaded());
    let rigid = text.replace("stiffness_n = 1e4\nprestress_n = 100\n", "");
    let error = parse(&rigid, "f").unwrap_err();
    assert!(error.to_string().contains("no mass and no force"), "{error}");
}

/// A slider on a level line bears its weight there; any force along the line makes a problem of it.
#[test]
fn what_slides_needs_a_load_along_its_way() {
    let slack = |load: &str, free: &str| {
        format!(
            "joints = {{ A = {{ at_m = [0, 0, 0] }}, S = {{ at_m = [2, 0, 0], free = \"{free}\", {load} }} }}\n\
             bars = [{{ from = \"A\", to = \"S\", length_m = 3, mass_kg = 1, kind = \"cable\" }}]"
        )
    };
    for (load, free) in [
        ("mass_kg = 1", "x"),
        ("mass_kg = 1", "xy"),
        ("force_n = [0, 2, 0]", "x"),
        ("force_n = [0, 2, 0]", "xz"),
    ] {
        let refused = parse(&slack(load, free), "f").map(|_| ()).map_err(|error| error.to_string());
        let weighs = free == "xz";
        assert_eq!(refused.is_ok(), weighs, "{load} {free} {refused:?}");
        assert!(weighs || refused.unwrap_err().contains("rest on its supports"));
    }
    assert!(parse(&slack("force_n = [0, 2, 0]", "xy"), "f").is_ok());
}

#[test]
fn a_floor_is_read_and_written() {
    let text = format!("floor_m = -2.5\n{LAMP}");
    let lamp = system(&text);
    assert_eq!(lamp.floor_m(), Some(-2.5));
    assert_eq!(system(&write_network(&lamp)), lamp);
    assert_eq!(system(LAMP).floor_m(), None);
    // A chain above a floor is a system.
    let chain = "floor_m = -1\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
        bars = [{ length_m = 1, mass_kg = 1, count = 4 }]\n";
    assert_eq!(system(chain).floor_m(), Some(-1.0));
}

#[test]
fn floors_above_a_support_and_heights_that_are_none_are_refused() {
    let flat = changed("P = { mass_kg = 5 }", "P = { at_m = [1, 0, -1], free = \"xy\" }");
    check(
        &format!("floor_m = -0.5\n{flat}"),
        "f:7:5: joints.P: joint \"P\" is held at the height -1 m, below the floor at -0.5 m",
    );
    let rises = flat.replace("free = \"xy\"", "free = \"z\"");
    assert_eq!(system(&format!("floor_m = -0.5\n{rises}")).floor_m(), Some(-0.5));
    let chain = "floor_m = 1\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
        bars = [{ length_m = 1, mass_kg = 1, count = 4 }]\n";
    check(chain, "f:1:11: floor_m: joint \"0\" is held at the height 0 m, below the floor at 1 m");
}

/// Beside a bar of the same mass by another key: with another length it would have another mass.
#[test]
fn a_mass_a_metre_is_one_beside_a_bar_as_heavy() {
    let strands = "from = \"A\"\nto = \"P\"\nlength_m = 0.5\nmass_kg = 1\ncount = 3";
    let by_metre = "from = \"A\"\nto = \"P\"\nlength_m = 1\nmass_kg_per_m = 0.5";
    let lamp = system(&changed(strands, by_metre).replace("[2, 0, 0]", "[1, 0, 0]"));
    assert_eq!(lamp.members()[0].body, lamp.members()[1].body);
    let given: Vec<bool> = lamp.members().iter().map(|member| member.by_length.mass).collect();
    assert_eq!(given, [true, false]);
}
