//! `judge`: an answer that breaks the law of every member, of the floor and of the ground, with
//! numbers by hand.

use serde_json::json;

use super::evidence::NOTHING;
use super::judge::judged;
use super::output::Output;

/// Four weights, each below an anchor of its own, on an elastic bar, a cable, and two bars.
const HANGERS: &str = r#"
name = "hangers"
gravity_m_s2 = 10
floor_m = -6

[joints]
A = { at_m = [0, 0, 0] }
B = { at_m = [5, 0, 0] }
C = { at_m = [10, 0, 0] }
D = { at_m = [15, 0, 0] }
P = { mass_kg = 10 }
Q = { mass_kg = 4 }
R = { mass_kg = 10 }
S = { mass_kg = 10 }

[[bars]]
from = "A"
to = "P"
length_m = 2
mass_kg = 0
stiffness_n = 1000

[[bars]]
from = "B"
to = "Q"
length_m = 3
mass_kg = 0
kind = "cable"

[[bars]]
from = "C"
to = "R"
length_m = 5
mass_kg = 0

[[bars]]
from = "D"
to = "S"
length_m = 5.5
mass_kg = 0
"#;

/// P is half a metre below its length, R and S 1.5 and 0.5 m; R is below the floor, S on it.
const PLACES: &str = "joint,x_m,y_m,z_m,reaction_x_n,reaction_y_n,reaction_z_n
A,0,0,0,0,0,100
B,5,0,0,0,0,-40
C,10,0,0,0,0,100
D,15,0,0,0,0,120
P,0,0,-2.5,0,0,0
Q,5,0,-3,0,0,0
R,10,0,-6.5,0,0,0
S,15,0,-6,0,0,0
";

/// Weights are 100 N, that of Q 40 N: its cable pushes it down, and S is pulled by 30 N too much.
const FORCES: &str = "from,to,axial_n\nA,P,100\nB,Q,-40\nC,R,100\nD,S,130\n";

#[test]
fn every_law_broken() {
    let mut output = judged("every_law_broken", 1, HANGERS, PLACES, Some(FORCES));
    output.is("finding", "refuted");
    let laws = [
        "elongation", "sign", "length", "length", "reaction", "balance", "reaction", "whole",
        "below_floor", "floor_pulls",
    ];
    for list in ["broken", "violations"] {
        let at = |key: &str| format!("{list}[].{key}");
        output.is(&at("law"), laws.as_slice());
        // 1000 N for each stretch by the length, 0.5 m of 2 m; D bears 130 N, the floor -30 N; and
        // of 280 N up and 340 N down 60 N are left.
        let values = [150.0, 40.0, 1.5, 0.5, 10.0, 80.0, 30.0, 60.0, 0.5, 30.0];
        let wanted = json!({
            "value": values.as_slice(), "elastic_n": [250.0], "force_n": [100.0, -40.0, 30.0],
            "length_m": [5.0, 5.5], "distance_m": [6.5, 6.0],
            "given_n[]": [0.0, 0.0, 120.0, 0.0, 0.0, 0.0],
            "wanted_n[]": [0.0, 0.0, 130.0, 0.0, 0.0, -30.0],
            "left_n[]": [0.0, 0.0, -80.0, 0.0, 0.0, -60.0], "place.member": [1, 2, 3, 4],
            "place.joint": [4, 6, 8, 7, 8], "place": "whole",
        });
        output.are_at(at, wanted);
    }
    let says = [
        "carries 100 N, and its elongation gives 250 N",
        "a cable that pushes with 40 N",
        "1.5 m more than its length of 5 m",
        "0.5 m more than its length of 5.5 m",
        "is said to push with (0, 0, 120) N, and its members and loads need (0, 0, 130) N",
        "(0, 0, -80) N are left over",
        "with (0, 0, 0) N, and its members and loads need (0, 0, -30) N",
        "together leave (0, 0, -60) N",
        "0.5 m below the floor",
        "pull it down with 30 N",
    ];
    output.says("broken[].says", &says);
    // 80 N are left over on Q, whose load is 40 N.
    output.are(json!({ "statics.joint": 2.0, "statics.worst.joint": 6 }));
    nearest(&mut output);
    let kinds = ["above_tolerance", "judge_refuses", "not_tried", "not_tried", "no_certificate"];
    output.is("ladder[].reason.kind", kinds.as_slice());
    // 40 N over a millionth of 130 N are more than all others over what is allowed.
    output.is("ladder[].reason.excesses[].place.member", 2);
    output.near("ladder[].reason.excesses[].value", 1e-6, 40.0 / 130e-6);
    output.is("ladder[].reason.because", "not_definite");
    // No bar is pressed.
    output.is("ladder[].reason.compressed", 0);
}

