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
