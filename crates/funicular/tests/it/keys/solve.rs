//! `solve`: two bars between anchors on one level, a lamp on two light bars, the paper's chain.

use serde_json::json;

use super::evidence::{self, NOTHING};
use super::output::Output;

use crate::run::{good, holding};

/// Two bars of 1 m and 10 N over a span of 1 m: each stands at 60 degrees.
pub const LEVEL_V: &str = r#"
name = "level V"
gravity_m_s2 = 10
anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }
bars = [{ length_m = 1, mass_kg = 1, count = 2 }]
"#;

/// Half the height of an equilateral triangle of side 1 m, m.
pub const DEPTH: f64 = 0.866_025_403_784_438_6;
/// The moment of 10 N about an anchor is borne by H over the depth: H = 10 (1/4)/(√3/2), N.
pub const H: f64 = 2.886_751_345_948_129;
/// The mean force of a bar is (H, 5 N), along the bar: its size, N.
pub const AXIAL: f64 = 5.773_502_691_896_258;

/// What is said of the system.
pub fn system_of_level_v(output: &mut Output) {
    output.system("level V", [3, 2], [2.0, 2.0, 10.0]);
}

/// A chain is a system with joints named by their numbers, found by the solvers of a row.
#[test]
fn level_v() {
    let mut output = Output::alone("level_v", LEVEL_V, "solve system.toml");
    system_of_level_v(&mut output);
    // Both centres are half the depth below the anchors.
    output.each("equilibria[].energy_j", -10.0 * DEPTH);
    output.each("equilibria[].joints[].name", json!(["0", "1", "2"]));
    let at_m = json!([0.0, 0.0, 0.0, 0.5, 0.0, -DEPTH, 1.0, 0.0, 0.0]);
    output.each("equilibria[].joints[].at_m[]", at_m);
    output.each("equilibria[].bars[].from", json!(["0", "1"]));
    output.each("equilibria[].bars[].to", json!(["1", "2"]));
    output.each("equilibria[].bars[].force_at_start_n[]", json!([-H, 0.0, 10.0, -H, 0.0, 0.0]));
    output.each("equilibria[].bars[].force_at_end_n[]", json!([H, 0.0, 0.0, H, 0.0, 10.0]));
    output.each("equilibria[].reactions_n.*[]", json!([-H, 0.0, 10.0, H, 0.0, 10.0]));
    output.each("equilibria[].bars[].axial_n", AXIAL);
    // At the anchor (H, 10 N), at the joint between them (H, 0), along (1, √3)/2.
    let [anchor, middle] = [0.5 * H + 10.0 * DEPTH, 0.5 * H];
    output.each("equilibria[].bars[].axial_from_n", json!([anchor, middle]));
    output.each("equilibria[].bars[].axial_to_n", json!([middle, anchor]));
    output.each("equilibria[].bars[].axial_max_n", anchor);
    let residuals = ["distance of the last joint", "projected gradient"];
    output.says("equilibria[].evidence.residual_of", &residuals);
    // Σ l/|F| (1 - u uᵀ) by the pull is 2 l/|F| times 3/4, 1, 1/4 along, across and up; and the
    // one motion, out of the plane, has one second derivative.
    output.near("equilibria[].evidence.condition", 1e-9, json!([4.0, 1.0]));
}

/// The same as arrays over joints and bars.
#[test]
fn columns_of_level_v() {
    let text = LEVEL_V.replace("count = 2", "count = 2, strength_n = 20");
    let mut output = Output::alone("columns_of_level_v", text, "solve system.toml --columns");
    let at_m = json!([0.0, 0.0, 0.0, 0.5, 0.0, -DEPTH, 1.0, 0.0, 0.0]);
    output.each("equilibria[].joints_m[][]", at_m);
    output.each("equilibria[].start_forces_n[][]", json!([-H, 0.0, 10.0, -H, 0.0, 0.0]));
    output.each("equilibria[].end_forces_n[][]", json!([H, 0.0, 0.0, H, 0.0, 10.0]));
    output.each("equilibria[].axial_n[]", AXIAL);
    let [anchor, middle] = [0.5 * H + 10.0 * DEPTH, 0.5 * H];
    output.each("equilibria[].axial_from_n[]", json!([anchor, middle]));
    output.each("equilibria[].axial_to_n[]", json!([middle, anchor]));
    output.each("equilibria[].axial_max_n[]", anchor);
    output.each("equilibria[].utilisation[]", anchor / 20.0);
}

