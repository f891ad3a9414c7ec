//! Whether answers agree.

use super::super::tests::lamp;
use super::*;

#[test]
fn what_was_not_compared_does_not_agree() {
    let (system, answer) = lamp();
    let agrees = |agreement: Option<SystemAgreement>| {
        SystemAnswer {
            equilibria: vec![],
            failures: vec![],
            agreement,
            near: None,
            asked_again: vec![],
        }
        .agrees()
    };
    let compared = |off_m: f64| {
        let mut second = answer.clone();
        second.solver = SolverName::ENERGY;
        second.joints_m[2][1] += off_m;
        Some(compare(&system, &mut [answer.clone(), second], &Tolerances::project()))
    };
    assert!(!agrees(None) && agrees(compared(0.0)) && !agrees(compared(1e-3)));
}

#[test]
fn what_is_refuted_does_not_agree_and_what_has_no_answer_is_not_decided() {
    let (system, _) = lamp();
    let good = ask(&system, Solvers::Both, &|_| {});
    assert!(good.agrees() && good.is_decided() && !good.check_failed());
    let mut refuted = good.clone();
    refuted.equilibria[1].evidence.ladder.refute(0.5);
    assert!(refuted.check_failed() && !refuted.agrees() && refuted.is_decided());
    let mut without = good.clone();
    without.failures.push(lagrange::Error::SeedLength { of: "bars", expected: 3, got: 2 }.into());
    assert!(!without.is_decided() && !without.check_failed());
    assert_eq!(without.failures[0].solver(), SolverName::LAGRANGE);
    // A proof by a box is worth as much as a residual; one of both is enough, of every answer.
    for (converged, verified) in [(true, true), (true, false), (false, true), (false, false)] {
        let mut answer = good.clone();
        let ladder = &mut answer.equilibria[1].evidence.ladder;
        assert!(ladder.verified.is_reached());
        if !converged {
            ladder.converged = Status::Open(Reason::NotTried);
        }
        if !verified {
            ladder.verified = Status::Open(Reason::NotTried);
        }
        assert_eq!(answer.is_decided(), converged || verified);
    }
}