/// P hangs 0.2 m below its length, as 100 N stretch 2 m of 1000 N; R is 1.5 m further up.
fn nearest(output: &mut Output) {
    let at = |key: &str| format!("nearest.equilibria[].{key}");
    output.are_at(at, json!({ "solver": "energy", "joints_m": 1.5, "joint": 6 }));
    // The cable pulls with 40 N instead of pushing.
    output.are_at(at, json!({ "forces_n": 80.0, "member": 2 }));
    // -250 J and 62.5 J of the stretched bar for -220 and 10 J, -650 J for -500 J, -600 J for -550 J.
    output.is(&at("energy_j"), 22.5 - 150.0 - 50.0);
    output.is(&at("evidence.ladder[].reason.solver"), "energy");
    output.within(&at("evidence.ladder[].reason.statics"), 0.0..=NOTHING);
    output.is("nearest.failures[].solver", "lagrange");
    output.says("nearest.failures[].because", &["not converged"]);
}

/// A lamp of 20 N on two bars that reach 1 m aside and 0.01 m down.
fn flat_lamp(test: &'static str, down: &str, forces: Option<&str>) -> Output {
    let length = 1.0_f64.hypot(0.01);
    let lamp = format!(
        "gravity_m_s2 = 10\njoints = {{ A = {{ at_m = [-1, 0, 0] }}, B = {{ at_m = [1, 0, 0] }}, \
         P = {{ mass_kg = 2 }} }}\n\
         bars = [{{ from = \"A\", to = \"P\", length_m = {length}, mass_kg = 0 }}, \
         {{ from = \"P\", to = \"B\", length_m = {length}, mass_kg = 0 }}]\n"
    );
    let places = format!("joint,x_m,y_m,z_m\nA,-1,0,0\nB,1,0,0\nP,0,0,{down}\n");
    judged(test, 3, &lamp, &places, forces)
}

/// A tenth of a millimetre further down the bars are longer by a millionth of a metre, which a
/// tolerance of 2e-6 m at each end allows; but the lamp hangs elsewhere.
#[test]
fn too_flat_to_tell() {
    let mut output = flat_lamp("too_flat_to_tell", "-0.0101", None);
    output.is("finding", "far");
    output.near("joints_m", 1e-9, 1e-4);
    // A millionth of 2 m.
    output.near("allowed_m", 1e-12, 2e-6);
    output.is("violations[]", json!([]));
    output.is(
        "ladder[].reason.kind",
        json!(["solvers_disagree", "not_tried", "not_tried", "no_certificate"]),
    );
    // 20 N are 1e-4 m lower than lengths allow: 2e-3 J, of 20 N times 2 m.
    output.near("ladder[].reason.gap", 1e-6, -5e-5);
    output.is("ladder[].reason.excesses[].what", "joints");
    output.is("ladder[].reason.excesses[].between[]", json!(["places.csv", "energy"]));
    output.near("ladder[].reason.excesses[].value", 1e-9, 1e-4);
    output.near("ladder[].reason.excesses[].budget", 1e-12, 2e-6);
}

/// Each bar bears 10 N over its slope; 0.02 N more balance to 0.0004 N, which is allowed.
#[test]
fn forces_of_another() {
    let own = 10.0 * 1.0_f64.hypot(0.01) / 0.01;
    let forces = format!("from,to,axial_n\nA,P,{0}\nP,B,{0}\n", own + 0.02);
    let mut output = flat_lamp("forces_of_another", "-0.01", Some(&forces));
    output.is("finding", "other_forces");
    output.near("forces_n", 1e-7, 0.02);
    // A millionth of the largest, and its rounding.
    output.near("allowed_n", 1e-11, 1e-6 * (own + 0.02));
    output.is("ladder[].reason.excesses[].what", "forces");
}

