//! How far a census is gone for, and that answers are looked up in it.

use model::{Anchors, Bar, Chain};

use super::*;

/// Equal bars of 1 m and 1 kg from the origin to another anchor.
fn chain(bars: usize, end_m: [f64; 3]) -> Problem {
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    Problem::new(Chain::new("equal bars", 9.81, anchors, vec![bar; bars]).unwrap()).unwrap()
}

#[test]
fn a_census_is_taken_unasked_of_short_chains_alone() {
    let tests = |bars: usize, census: UseCensus| {
        let settings = census_settings(&chain(bars, [0.7, 0.0, 0.1]), census);
        settings.map(|settings| (settings.max_tests_per_pattern, settings.max_bars))
    };
    let usual = census::Settings::default();
    let (all, bars) = (usual.max_tests_per_pattern, usual.max_bars);
    assert_eq!(tests(3, UseCensus::Auto), Some((2000, bars)));
    assert_eq!(tests(8, UseCensus::Auto), Some((2000, bars)));
    assert_eq!(tests(9, UseCensus::Auto), None);
    assert_eq!(tests(9, UseCensus::Always), Some((all, bars)));
    assert_eq!(tests(3, UseCensus::Never), None);
    // Three bars fold onto one line over 1 m: one forward, one back, one forward.
    let straight = census_settings(&chain(3, [1.0, 0.0, 0.0]), UseCensus::Auto);
    assert_eq!(straight.unwrap().max_tests_per_pattern, 400);
}

#[test]
fn answers_are_looked_up_where_a_census_is_wanted() {
    let ladders = |census: UseCensus| {
        let question = Question { census, ..Question::default() };
        let answer = ask(&model::cases::paper(), &question, &|_| {});
        assert_eq!(answer.equilibria.len(), 2);
        for solver in [SolverName::LAGRANGE, SolverName::ENERGY] {
            assert_eq!(answer.by(&solver).map(|found| &found.solver), Some(&solver));
        }
        assert!(answer.by(&SolverName::CENSUS).is_none());
        let complete = |found: &Equilibrium| found.evidence.ladder.complete.is_reached();
        answer.equilibria.iter().map(complete).collect::<Vec<_>>()
    };
    assert_eq!(ladders(UseCensus::Auto), [true, true]);
    assert_eq!(ladders(UseCensus::Never), [false, false]);
}

fn asked(solvers: Solvers) -> Answer {
    let question = Question { solvers, census: UseCensus::Never, ..Question::default() };
    ask(&model::cases::paper(), &question, &|_| {})
}

fn failure() -> SolverFailure {
    SolverFailure::from(energy::Error::SeedSize { bars: 3, given: 2 })
}

#[test]
fn those_answer_that_are_asked() {
    let (lagrange, energy) = (SolverName::LAGRANGE, SolverName::ENERGY);
    for (solvers, names) in [
        (Solvers::Lagrange, vec![lagrange.clone()]),
        (Solvers::Energy, vec![energy.clone()]),
        (Solvers::Both, vec![lagrange.clone(), energy.clone()]),
    ] {
        let answer = asked(solvers);
        let found: Vec<_> = answer.equilibria.iter().map(|found| found.solver.clone()).collect();
        assert_eq!(found, names);
        assert!(answer.failures.is_empty() && answer.is_decided() && !answer.check_failed());
        assert_eq!(answer.agreement.is_some(), solvers == Solvers::Both);
        assert_eq!(answer.agrees(), solvers == Solvers::Both);
        assert_eq!(answer.by(&energy).is_some(), solvers != Solvers::Lagrange);
    }
    assert_eq!(failure().solver(), energy);
    let full = lagrange::SolveError::SeedLength { expected: 3, got: 2 };
    assert_eq!(SolverFailure::from(full).solver(), lagrange);
}

#[test]
fn what_is_refuted_does_not_agree_and_what_has_no_answer_is_not_decided() {
    let mut refuted = asked(Solvers::Both);
    refuted.equilibria[1].evidence.ladder.refute(0.5);
    assert!(refuted.check_failed() && !refuted.agrees() && refuted.is_decided());
    let mut without = asked(Solvers::Both);
    without.failures.push(failure());
    assert!(!without.is_decided() && !without.check_failed());
}

/// A proof by a box is worth as much as a residual; one of both is enough, of every answer.
#[test]
fn an_answer_is_decided_that_has_converged_or_is_proved() {
    use model::{Reason, Status};
    let proved = {
        let question = Question { census: UseCensus::Auto, ..Question::default() };
        ask(&model::cases::paper(), &question, &|_| {})
    };
    assert!(proved.equilibria[0].evidence.ladder.verified.is_reached());
    let decided = |converged: bool, verified: bool| {
        let mut answer = proved.clone();
        let ladder = &mut answer.equilibria[1].evidence.ladder;
        if !converged {
            ladder.converged = Status::Open(Reason::NotTried);
        }
        if !verified {
            ladder.verified = Status::Open(Reason::NotTried);
        }
        answer.is_decided()
    };
    assert!(decided(true, true) && decided(true, false) && decided(false, true));
    assert!(!decided(false, false));
}

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
