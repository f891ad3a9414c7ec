//! `judge`: of the lamp on a 3-4-5 triangle, right and 0.1 m too low.

use serde_json::json;

use super::evidence::{self, NOTHING};
use super::output::Output;
use super::solve::LAMP;

use crate::run::{holding, run};

/// What the bars bear where the lamp is right.
const FORCES: &str = "from,to,axial_n\nA,P,16\nP,B,12\n";

/// Lengths of the bars with the lamp at 2.5 m, m.
fn stretched() -> [f64; 2] {
    [1.8_f64.hypot(2.5), 3.2_f64.hypot(2.5)]
}

/// What is said of a system in places and with forces, and how that ends.
pub fn judged(
    test: &'static str,
    code: i32,
    system: &str,
    places: &str,
    forces: Option<&str>,
) -> Output {
    let forces_csv = ("forces.csv", forces.unwrap_or_default());
    let folder = holding([("system.toml", system), ("places.csv", places), forces_csv]);
    let alone = "judge system.toml --answer places.csv";
    let both = "judge system.toml --answer places.csv --members forces.csv";
    Output::ended(code, test, folder, if forces.is_some() { both } else { alone })
}

fn lamp(test: &'static str, height: &str, forces: Option<&str>, code: i32) -> Output {
    let places = format!("joint,x_m,y_m,z_m\nA,0,0,0\nB,5,0,0\nP,1.8,0,{height}\n");
    let mut output = judged(test, code, LAMP, &places, forces);
    output.is("schema_version", 3);
    output.system("lamp", [3, 2], [7.0, 2.0, 10.0]);
    output.is("source", "places.csv");
    // A millionth of 5 m and of 20 N.
    output.is("bounds.tolerance", 1e-6);
    output.near("bounds.position_m", 1e-9, 5e-6);
    output.near("bounds.force_n", 1e-9, 2e-5);
    output
}

/// Both bars are too long, by what Pythagoras says.
#[test]
fn too_low() {
    let mut output = lamp("too_low", "-2.5", None, 1);
    let lengths = stretched();
    let more = [lengths[0] - 3.0, lengths[1] - 4.0];
    output.is("finding", "refuted");
    output.says("says", &["refuted: a law is broken"]);
    output.is("broken[].at", json!(["member 1 (A - P)", "member 2 (P - B)"]));
    output.says("broken[].says", &["0.08058436015 m more than", "0.06078810085 m more than"]);
    for list in ["broken", "violations"] {
        let at = |key: &str| format!("{list}[].{key}");
        output.is(&at("place.member"), json!([1, 2]));
        output.each(&at("law"), "length");
        output.are_at(at, json!({ "length_m": [3.0, 4.0], "distance_m": lengths, "value": more }));
        // Both ends as far off as the answer may be.
        output.near(&at("allowed"), 1e-9, json!([1e-5, 1e-5]));
    }
    // In units of what is allowed.
    output.near("largest", 1e-8, more[0] / 1e-5);
    // The forces that balance 20 N in the wrong shape.
    let forces = [20.0 * lengths[0] * 3.2 / 12.5, 20.0 * lengths[1] * 1.8 / 12.5];
    output.is("forces", "found");
    output.within("residual_n", 0.0..=NOTHING);
    output.is("largest_n", forces[0]);
    output.within("steps", 1.0..=100.0);
    output.is("converged", true);
    // Ten times the load, which is larger than the forces.
    output.is("up_to_n", 200.0);
    output.within("least_n", 0.0..=NOTHING);
    // 0.1 m of 5 m.
    output.are(json!({ "confirmed_at": 0.1, "statics.length": more[0] / 3.0 }));
    for law in ["support", "law", "force", "moment", "joint", "balance", "derived"] {
        output.within(&format!("statics.{law}"), 0.0..=NOTHING);
    }
    output.is("statics.worst.member", 1);
    output.is("joints[].name", json!(["A", "B", "P"]));
    output.is("joints[].at_m[]", json!([0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 1.8, 0.0, -2.5]));
    let level = 20.0 * 3.2 * 1.8 / 12.5;
    let ground = [-level, 0.0, 12.8, level, 0.0, 7.2, 0.0, 0.0, 0.0];
    output.is("joints[].reaction_n[]", json!(ground));
    output.is("bars[].from", json!(["A", "P"]));
    output.is("bars[].to", json!(["P", "B"]));
    output.is("bars[].axial_n", json!(forces));
    nearest_of_too_low(&mut output, forces);
    ladder_of_too_low(&mut output, more[0] / 1e-5);
}

/// 0.1 m higher, with 2 J more.
fn nearest_of_too_low(output: &mut Output, forces: [f64; 2]) {
    let at = |key: &str| format!("nearest.equilibria[].{key}");
    output.is(&at("solver"), json!(["energy", "lagrange"]));
    output.repeat_at(at, json!({
        "index_in_space": 0, "joints_m": 0.1, "joint": 2, "forces_n": 12.0 - forces[1], "member": 2,
        "energy_j": -2.0, "forces_unique": true,
    }));
    // The first one is proved.
    output.encloses(&at("proved.joints_m[]"), json!([0.1]));
    output.encloses(&at("proved.forces_n[]"), json!([12.0 - forces[1]]));
    output.are(json!({ "nearest.failures[]": [], "nearest.without_guess": false }));
    output.each(&at("evidence.rung"), "optimal");
    let residuals = ["largest unbalanced force", "balance of joints"];
    evidence::converged(output, "nearest.equilibria[]", &residuals, &[1e-12, 1e-12]);
    evidence::agreed(output, "nearest.equilibria[]");
    output.each(&at("evidence.nullity"), 0);
    output.near(&at("evidence.condition"), 1e-9, json!([1.0, 1.0]));
    output.each(&at("evidence.rigidity.rank"), 2);
    output.each(&at("evidence.rigidity.mechanisms"), 1);
    output.each(&at("evidence.rigidity.self_stresses"), 0);
    output.each(&at("evidence.rigidity.gap[]"), json!([1.0, 0.0]));
    let at = |key: &str| format!("nearest.equilibria[].evidence.ladder[].{key}");
    output.each(&at("reached"), json!([true, true, false, false, true]));
    let how = ["after", "lagrange and energy differ", "not tried", "not tried", "semidefinite"];
    output.says(&at("how"), &how);
    output.each(&at("reason.kind"), "not_tried");
    output.within(&at("proof.gap"), 0.0..=NOTHING);
    output.each(&at("proof.singular"), false);
    output.each(&at("proof.forces_found.proved"), "rank_and_stability");
}

