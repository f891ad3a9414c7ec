//! Answers that nobody asked for.

use super::*;

/// The paper's chain upside down is listed, and the other solver was asked for minima alone.
#[test]
fn a_saddle_is_judged_alone_and_looked_up() {
    use model::Reason;
    let problem = model::cases::paper();
    let census = Census::take(&problem, &census::Settings::default()).unwrap();
    let seed = lagrange::Seed::planar(&[1.2, -0.7, -0.3]);
    let settings = lagrange::Settings::default();
    let saddle = lagrange::solve_from(&problem, &seed, &settings).unwrap().equilibrium;
    let judged = |missing: Option<(SolverName, NoAnswer)>| {
        let mut found = [saddle.clone()];
        assert!(judge(&problem, &mut found, missing, &census).is_none());
        assert!(found[0].evidence.ladder.complete.is_reached());
        found[0].evidence.ladder.agreed.reason().cloned()
    };
    let missing = judged(Some((SolverName::ENERGY, NoAnswer::MinimaOnly)));
    assert!(
        matches!(&missing, Some(Reason::OtherSolverWithoutAnswer { solver, because: NoAnswer::MinimaOnly, .. })
            if *solver == SolverName::ENERGY),
        "{missing:?}"
    );
    assert!(matches!(judged(None), Some(Reason::OneSolverOnly { .. })));
    assert!(judge(&problem, &mut [], None, &census).is_none());
    let mut both = [saddle.clone(), saddle.clone()];
    assert!(judge(&problem, &mut both, None, &census).is_some());
}
