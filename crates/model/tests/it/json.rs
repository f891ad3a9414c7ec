//! The JSON of an answer: its words and numbers.

use model::{
    Agreed, Disagreement, Evidence, Excess, InPlane, InSpace, NoCensus, NoCertificate, Optimal,
    Place, Quantity, Reason, Room, Rung, SolverName, Status,
};
use serde_json::{Value, json};

fn agreed() -> Agreed {
    let solvers = vec![SolverName::LAGRANGE, SolverName::ENERGY, SolverName::new("a third")];
    Agreed {
        solvers,
        joints_m: 1e-13,
        forces_n: 2e-12,
        energy_j: 0.0,
        statics: 3e-16,
        room: Room::of(0, 2, vec![]),
        shape_only: true,
        forces_found: None,
    }
}

#[test]
fn the_values_of_the_evidence_are_written() {
    let mut evidence = Evidence::new("residual", 1e-15, 1e-13, 4);
    evidence.ladder.agreed = Status::Reached(agreed());
    evidence.ladder.optimal =
        Status::Open(Reason::NoCertificate(NoCertificate::Indefinite { bar: 2, excess: 0.25 }));
    let json = serde_json::to_value(evidence).unwrap();
    assert_eq!((&json["rung"], &json["residual_of"]), (&"agreed".into(), &"residual".into()));
    assert_eq!((&json["residual"], &json["iterations"]), (&1e-15.into(), &4.into()));
    for key in ["nullity", "solve_s"] {
        assert!(json[key].is_number(), "{key}");
    }
    assert_eq!(json["ladder"][1]["proof"]["forces_n"], 2e-12);
    assert_eq!(json["ladder"][4]["reason"]["excess"], 0.25);
}

#[test]
fn words_are_those_of_the_design() {
    fn word(value: impl serde::Serialize) -> String {
        serde_json::to_value(value).unwrap().as_str().unwrap().to_owned()
    }
    assert_eq!(
        [SolverName::LAGRANGE, SolverName::ENERGY, SolverName::CENSUS].map(word),
        ["lagrange", "energy", "census"]
    );
    assert_eq!(
        [InPlane::Minimum, InPlane::Saddle, InPlane::Maximum, InPlane::Degenerate].map(word),
        ["minimum", "saddle", "maximum", "degenerate"]
    );
    assert_eq!([InSpace::Stable, InSpace::Unstable].map(word), ["stable", "unstable"]);
    let rungs = ["converged", "agreed", "verified", "complete", "optimal"];
    assert_eq!(Rung::ALL.map(word), rungs);
    // People read the same words.
    assert_eq!(Rung::ALL.map(|rung| rung.to_string()), rungs);
    for solver in [SolverName::LAGRANGE, SolverName::ENERGY, SolverName::CENSUS] {
        assert_eq!(solver.to_string(), word(solver));
    }
}

#[test]
fn the_rung_is_the_highest_that_was_reached() {
    let mut evidence = Evidence::new("force", 2.5e-16, 1e-13, 7);
    let reached = |evidence: &Evidence| Rung::ALL.map(|rung| evidence.ladder.is_reached(rung));
    assert_eq!(evidence.rung(), Some(Rung::Converged));
    assert_eq!(reached(&evidence), [true, false, false, false, false]);
    assert_eq!(evidence.ladder.how(Rung::Converged), "force: 2.5e-16 after 7 iterations");
    let statements = evidence.ladder.statements();
    assert!(statements[1..].iter().all(|s| !s.reached && s.how == "not tried"));
    assert_eq!(statements.map(|s| s.rung), Rung::ALL);

    // A rung may be reached without those below it, and the ladder says so.
    evidence.ladder.optimal = Status::Reached(Optimal { gap: Some(1e-15), singular: false });
    assert_eq!(evidence.rung(), Some(Rung::Optimal));
    assert_eq!(reached(&evidence), [true, false, false, false, true]);
    evidence.ladder.agreed = Status::Reached(agreed());
    // What was reached can be taken back.
    evidence.ladder.optimal = Status::Open(Reason::NoCertificate(NoCertificate::Unusable));
    assert_eq!(evidence.rung(), Some(Rung::Agreed));
    evidence.ladder.agreed = Status::default();
    assert_eq!(evidence.rung(), Some(Rung::Converged));
    assert!(Rung::ALL.is_sorted());
}