/// Not even the first rung, and why.
fn ladder_of_too_low(output: &mut Output, largest: f64) {
    let at = |key: &str| format!("ladder[].{key}");
    let rungs = ["converged", "agreed", "verified", "complete", "optimal"];
    output.is(&at("rung"), rungs.as_slice());
    output.each(&at("reached"), false);
    let how =
        ["8.1e3", "the judge refuses this answer", "not tried", "not tried", "lengths are off"];
    output.says(&at("how"), &how);
    let kinds = ["above_tolerance", "judge_refuses", "not_tried", "not_tried", "no_certificate"];
    output.is(&at("reason.kind"), kinds.as_slice());
    // 2 J less than the lamp has at rest, of 20 N times 5 m.
    output.near(&at("reason.gap"), 1e-3, -0.02);
    output.says(&at("reason.residual_of"), &["largest violation of a law"]);
    output.near(&at("reason.residual"), 1e-8, largest);
    let wanted = json!({
        "reason.tolerance": 1.0, "reason.iterations": 0, "reason.excesses[].what": "statics",
        "reason.excesses[].solver": "places.csv", "reason.excesses[].place.member": 1,
    });
    output.are_at(at, wanted);
    output.near(&at("reason.excesses[].value"), 1e-8, largest);
    output.is(&at("reason.excesses[].budget"), 1.0);
}

/// With the forces of the right shape the lamp is not in balance where it is too low.
#[test]
fn too_low_with_forces() {
    let mut output = lamp("too_low_with_forces", "-2.5", Some(FORCES), 1);
    let lengths = stretched();
    let pulls = [16.0 / lengths[0], 12.0 / lengths[1]];
    let left_x = -1.8 * pulls[0] + 3.2 * pulls[1];
    let left_z = 2.5 * pulls[0] + 2.5 * pulls[1] - 20.0;
    output.is("forces", "given");
    // Counts begin at 1.
    output.is("violations[].place.joint", 3);
    output.is("violations[].law", json!(["length", "length", "balance"]));
    output.is("violations[].left_n[]", json!([left_x, 0.0, left_z]));
    output.is("broken[].place.joint", 3);
    output.is("broken[].left_n[]", json!([left_x, 0.0, left_z]));
    // Over the load at the joint; and over all forces from outside together: 16, 12 and 20 N.
    let left = left_x.hypot(left_z);
    output.are(json!({ "statics.joint": left / 20.0, "statics.balance": left / 48.0 }));
}

#[test]
fn right() {
    let mut output = lamp("right", "-2.4", Some(FORCES), 0);
    output.is("finding", "confirmed");
    output.says("says", &["confirmed: an equilibrium is within the tolerance"]);
    output.are(json!({ "broken[]": [], "violations[]": [], "forces": "given" }));
    output.within("largest", 0.0..=1e-6);
    output.is("statics.worst", "whole");
    output.is("confirmed_at", json!(null));
    output.is("force_digits", json!(null));
    output.is("ladder[].reached", json!([true, true, false, false, true]));
    let solvers = ["places.csv", "lagrange", "energy"];
    output.is("ladder[].proof.solvers[]", solvers.as_slice());
    let at = |key: &str| format!("ladder[].proof.{key}");
    output.says(&at("residual_of"), &["largest violation of a law"]);
    output.within(&at("residual"), 0.0..=1e-6);
    output.are_at(at, json!({ "tolerance": 1.0, "iterations": 0 }));
    for difference in ["joints_m", "forces_n", "energy_j", "statics"] {
        output.within(&at(difference), 0.0..=NOTHING);
    }
    output.are_at(at, json!({ "shape_only": false, "forces_found.proved": "rank_and_stability" }));
    output.within(&at("gap"), 0.0..=NOTHING);
    output.is(&at("singular"), false);
}

/// 16 N of 20 N, and 12 N of 40 N where four times as much is required: the second is the weaker one.
#[test]
fn two_strengths() {
    let strong = LAMP.replace("length_m = 3", "length_m = 3\nstrength_n = 20");
    let strong = strong.replace("length_m = 4", "length_m = 4\nstrength_n = 40\nsafety = 4");
    let places = "joint,x_m,y_m,z_m\nP,1.8,0,-2.4\n";
    let mut output = judged("two_strengths", 0, &strong, places, None);
    output.are(json!({
        "bars[].utilisation": [0.8, 0.3], "weakest.bar": 2, "weakest.utilisation": 0.3,
        "weakest.safety": 10.0 / 3.0, "weakest.safety_wanted": 4.0,
    }));
    let folder = holding([("lamp.toml", &strong[..]), ("places.csv", places)]);
    let check = ["judge", "lamp.toml", "--answer", "places.csv", "--check"];
    assert_eq!(run(folder, &check).0, Some(1));
}
