//! What every command says of the evidence for an equilibrium.

use serde_json::json;

use super::output::Output;

/// Residuals in units of the largest force or length, and differences between two answers to
/// numbers of some metres and newtons: in exact arithmetic they are nothing.
pub const NOTHING: f64 = 1e-12;

/// The words of each rung of the ladder, as the design names them.
const RUNGS: [&str; 5] = ["converged", "agreed", "verified", "complete", "optimal"];

/// A solver's own numbers and those of the first rung, for the solvers in their order.
///
/// Tolerances are those that README and the crates' pages state; an iteration of either solver
/// changes an answer, so there is one at least, and Newton's method doubles its digits.
pub fn converged(output: &mut Output, at: &str, residual_of: &[&str], tolerances: &[f64]) {
    let path = |key: &str| format!("{at}.evidence.{key}");
    for of in ["residual_of", "ladder[].proof.residual_of"] {
        output.says(&path(of), residual_of);
    }
    for residual in ["residual", "ladder[].proof.residual"] {
        output.within(&path(residual), 0.0..=NOTHING);
    }
    output.each(&path("ladder[].proof.tolerance"), tolerances);
    for iterations in ["iterations", "ladder[].proof.iterations"] {
        output.within(&path(iterations), 1.0..=60.0);
    }
    // Nobody waits for a small system.
    output.within(&path("solve_s"), 1e-7..=60.0);
    output.each(&path("ladder[].rung"), RUNGS.as_slice());
}

/// The rung of two solvers that agree on shape and forces.
pub fn agreed(output: &mut Output, at: &str) {
    let path = |key: &str| format!("{at}.evidence.ladder[].proof.{key}");
    output.each(&path("solvers[]"), json!(["lagrange", "energy"]));
    for difference in ["joints_m", "forces_n", "energy_j", "statics"] {
        output.within(&path(difference), 0.0..=NOTHING);
    }
    output.each(&path("shape_only"), false);
}

/// The comparison itself.
pub fn agreement(output: &mut Output, statics: &[&str]) {
    for difference in ["joints_m", "forces_n", "energy_j"] {
        output.within(&format!("agreement.{difference}"), 0.0..=NOTHING);
    }
    for law in statics {
        output.within(&format!("agreement.statics[].{law}"), 0.0..=NOTHING);
    }
    output.are(json!({ "agreement.free_joints": 0, "agreement.verdict": "agreed" }));
    for none in ["agreement.reasons[]", "agreement.excesses[]"] {
        output.is(none, json!([]));
    }
    output.is("failures[]", json!([]));
}