/// A block of 40 kg under gravity 10 on four strands, each of which bears a quarter; the last runs 3 m down and 4 m
/// aside.
#[test]
fn a_tackle() {
    let text = "gravity_m_s2 = 10\njoints = { beam = { at_m = [0, 0, 0] }, block = { mass_kg = 40 }, \
                winch = { at_m = [4, 0, -3] } }\nbars = [{ from = \"beam\", to = \"winch\", length_m = 9, \
                via = [\"block\", \"beam\", \"block\", \"beam\"], kind = \"cable\" }]";
    let folder = holding([("tackle.toml", text)]);
    let arguments = ["solve", "tackle.toml", "--json", "--bars-csv", "tackle.csv"];
    let mut output = Output::json("solve", "a_tackle", &good(&folder, &arguments));
    output.each("equilibria[].bars[].via[]", json!(["block", "beam", "block", "beam"]));
    output.each("equilibria[].bars[].axial_n", 100.0);
    output.each("equilibria[].bars[].force_at_end_n[]", json!([80.0, 0.0, -60.0]));
    output.each(
        "equilibria[].joints[].at_m[]",
        json!([0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 4.0, 0.0, -3.0]),
    );
    let mut output = Output::file("solve --bars-csv", "a_tackle", folder.path().join("tackle.csv"));
    output.each("via", "block beam block beam");
}

/// 30 N and 20 N on one rope over two pulleys: the lighter one is at its pulley, and pulls it down.
#[test]
fn a_weight_at_its_pulley() {
    let text = "gravity_m_s2 = 10\njoints = { D = { at_m = [0, 0, 0] }, E = { at_m = [1, 0, 0] }, \
                P = { mass_kg = 3 }, Q = { mass_kg = 2 } }\nbars = [{ from = \"P\", to = \"Q\", length_m = 6, \
                via = [\"D\", \"E\"], kind = \"cable\" }]";
    let folder = holding([("two.toml", text)]);
    let mut output = Output::told("a_weight_at_its_pulley", &folder, "solve two.toml");
    output.each("equilibria[].evidence.jams[].member", 1);
    output.each("equilibria[].evidence.jams[].span", 3);
    output.each("equilibria[].evidence.jams[].pull_n[]", json!([0.0, 0.0, -20.0]));
    output.each("equilibria[].bars[].axial_n", 30.0);
    output.each("equilibria[].bars[].force_at_end_n[]", json!([0.0, 0.0, -20.0]));
    let text = good(&folder, &["solve", "two.toml"]);
    let said = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("span 3 of the rope (bar 1) has no length and bears 20.000000 N"),
        "{text}"
    );
}

