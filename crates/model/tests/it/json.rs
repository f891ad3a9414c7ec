//! The JSON of an answer: the keys that other programs rely on, and no more than they are told of.

use model::{Equilibrium, Evidence, InPlane, InSpace, Reactions, Rung, SolverName, Stability};
use serde_json::Value;

fn equilibrium() -> Equilibrium {
    let mut evidence = Evidence::converged(1e-15, "residual", 4);
    evidence.reach(Rung::Agreed, "both");
    evidence.miss(Rung::Optimal, "no certificate");
    Equilibrium {
        solver: SolverName::Lagrange,
        energy_j: -1.0,
        joints_m: vec![[0.0; 3], [1.0, 2.0, 3.0]],
        multipliers_n: vec![[0.0; 3]; 2],
        reactions_n: Reactions { start: [0.0; 3], end: [1.0; 3] },
        axial_n: vec![0.5],
        stability: Stability {
            in_plane: InPlane::Maximum,
            index_in_plane: 1,
            in_space: InSpace::Unstable,
            index_in_space: 2,
        },
        evidence,
    }
}

#[track_caller]
fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

#[test]
fn the_keys_of_an_equilibrium_are_those_of_the_design() {
    let json = serde_json::to_value(equilibrium()).unwrap();
    assert_eq!(
        keys(&json),
        [
            "axial_n",
            "energy_j",
            "evidence",
            "joints_m",
            "multipliers_n",
            "reactions_n",
            "solver",
            "stability"
        ]
    );
    assert_eq!(keys(&json["reactions_n"]), ["end", "start"]);
    assert_eq!(
        keys(&json["stability"]),
        ["in_plane", "in_space", "index_in_plane", "index_in_space"]
    );
    assert_eq!(
        keys(&json["evidence"]),
        [
            "condition",
            "iterations",
            "ladder",
            "nullity",
            "residual",
            "residual_of",
            "rung",
            "solve_s"
        ]
    );
    assert_eq!(keys(&json["evidence"]["ladder"][0]), ["how", "reached", "rung"]);
    let system = model::cases::paper().chain().summary();
    assert_eq!(
        keys(&serde_json::to_value(system).unwrap()),
        ["bars", "gravity_m_s2", "name", "span_m", "total_length_m", "total_mass_kg"]
    );
}

#[test]
fn the_values_of_an_equilibrium_read_back() {
    let equilibrium = equilibrium();
    let json = serde_json::to_value(&equilibrium).unwrap();
    assert_eq!(json["joints_m"][1][2], 3.0);
    assert_eq!(json["reactions_n"]["end"][0], 1.0);
    assert_eq!(json["stability"]["index_in_space"], 2);
    assert_eq!(json["evidence"]["rung"], "agreed");
    for key in ["residual", "iterations", "nullity", "solve_s"] {
        assert!(json["evidence"][key].is_number(), "{key}");
    }
    assert_eq!(serde_json::from_value::<Equilibrium>(json).unwrap(), equilibrium);
}

#[test]
fn words_are_those_of_the_design() {
    fn word(value: impl serde::Serialize) -> String {
        serde_json::to_value(value).unwrap().as_str().unwrap().to_owned()
    }
    assert_eq!(
        [SolverName::Lagrange, SolverName::Energy, SolverName::Census].map(word),
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
    for solver in [SolverName::Lagrange, SolverName::Energy, SolverName::Census] {
        assert_eq!(solver.to_string(), word(solver));
    }
}

#[test]
fn the_rung_is_the_highest_that_was_reached() {
    let mut evidence = Evidence::converged(2.5e-16, "force", 7);
    let reached =
        |evidence: &Evidence| evidence.ladder().iter().map(|s| s.reached).collect::<Vec<_>>();
    assert_eq!(evidence.rung(), Rung::Converged);
    assert_eq!(reached(&evidence), [true, false, false, false, false]);
    assert_eq!(evidence.ladder()[0].how, "force: 2.5e-16 after 7 iterations");
    assert!(evidence.ladder()[1..].iter().all(|s| s.how == "not tried"));

    // A rung may be reached without those below it, and the ladder says so.
    evidence.reach(Rung::Optimal, "certificate");
    assert_eq!(evidence.rung(), Rung::Optimal);
    assert_eq!(reached(&evidence), [true, false, false, false, true]);
    evidence.miss(Rung::Agreed, "they differ");
    assert_eq!(evidence.rung(), Rung::Optimal);
    assert_eq!(evidence.ladder()[1].how, "they differ");
    evidence.reach(Rung::Agreed, "on second thoughts");
    // What was reached can be taken back.
    evidence.miss(Rung::Optimal, "the certificate is void");
    assert_eq!(evidence.rung(), Rung::Agreed);
    assert_eq!(evidence.ladder()[4].how, "the certificate is void");
    evidence.miss(Rung::Agreed, "no");
    assert_eq!(evidence.rung(), Rung::Converged);

    let rungs: Vec<_> = evidence.ladder().iter().map(|s| s.rung).collect();
    assert_eq!(rungs, Rung::ALL);
    assert!(Rung::ALL.is_sorted());
}
