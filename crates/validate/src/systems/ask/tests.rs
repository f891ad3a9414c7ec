//! Whether answers agree.

use super::super::tests::lamp;
use super::*;

#[test]
fn what_was_not_compared_does_not_agree() {
    let (system, answer) = lamp();
    let agrees = |agreement: Option<SystemAgreement>| {
        SystemAnswer { equilibria: vec![], failures: vec![], agreement, near: None }.agrees()
    };
    let compared = |off_m: f64| {
        let mut second = answer.clone();
        second.solver = SolverName::ENERGY;
        second.joints_m[2][1] += off_m;
        Some(compare(&system, &mut [answer.clone(), second], &Tolerances::project()))
    };
    assert!(!agrees(None) && agrees(compared(0.0)) && !agrees(compared(1e-3)));
}