/// 4 kg in the middle of a rope over two pulleys, 3 kg at each of its ends: the ends slide against each other.
#[test]
fn equal_weights() {
    let text = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, B = { at_m = [2, 0, 0] }, \
                P = { mass_kg = 3 }, Q = { mass_kg = 3 }, R = { mass_kg = 4 } }\nbars = [{ from = \"P\", \
                to = \"Q\", length_m = 8, via = [\"A\", \"R\", \"B\"], kind = \"cable\" }]";
    let folder = holding([("three.toml", text)]);
    let mut output = Output::told("equal_weights", &folder, "solve three.toml");
    output.is("agreement.undetermined[]", json!(["P", "Q"]));
    output.each("equilibria[].evidence.ladder[].proof.room.undetermined[]", json!(["P", "Q"]));
    output.each("equilibria[].bars[].axial_n", 30.0);
    let text = good(&folder, &["solve", "three.toml"]);
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    assert!(text.contains("Not determined by equilibrium: the places of P, Q"), "{text}");
}

/// A bar on two legs, held by a rope: `lagrange` begins in a higher minimum; 93.10886 J is the least over the angle of the
/// legs by a scan (a test of `validate`).
#[test]
fn boom_on_a_rope() {
    let text = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [1.41, 0.14, 0.25] }, \
                T = { at_m = [0.04, 0, 1.73] }, P = { mass_kg = 1.64 }, Q = { mass_kg = 3.49 } }\nbars = [\
                { from = \"A\", to = \"P\", length_m = 1.9, mass_kg = 0.69 }, \
                { from = \"B\", to = \"P\", length_m = 1.71, mass_kg = 0.6 }, \
                { from = \"P\", to = \"Q\", length_m = 1.27, mass_kg = 2.85 }, \
                { from = \"B\", via = [\"T\"], to = \"Q\", length_m = 2.672, kind = \"cable\" }]";
    let folder = holding([("boom.toml", text)]);
    let mut output = Output::told("boom_on_a_rope", &folder, "solve boom.toml");
    output.is("asked_again[]", json!(["lagrange"]));
    output.within("equilibria[].energy_j", 93.108_8..=93.108_9);
    let text = good(&folder, &["solve", "boom.toml"]);
    assert!(
        text.contains(
            "lagrange had found another equilibrium or none, and began again next to this"
        ),
        "{text}"
    );
}

/// The paper's chain in its own numbering, from 40 digits; it may turn about the line between its
/// anchors, and both answers are turned onto each other.
#[test]
fn the_paper_turned() {
    let mut output = Output::told("the_paper_turned", ".", "solve --case three-equal-bars");
    let g = 9.806_65;
    output.each("equilibria[].energy_j", (2.335_468_651_999_305 - 6.0) * g);
    // At the start the ground lifts the first bar; at the end of each the next one, or the ground.
    let up = [2.312_944_292_241_837_6, 1.312_944_292_241_837_6, 0.312_944_292_241_837_6];
    let up = [up[0], -up[1], -up[2], 0.687_055_707_758_162_4];
    let [start, end] =
        ["start", "end"].map(|end| format!("equilibria[].bars[].force_at_{end}_n[]"));
    for (path, wanted) in [(start, [up[0], -up[1], -up[2]]), (end, [up[1], up[2], up[3]])] {
        for (force, up) in output.numbers(&path).chunks(3).zip(wanted.iter().cycle()) {
            // |λ_2| mg level, in any direction about the vertical.
            assert!((force[0].hypot(force[1]) - 0.648_944_835_933_933_6 * g).abs() < NOTHING);
            assert!((force[2] - up * g).abs() < 1e-11, "{force:?} {up}");
        }
    }
    output.is("agreement.turned_parts", 1);
    output.each("equilibria[].evidence.ladder[].proof.room.turning_parts", 1);
    output.each("equilibria[].evidence.ladder[].proof.room.free_joints", 0);
    let at = |key: &str| format!("equilibria[].evidence.ladder[].{key}");
    output.each(&at("proof.system.turns"), 1);
    // Two circles.
    output.each(&at("proof.in_plane"), 2);
    output.each(&at("proof.patterns"), 8);
    output.each(&at("proof.singular"), true);
    output.each("equilibria[].evidence.nullity", 1);
}

/// Three bars of 1 m that hang down 2 m and come up 1 m: their forces are one of a family.
#[test]
fn straight_forces_are_a_family() {
    let text = "gravity_m_s2 = 10\nanchors = { start_m = [0, 0, 0], end_m = [0, 0, -1] }\n\
                bars = [{ length_m = 1, mass_kg = 1, count = 3 }]\n";
    let mut output = Output::alone("straight_forces_are_a_family", text, "solve system.toml");
    output.each(
        "equilibria[].joints[].at_m[]",
        json!([0, 0, 0, 0, 0, -1, 0, 0, -2, 0, 0, -1].map(f64::from)),
    );
    // All bars may be pulled more or less: down, down and up again.
    output.each("equilibria[].evidence.self_stresses.dimension", 1);
    output.each("equilibria[].evidence.self_stresses.choice", "anchors_moved_apart");
    for basis in output.numbers("equilibria[].evidence.self_stresses.basis[][]").chunks(3) {
        let third = basis[2].signum() / 3.0_f64.sqrt();
        for (found, wanted) in basis.iter().zip([-third, -third, third]) {
            assert!((found - wanted).abs() < NOTHING, "{basis:?}");
        }
    }
    output.is("agreement.self_stresses", 1);
    // As the anchors come back the bars lean by H/F and shorten by l (H/F)²/2 each, together by
    // nothing: 1/F_1² + 1/F_2² = 1/F_3², here by bisection; between the pull R of the first anchor
    // and the bars' middles hang 1/2, 3/2 bars, and the third hangs on 30 N - R.
    let [mut low, mut high] = [16.0_f64, 24.0];
    for _ in 0..100 {
        let r = 0.5 * (low + high);
        let sum = (r - 5.0).powi(-2) + (r - 15.0).powi(-2) - (25.0 - r).powi(-2);
        *(if sum > 0.0 { &mut low } else { &mut high }) = r;
    }
    output.each("equilibria[].bars[].axial_n", json!([low - 5.0, low - 15.0, 25.0 - low]));
    output.each("equilibria[].evidence.ladder[].proof.shape_only", true);
    // The census names straight positions, and does not list them.
    output.each("equilibria[].evidence.ladder[].reached", json!([true, true, false, false, true]));
    output.each("equilibria[].evidence.ladder[].reason.kind", json!(["no_box", "at_straight"]));
    output.each("equilibria[].evidence.ladder[].reason.distance", 0.0);
}

/// A lamp of 20 N on light bars of 3 and 4 m over 5 m: they meet at a right angle.
pub const LAMP: &str = r#"
name = "lamp"
gravity_m_s2 = 10
[joints]
A = { at_m = [0, 0, 0] }
B = { at_m = [5, 0, 0] }
P = { mass_kg = 2 }
[[bars]]
from = "A"
to = "P"
length_m = 3
mass_kg = 0
[[bars]]
from = "P"
to = "B"
length_m = 4
mass_kg = 0
"#;

/// What a system is, as its file says.
pub fn system_of_lamp(output: &mut Output) {
    output.system("lamp", [3, 2], [7.0, 2.0, 10.0]);
}

/// Joints, members and reactions of the lamp. 9/5 m along, 12/5 m down; the bars bear 4/5 and 3/5
/// of 20 N.
pub fn shape_of_lamp(output: &mut Output) {
    output.each("equilibria[].energy_j", -48.0);
    output.each("equilibria[].joints[].name", json!(["A", "B", "P"]));
    output.each(
        "equilibria[].joints[].at_m[]",
        json!([0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 1.8, 0.0, -2.4]),
    );
    output.each("equilibria[].bars[].from", json!(["A", "P"]));
    output.each("equilibria[].bars[].to", json!(["P", "B"]));
    for force in ["axial_n", "axial_from_n", "axial_to_n", "axial_max_n"] {
        output.each(&format!("equilibria[].bars[].{force}"), json!([16.0, 12.0]));
    }
    output
        .each("equilibria[].bars[].force_at_start_n[]", json!([-9.6, 0.0, 12.8, -9.6, 0.0, -7.2]));
    output.each("equilibria[].bars[].force_at_end_n[]", json!([9.6, 0.0, -12.8, 9.6, 0.0, 7.2]));
    output.each("equilibria[].reactions_n.*[]", json!([-9.6, 0.0, 12.8, 9.6, 0.0, 7.2]));
    output.each("equilibria[].stability.in_space", "stable");
    output.each("equilibria[].stability.index_in_space", 0);
    output.each("equilibria[].stability.index_in_plane", 0);
    output.each("equilibria[].stability.neutral", 0);
}

/// Proof and census of the lamp: alone in its box, below its anchors or above them.
fn proofs_of_lamp(output: &mut Output) {
    let at = |key: &str| format!("equilibria[].evidence.ladder[].proof.{key}");
    output.within(&at("box_width"), f64::EPSILON / 2.0..=NOTHING);
    output.within(&at("distance"), 0.0..=NOTHING);
    output.each(&at("circle"), false);
    output.within(&at("system.width_m"), f64::EPSILON..=NOTHING);
    output.within(&at("system.width_n"), f64::EPSILON..=NOTHING);
    output.within(&at("system.distance_n"), 0.0..=NOTHING);
    for none in ["turns", "slack", "loose_joints", "hanging"] {
        output.each(&at(&format!("system.{none}")), 0);
    }
    let wanted = json!({
        "system.parts": 1, "in_plane": 2, "families": 0, "patterns": 4,
    });
    output.repeat_at(at, wanted);
    output.within(&at("cells"), 4.0..=1000.0);
    output.each(&at("system.positions"), 2);
}

#[test]
fn lamp() {
    // With a tolerance it is no chain, and is solved by its members.
    let lamp = LAMP.replacen("length_m = 3\n", "length_m = 3\nlength_tolerance_m = 1e-9\n", 1);
    let mut output = Output::alone("lamp", lamp, "solve system.toml");
    output.is("schema_version", 3);
    system_of_lamp(&mut output);
    output.is("equilibria[].solver", json!(["lagrange", "energy"]));
    shape_of_lamp(&mut output);
    output.each("equilibria[].evidence.rung", "optimal");
    let residuals = ["balance of joints", "largest unbalanced force"];
    evidence::converged(&mut output, "equilibria[]", &residuals, &[1e-12, 1e-12]);
    output.each("equilibria[].evidence.nullity", 0);
    // Two members at a right angle, and the one motion is out of their plane.
    output.near("equilibria[].evidence.condition", 1e-9, json!([1.0, 1.0]));
    output.each("equilibria[].evidence.rigidity.rank", 2);
    output.each("equilibria[].evidence.rigidity.mechanisms", 1);
    output.each("equilibria[].evidence.rigidity.self_stresses", 0);
    output.each("equilibria[].evidence.rigidity.gap[]", json!([1.0, 0.0]));
    evidence::agreed(&mut output, "equilibria[]");
    let at = |key: &str| format!("equilibria[].evidence.ladder[].{key}");
    output.each(&at("reached"), true);
    let how = ["after", "lagrange and energy differ", "exactly one", "no other", "semidefinite"];
    output.says(&at("how"), &how);
    output.each(&at("proof.forces_found.proved"), "rank_and_stability");
    proofs_of_lamp(&mut output);
    output.within(&at("proof.gap"), 0.0..=NOTHING);
    output.each(&at("proof.singular"), false);
    let laws = ["support", "length", "law", "force", "moment", "joint", "balance", "derived"];
    evidence::agreement(&mut output, &laws);
    // Roundings of the energy are the largest there are.
    output.each("agreement.statics[].worst", "whole");
    output.are(json!({ "agreement.turned_parts": 0, "agreement.self_stresses": 0 }));
}

/// A weight of 1 N on three cables in a plane, √2, 1 and √2 m long, and a hanger: with the outer
/// forces t and the middle one 1 - √2 t there is a family.
#[test]
fn three_cables() {
    let side = std::f64::consts::SQRT_2;
    let text = format!(
        "gravity_m_s2 = 1\n\
         joints = {{ A = {{ at_m = [-1, 0, 0] }}, B = {{ at_m = [0, 0, 0] }}, C = {{ at_m = [1, 0, 0] }}, P = {{}}, Q = {{ mass_kg = 1 }} }}\n\
         bars = [\n\
         {{ from = \"A\", to = \"P\", length_m = {side}, mass_kg = 0, kind = \"cable\" }},\n\
         {{ from = \"B\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"cable\" }},\n\
         {{ from = \"C\", to = \"P\", length_m = {side}, mass_kg = 0, kind = \"cable\" }},\n\
         {{ from = \"P\", to = \"Q\", length_m = 0.5, mass_kg = 0, kind = \"cable\" }} ]\n"
    );
    let mut output = Output::alone("three_cables", text, "solve system.toml");
    // Least Σ F² l: 2 √2 t² + (1 - √2 t)², at t = 1/(2 + √2).
    let t = 1.0 / (2.0 + side);
    output.each("equilibria[].bars[].axial_n", json!([t, 1.0 - side * t, t, 1.0]));
    let at = |key: &str| format!("equilibria[].evidence.self_stresses.{key}");
    output.each(&at("dimension"), 1);
    // √2 is rounded, by less than a unit of its last place.
    output.within(&at("misfit_m"), 0.0..=2.0 * f64::EPSILON);
    output.each(&at("choice"), "equally_stiff");
    for basis in output.numbers(&at("basis[][]")).chunks(4) {
        // (1, -√2, 1, 0)/2 or its opposite.
        let sign = basis[0].signum();
        for (found, wanted) in basis.iter().zip([0.5, -side / 2.0, 0.5, 0.0]) {
            assert!((found - sign * wanted).abs() < NOTHING, "{basis:?}");
        }
    }
    // Only `lagrange` tells ranges.
    output.is(&at("ranges[].kind"), json!(["bounded", "bounded", "bounded", "unique"]));
    output.is(&at("ranges[].least_n"), json!([0.0, 0.0, 0.0]));
    output.is(&at("ranges[].most_n"), json!([side / 2.0, 1.0, side / 2.0]));
    output.is("agreement.self_stresses", 1);
    // All of it lies on its vertical: a turn moves nothing.
    output.is("agreement.turned_parts", 0);
    let at = |key: &str| format!("equilibria[].evidence.{key}");
    output.each(&at("ladder[].proof.shape_only"), true);
    // The closures leave one force open; no motion goes without restoring force.
    output.is(&at("nullity"), json!([1, 0]));
    // Six coordinates; four rows, one too many. Along the vertical the columns of P and Q have the
    // products 3, 1 and -1: singular values √(2 ∓ √2), across √1.
    output.repeat_at(at, json!({
        "rigidity.rank": 3, "rigidity.mechanisms": 3, "rigidity.self_stresses": 1,
        "rigidity.gap[]": [side - 1.0, 0.0], "ladder[].reached": [true, true, false, false, true],
        "ladder[].reason.kind": ["no_box", "no_census"],
        "ladder[].reason.because": ["self_stresses", "cables"], "ladder[].reason.dimension": 1,
    }));
}

/// A bar and an elastic one to a weight: no chain has a list with an elastic member, here the second.
#[test]
fn an_elastic_chain() {
    let text = "joints = { A = { at_m = [0, 0, 0] }, B = { at_m = [1, 0, 0] }, P = { mass_kg = 1 } }\n\
                bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 0 },\n\
                { from = 'P', to = 'B', length_m = 1, mass_kg = 0, stiffness_n = 100 }]";
    let mut output = Output::alone("an_elastic_chain", text, "solve system.toml");
    output.each("equilibria[].evidence.ladder[].reason.member", 2);
}

/// Two rings on one rope, and a bar of 1 m between them: six places, and two lengths that stay.
#[test]
fn rings_that_a_bar_keeps_apart() {
    let text = "joints = { A = { at_m = [-3, -0.5, 0] }, B = { at_m = [3, 0.5, 0] }, P = { mass_kg = 1 }, Q = { mass_kg = 1 } }\n\
                bars = [{ from = 'A', to = 'B', via = ['P', 'Q'], length_m = 8, mass_kg = 0, kind = 'cable' },\n\
                { from = 'P', to = 'Q', length_m = 1, mass_kg = 0 }]";
    let mut output = Output::alone("rings_that_a_bar_keeps_apart", text, "solve system.toml");
    let at = |key: &str| format!("equilibria[].evidence.ladder[].reason.{key}");
    output.repeat_at(at, json!({ "closures": 0, "motions": 4, "limit": 3 }));
    // The bar may push: the energy is not convex.
    output.each(&at("members"), 1);
}

/// A mass on a strut that cannot pull; its weight is what it would have to.
#[test]
fn refusals() {
    let falls = "gravity_m_s2 = 10\n\
                 joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
                 bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"strut\" }]\n";
    let folder = holding([("falls.toml", falls)]);
    let mut output = Output::ended(3, "refusals", &folder, "solve falls.toml");
    output.are(json!({ "equilibria[]": [], "agreement": null }));
    refusals_of_a_fall(&mut output);
}

/// `lagrange` sees joint P fall for ever, `energy` the strut pulled by its weight of 10 N.
pub fn refusals_of_a_fall(output: &mut Output) {
    output.is("failures[].solver", json!(["lagrange", "energy"]));
    output.says("failures[].reason", &["joint P moves on without end", "member 1"]);
    output.is("failures[].refusal.kind", json!(["escapes", "wrong_sign"]));
    output.is("failures[].refusal.joint", "P");
    output.within("failures[].refusal.distance_m", 1e6..=1e9);
    output.is("failures[].refusal.member", 1);
    output.near("failures[].refusal.force_n", 1e-9, 10.0);
}

/// A rod of 1 m and 1 kg at its top, drawn on its head and 0.1 m short: it stands there, and would
/// hang with 2 m less of height.
#[test]
fn a_drawn_rod() {
    let rod = "gravity_m_s2 = 10\nplane = \"xz\"\n[joints]\nfoot = { at_m = [0, 0, 0] }\n\
        P = { near_m = [0, 0, 0.9], mass_kg = 1 }\n[[bars]]\nfrom = \"foot\"\nto = \"P\"\nlength_m = 1\n\
        mass_kg = 0\n";
    let folder = holding([("rod.toml", rod)]);
    // `energy` finds minima alone, and there is none: undecided.
    let mut output = Output::ended(3, "a_drawn_rod", &folder, "solve rod.toml");
    output.near("near.moved", 1e-12, 0.1);
    output.near("near.moved_m", 1e-12, 0.1);
    output.are(json!({ "near.joint": "P", "near.is_neighbour": true, "near.barrier_j": [null] }));
    output.near("near.lower_j", 1e-12, -10.0);
    // The descent ends where the rod hangs, 1 m below the foot.
    output.near("failures[].refusal.moved_m", 1e-9, 1.9);
    output.is("equilibria[].evidence.ladder[].reason.solver", json!(["energy"]));
    output.within("equilibria[].evidence.ladder[].reason.statics", 0.0..=NOTHING);
}
