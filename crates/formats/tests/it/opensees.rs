//! OpenSees decks.

use formats::system::parse_opensees;
use model::STANDARD_GRAVITY_M_S2;
use model::system::{Kind, Support};

use crate::refused;

/// A tripod on two supports and a slider, with masses.
const DECK: &str = "\
# a tripod
wipe
model BasicBuilder -ndm 3 -ndf 3
set L 4.0 ; set h [expr $L/2 - 0.5];
node 1 0 0 0
node 2 $L 0 0; node 3 0 [expr {-$L}] 0
node 4 [expr 7/2] 1 $h -mass 10 10 10
fix 1 1 1 1
fix 2 0 1 1
fix 3 0 0 1
uniaxialMaterial Elastic 1 200e9
element truss 1 1 4 1e-4 1
element corotTruss 2 2 4 2e-4 1 -rho 8
element corotTruss 3 4 \\
    3 3e-4 1 -rho 0.5 -cMass 0
pattern Plain 1 Linear {
    # down and aside
    load 4 1.0 -2.0 -3000
    load 4 0 0.5 0
}
pattern Plain 2 \"Constant\" -fact 2.0 { load 2 100 0 0 }
integrator LoadControl 0.1
analyze 10
";

#[test]
fn trusses_are_elastic_bars_and_nothing_weighs() {
    let read = parse_opensees(DECK, "a/tripod.tcl").unwrap();
    let system = &read.system;
    assert_eq!(system.name(), "tripod");
    // Whole numbers are divided as Tcl does.
    assert_eq!(system.joints()[3].near_m, Some([3.0, 1.0, 1.5]));
    let supports: Vec<Support> = system.joints().iter().map(|joint| joint.support).collect();
    let along = Support::Line { at_m: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
    let level = Support::Plane { at_m: [0.0, -4.0, 0.0], normal: [0.0, 0.0, 1.0] };
    assert_eq!(supports, [Support::Fixed { at_m: [0.0; 3] }, along, level, Support::Free]);
    let stiff: Vec<_> = system.members().iter().map(|m| (m.kind, m.stiffness_n.unwrap())).collect();
    assert_eq!(stiff, [(Kind::Bar, 2e7), (Kind::Bar, 4e7), (Kind::Bar, 200e9 * 3e-4)]);
    let [second_m, third_m] = [(1.0_f64 + 1.0 + 2.25).sqrt(), (9.0_f64 + 25.0 + 2.25).sqrt()];
    assert!((system.members()[0].body.length_m() - 3.5).abs() < 1e-15);
    // Half of each truss at each of its ends; the weight of a mass is held up.
    let masses = [0.0, 4.0 * second_m, 0.25 * third_m, 10.0 + 4.0 * second_m + 0.25 * third_m];
    let loads = [[0.0; 3], [200.0, 0.0, 0.0], [0.0; 3], [1.0, -1.5, -3000.0]];
    for ((joint, mass_kg), load_n) in system.joints().iter().zip(masses).zip(loads) {
        assert!((joint.mass_kg - mass_kg).abs() < 1e-12, "{joint:?}");
        let held_n = [0.0, 0.0, joint.mass_kg * STANDARD_GRAVITY_M_S2];
        for axis in 0..3 {
            assert!((joint.force_n[axis] - held_n[axis] - load_n[axis]).abs() < 1e-9, "{joint:?}");
        }
    }
    assert!(system.members().iter().all(|member| member.body.mass_kg() <= 0.0));
    for says in [
        "units: N, m and kg as written", "nothing weighs", "truss is linear in OpenSees",
        "not read: analyze, integrator, wipe",
    ] {
        assert!(read.notes.iter().any(|note| note.contains(says)), "{:?}", read.notes);
    }
}

/// Two on anchors, which are summed, and one on a slider, which acts.
#[test]
fn loads_on_held_nodes_are_told_with_their_sum() {
    let held = |read: &formats::system::ForeignSystem| {
        read.notes.iter().find(|note| note.contains("held")).cloned()
    };
    let read = parse_opensees(DECK, "x").unwrap();
    assert_eq!(held(&read), None);
    let text = DECK
        .replace("fix 3 0 0 1", "fix 3 1 1 1")
        .replace("load 4 0 0.5 0", "load 1 2 0 -5\nload 2 30 4 0\nload 3 -0.5 1 0");
    let read = parse_opensees(&text, "x").unwrap();
    let says = "loads on held nodes (2), in sum (1.5, 1, -5) N, go to the ground and are not in the reactions";
    assert_eq!(held(&read).as_deref(), Some(says));
    // Of pattern 2 there are 200 N.
    assert_eq!(read.system.joints()[1].force_n[..2], [230.0, 4.0]);
}

/// A comment goes on behind one backslash at the end of its line, and not behind two.
#[test]
fn comments_go_on_as_those_of_tcl() {
    let of = |text: &str| {
        let text = DECK.replace("# down and aside\n", text);
        parse_opensees(&text, "x").unwrap().system.joints()[3].force_n[0]
    };
    let load = "    load 4 999 0 0\n";
    for (comment, x) in [
        ("# down\n", 1000.0),
        ("# down \\\n", 1.0),
        ("# down \\\r\n", 1.0),
        ("# down \\\\\n", 1000.0),
        ("# down \\ and\n", 1000.0),
        ("# down \\\nand \\\n", 1.0),
    ] {
        assert!((of(&format!("{comment}{load}")) - x).abs() < 1e-12, "{comment:?}");
    }
}

#[test]
fn what_is_not_a_truss_at_rest_is_named_with_its_line() {
    refused("opensees", DECK, |text| parse_opensees(text, "x"));
    assert_eq!(parse_opensees("", "x").unwrap_err().to_string(), "x: there is no element");
    // A word does not grow without end by variables of variables.
    let mut text = "set a 0123456789\n".to_owned();
    text += &"set a $a$a$a$a$a$a$a$a$a$a\n".repeat(9);
    let error = parse_opensees(&text, "x").unwrap_err();
    assert_eq!(error.to_string(), "x:4: a word of more than 1000 letters is not understood");
    let deep = format!("set a [expr {}1{}]\n", "(".repeat(900), ")".repeat(900));
    assert!(parse_opensees(&deep, "x").unwrap_err().to_string().contains("the arithmetic"));
}

/// Arithmetic as Tcl has it.
#[test]
fn arithmetic_is_that_of_tcl() {
    for (text, x) in [
        ("7/2", 3.0),
        ("-7/2", -4.0),
        ("-7%3", 2.0),
        ("7/2.0", 3.5),
        ("2**3**2", 512.0),
        ("-2**2", 4.0),
        ("2+3*4-6/3", 12.0),
        ("(2+3)*-4", -20.0),
        ("10-4-3", 3.0),
        ("sqrt(16)*1e-1", 0.4),
        ("pow(2,-1)+hypot(3,4)", 5.5),
        ("abs(-3)/2", 1.0),
        ("2.5e+1", 25.0),
    ] {
        let text = format!(
            "model basic -ndm 2\nnode 1 0 0\nnode 2 [expr {text}] 1\nfix 1 1 1\n\
             uniaxialMaterial Elastic 1 1\nelement truss 1 1 2 1 1\n"
        );
        let read = parse_opensees(&text, "x").unwrap();
        let at_m = read.system.joints()[1].near_m.unwrap();
        assert!((at_m[0] - x).abs() < 1e-15, "{text} {at_m:?}");
    }
}
