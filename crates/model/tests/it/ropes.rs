//! Ropes over rings and pulleys: read, written, and refused where they are none.

use model::Bar;
use model::system::{Joint, Member, System, SystemError, SystemRefusal};
use model::system_file::{Described, parse, write_network};

/// A ring on a rope between two anchors, with more keys of the rope.
fn ring(more: &str) -> String {
    format!(
        "[joints]\nA = {{ at_m = [0, 0, 0] }}\nB = {{ at_m = [4, 0, 1] }}\nP = {{ mass_kg = 10 }}\n\
         [[bars]]\nfrom = \"A\"\nto = \"B\"\n{more}\n"
    )
}

const VIA: &str = "via = [\"P\"]\nkind = \"cable\"";

fn read(text: &str) -> System {
    let Described::System(system) = parse(text, "f").unwrap() else { panic!("a chain") };
    system
}

#[test]
fn a_rope_needs_no_mass_and_reads_back() {
    let system = read(&ring(&format!("{VIA}\nlength_m = 5\nstiffness_n = 1e4\nstrength_n = 500")));
    let rope = &system.members()[0];
    assert_eq!((rope.from, rope.via(), rope.to), (0, &[2][..], 1));
    assert!(rope.body.mass_kg() <= 0.0 && system.has_ropes());
    assert_eq!(read(&write_network(&system)), system);
    assert_eq!(system.first_rope(), Some(0));
    assert!(system.as_row().is_none());
}

#[test]
fn drawn_ropes_have_the_length_of_their_spans() {
    let drawn = ring(VIA).replace("{ mass_kg", "{ near_m = [0, 3, 4], mass_kg");
    let rope = read(&drawn).members()[0].clone();
    assert!((rope.body.length_m() - 5.0 - f64::sqrt(16.0 + 9.0 + 9.0)).abs() < 1e-15);
}

#[test]
fn what_is_no_rope_is_refused_where_it_stands() {
    for (more, wanted) in [
        ("via = [\"Q\"]", "f:8:8: bars[1].via: there is no joint \"Q\""),
        (
            "via = \"P\"",
            "f:8:7: bars[1].via: expected one or more names of joints, such as [\"P\"], found a string",
        ),
        (
            "via = []",
            "f:8:7: bars[1].via: expected one or more names of joints, such as [\"P\"], found an array",
        ),
        (
            "via = [3]",
            "f:8:8: bars[1].via: expected one or more names of joints, such as [\"P\"], found an integer",
        ),
        (
            "via = [\"P\"]\ncount = 2",
            "f:9:9: bars[1].count: `count` and `via` cannot stand together",
        ),
        (
            "via = [\"P\", \"P\"]\nkind = \"cable\"",
            "f:8:7: bars[1].via: a rope runs from joint \"P\" to itself: a span has two joints",
        ),
        (
            "via = [\"P\"]",
            "f:5:1: bars[1].kind: only a cable runs over rings or pulleys: a bar or a strut cannot bend around a joint",
        ),
        (
            "via = [\"P\"]\nkind = \"strut\"",
            "f:9:8: bars[1].kind: only a cable runs over rings or pulleys: a bar or a strut cannot bend around a joint",
        ),
        (
            "via = [\"P\"]\nkind = \"cable\"\nmass_kg = 1",
            "f:10:11: bars[1].mass_kg: a rope over rings or pulleys has no mass here: its weight would slide with the rope",
        ),
        (
            "via = [\"P\"]\nkind = \"cable\"\ncentre_m = 1",
            "f:10:12: bars[1].centre_m: a rope over rings or pulleys has no mass here, and so no centre_m",
        ),
        (
            "via = [\"P\"]\nkind = \"cable\"\ninertia_kg_m2 = [0, 1, 1]",
            "f:10:17: bars[1].inertia_kg_m2: a rope over rings or pulleys has no mass here, and so no inertia_kg_m2",
        ),
        (
            "via = [\"P\"]\nkind = \"cable\"\nforces = [{ force_n = [0, 1, 0] }]",
            "f:10:10: bars[1].forces: no force acts on a rope over rings or pulleys: it would slide with the rope",
        ),
        (
            "via = [\"P\"]\nkind = \"cable\"\nstiffness_n = 10\nprestress_n = 1",
            "f:11:15: bars[1].prestress_n: a rope over rings or pulleys has no prestress here: its unstretched length says what it bears",
        ),
    ] {
        let error = parse(&ring(&format!("{more}\nlength_m = 5")), "f").unwrap_err();
        assert_eq!(error.to_string(), wanted);
    }
}

/// Two pulleys and a ring on a rope.
fn over_pulleys(length_m: f64) -> System {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("D", [3.0, 0.0, 4.0]),
        Joint::free("P").with_mass(1.0),
        Joint::anchor("B", [3.0, 0.0, 6.0]),
    ];
    let rope = Member::cable(0, 3, Bar::homogeneous(length_m, 0.0).unwrap()).over(vec![1, 2]);
    System::new("over a pulley", 10.0, joints, vec![rope]).unwrap()
}

#[test]
fn ropes_that_do_not_reach_past_their_pulleys_are_refused() {
    assert_eq!(over_pulleys(7.5).refusal(), Ok(()));
    for (length_m, words) in [(6.8, "0.2 m are missing"), (7.0, "straight and taut")] {
        let refused = over_pulleys(length_m).refusal().unwrap_err();
        let SystemRefusal::ShortRope { member, way_m, .. } = refused else { panic!("{refused}") };
        assert!(member == 1 && (way_m - 7.0).abs() < 1e-14);
        assert!(refused.to_string().contains(words), "{refused}");
    }
    // The ends alone are too far apart.
    assert!(matches!(over_pulleys(6.0).refusal(), Err(SystemRefusal::OutOfReach { .. })));
}

#[test]
fn rings_hang_on_their_rope_and_lost_ropes_leave_them() {
    let system = over_pulleys(9.0);
    assert_eq!(system.parts().len(), 1);
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(1.0)];
    let rope = Member::cable(0, 7, Bar::homogeneous(1.0, 0.0).unwrap()).over(vec![1]);
    let error = System::new("", 10.0, joints, vec![rope]).unwrap_err();
    assert!(matches!(error, SystemError::NoSuchJoint { joint: 7, .. }), "{error}");
    let mut members = system.members().to_vec();
    members.insert(0, Member::cable(0, 2, Bar::homogeneous(9.0, 0.0).unwrap()));
    let both = System::new("both", 10.0, system.joints().to_vec(), members).unwrap();
    let (left, joints) = both.without(0);
    assert_eq!((left.members()[0].via(), joints), (&[1, 2][..], vec![0, 1, 2, 3]));
    let (left, joints) = both.without(1);
    assert_eq!((left.members().len(), joints), (1, vec![0, 2]));
}