/// A residual above its tolerance, or none at all, is no convergence, and nothing else is lost by
/// it.
#[test]
fn converged_is_not_reached_above_the_tolerance() {
    for residual in [1.000_1e-12, f64::NAN, f64::INFINITY] {
        let evidence = Evidence::new("force", residual, 1e-12, 3);
        assert_eq!(evidence.rung(), None);
        let Some(Reason::AboveTolerance(convergence)) = evidence.ladder.converged.reason() else {
            panic!("{evidence:?}")
        };
        assert_eq!((convergence.tolerance, convergence.iterations), (Some(1e-12), 3));
        assert!(evidence.ladder.how(Rung::Converged).contains("above the tolerance of 1e-12"));
        let json = serde_json::to_value(&evidence).unwrap();
        assert!(json["rung"].is_null());
        assert_eq!(json["ladder"][0]["reason"]["kind"], "above_tolerance");
        assert_eq!(json["ladder"][0]["reason"]["residual"].is_number(), residual.is_finite());
    }
    assert_eq!(Evidence::new("force", 1e-12, 1e-12, 3).rung(), Some(Rung::Converged));
}

/// Every reason is written with its kind and its numbers; what is not a number is null.
#[test]
fn reasons_are_written_with_their_numbers() {
    let excess = |value| Excess {
        what: Quantity::Statics { solver: SolverName::new("a third"), place: Place::Member(3) },
        value,
        budget: 1e-11,
    };
    let disagreement = Disagreement { excesses: vec![excess(1e-3), excess(f64::NAN)] };
    let statics = |value: Value| {
        json!({
            "what": "statics", "solver": "a third", "place": { "member": 3 },
            "value": value, "budget": 1e-11,
        })
    };
    let disagree = json!({ "excesses": [statics(json!(1e-3)), statics(Value::Null)] });
    let reasons = [
        (Reason::NotTried, json!({ "kind": "not_tried" })),
        (
            Reason::OneSolverOnly { solver: SolverName::ENERGY, statics: 1e-15 },
            json!({ "kind": "one_solver_only", "solver": "energy", "statics": 1e-15 }),
        ),
        (Reason::SolversDisagree(disagreement), with(disagree, "solvers_disagree")),
        (
            Reason::NoCensus(NoCensus::TooManyBars { bars: 30, limit: 12 }),
            json!({ "kind": "no_census", "because": "too_many_bars", "bars": 30, "limit": 12 }),
        ),
        (Reason::SlackFamily, json!({ "kind": "slack_family" })),
        (Reason::NotAmongDecided { cells: 2 }, json!({ "kind": "not_among_decided", "cells": 2 })),
        (Reason::Elsewhere { distance: 1e-6 }, json!({ "kind": "elsewhere", "distance": 1e-6 })),
        (
            Reason::AtStraight { distance: 1e-15 },
            json!({ "kind": "at_straight", "distance": 1e-15 }),
        ),
        (
            Reason::SingularFamilies { listed: 2 },
            json!({ "kind": "singular_families", "listed": 2 }),
        ),
        (
            Reason::StraightPosition { sides: vec![1, 2] },
            json!({ "kind": "straight_position", "sides": [1, 2] }),
        ),
        (
            Reason::NoCertificate(NoCertificate::Gap { gap: 0.5 }),
            json!({ "kind": "no_certificate", "because": "gap", "gap": 0.5 }),
        ),
    ];
    for (reason, written) in reasons {
        let mut evidence = Evidence::new("force", 0.0, 0.0, 0);
        evidence.ladder.agreed = Status::Open(reason);
        let json = serde_json::to_value(&evidence).unwrap();
        assert_eq!(json["ladder"][1]["reason"], written);
        assert_eq!(json["ladder"][1]["reached"], false);
        assert!(!evidence.ladder.how(Rung::Agreed).is_empty());
    }
}

fn with(mut object: Value, kind: &str) -> Value {
    object["kind"] = kind.into();
    object
}