/// 20 N on four bars of 5 m, 6.25 N in each, and a self-stress beside which they vanish.
#[test]
fn loads_hidden() {
    let anchors = [("A", -3, 4), ("B", 3, 4), ("C", -3, -4), ("D", 3, -4)];
    let joint = |(name, x, z): (&str, i32, i32)| format!("{name} = {{ at_m = [{x}, 0, {z}] }}\n");
    let bar = |(name, ..): (&str, i32, i32)| {
        format!("[[bars]]\nfrom = \"{name}\"\nto = \"P\"\nlength_m = 5\nmass_kg = 0\n")
    };
    let force = |(name, _, z): (&str, i32, i32)| {
        format!("{name},P,{}\n", 1e12 + 6.25 * f64::from(z.signum()))
    };
    let frame =
        "gravity_m_s2 = 10\n[joints]\nP = { at_m = [0, 0, 0], free = \"xz\", mass_kg = 2 }\n"
            .to_owned()
            + &anchors.map(joint).concat()
            + &anchors.map(bar).concat();
    let forces = "from,to,axial_n\n".to_owned() + &anchors.map(force).concat();
    let places = "joint,x_m,y_m,z_m\nP,0,0,0\n";
    let mut output = judged("loads_hidden", 3, &frame, places, Some(&forces));
    output.is("finding", "loads_hidden");
    output.near("force_n", 1e-15, 1e12 + 6.25);
    output.is("loads_n", 20.0);
    // A millionth of the largest, and its rounding.
    output.near("allowed_n", 1e-8, 1e6);
    output.within("member", 1.0..=2.0);
    output.is("ladder[].reason.excesses[].what", "large_force");
    output.within("ladder[].reason.excesses[].member", 1.0..=2.0);
    // The stresses store sum F l / 2 = 1e13 J, which doubles round to some 2e-3 J; the unit is 20 N
    // times 20 m. The bound has that rounding, a few times over.
    output.within("ladder[].reason.gap", 5e-6..=5e-3);
    let stresses = |key: &str| format!("nearest.equilibria[].evidence.self_stresses.{key}");
    output.each(&stresses("choice"), "equally_stiff");
    // Four bars on a joint that moves in a plane.
    output.repeat_at(stresses, json!({ "dimension": 2, "ranges[].kind": "free" }));
    output.within(&stresses("misfit_m"), 0.0..=1e-15);
    // Bars that are opposite to each other pull alike.
    for basis in output.numbers(&stresses("basis[][]")).chunks(4) {
        assert!(
            (basis[0] - basis[3]).abs() < 1e-15 && (basis[1] - basis[2]).abs() < 1e-15,
            "{basis:?}"
        );
        assert!(basis.iter().any(|x| x.abs() > 0.1), "{basis:?}");
    }
    let reason = |key: &str| format!("nearest.equilibria[].evidence.ladder[].reason.{key}");
    output.repeat_at(reason, json!({ "because": "not_definite", "compressed": 2 }));
}

/// A ring of 12 N on a rope of 5 m between anchors 4 m apart, 1.5 m below them: 10 N on both sides, not 9 N and 11 N.
#[test]
fn two_tensions() {
    let ring = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, B = { at_m = [4, 0, 0] }, \
                P = { mass_kg = 1.2 } }\n\
                bars = [{ from = \"A\", to = \"B\", via = [\"P\"], length_m = 5, kind = \"cable\" }]\n";
    let places = "joint,x_m,y_m,z_m\nA,0,0,0\nB,4,0,0\nP,2,0,-1.5\n";
    let forces = "from,to,axial_n\nA,P,9\nP,B,11\n";
    let mut output = judged("two_tensions", 1, ring, places, Some(forces));
    for list in ["broken", "violations"] {
        let at = |key: &str| format!("{list}[].{key}");
        output.are_at(at, json!({
            "law": "tension", "member": 1, "place.joint": 3, "sides_n[]": [9.0, 11.0], "value": 2.0,
        }));
    }
    output.says(
        "broken[].says",
        &["the rope (member 1) pulls with 9 N on one side and 11 N on the other"],
    );
    output.is("ladder[].reason.excesses[].place.joint", 3);
    output.is("bars[].via[]", json!(["P"]));
    output.is("bars[].axial_n", 10.0);
}
