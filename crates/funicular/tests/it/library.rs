//! The library as its users meet it.

use funicular::prelude::*;

fn cases() -> Vec<Problem> {
    ["two-bars", "three-equal-bars", "propped", "hundred-bars", "massless-links"]
        .map(|name| Problem::case(name).unwrap())
        .into()
}

/// What an answer says but for the times.
fn without_times(answer: &SolveAnswer) -> Vec<SystemEquilibrium> {
    let mut equilibria = answer.equilibria().to_vec();
    for equilibrium in &mut equilibria {
        equilibrium.evidence.solve_s = 0.0;
    }
    equilibria
}

#[test]
fn a_batch_keeps_the_order_and_is_what_each_run_says_whatever_the_threads() {
    let problems = cases();
    let single: Vec<_> =
        problems.iter().map(|problem| Solve::new().run(problem).unwrap()).collect();
    for threads in [1, 3] {
        let batch = Solve::new().threads(threads).run_all(&problems).unwrap();
        assert_eq!(batch.len(), problems.len());
        for ((problem, alone), together) in problems.iter().zip(&single).zip(&batch) {
            let together = together.as_ref().unwrap();
            assert_eq!(together.system().name(), problem.name());
            assert_eq!(without_times(alone), without_times(together), "{}", problem.name());
            assert_eq!(alone.agreement(), together.agreement());
        }
    }
}

#[test]
fn a_solver_alone_has_no_comparison_and_says_so() {
    for (solvers, name) in
        [(Solvers::Lagrange, SolverName::LAGRANGE), (Solvers::Energy, SolverName::ENERGY)]
    {
        let answer = Solve::new().solvers(solvers).run(&cases()[0]).unwrap();
        assert!(answer.agreement().is_none() && !answer.agrees() && answer.failures().is_empty());
        assert_eq!(answer.equilibria().len(), 1);
        assert_eq!(answer.by(&name), answer.equilibria().first());
    }
}

#[test]
fn the_full_and_the_condensed_equations_have_the_same_answer() {
    let problem = Problem::case("five-in-space").unwrap();
    let by = |equations| {
        let answer = Solve::new().equations(equations).solvers(Solvers::Lagrange).run(&problem);
        answer.unwrap().equilibria()[0].clone()
    };
    let [condensed, full] = [by(Equations::Condensed), by(Equations::Full)];
    for (a, b) in condensed.joints_m.iter().flatten().zip(full.joints_m.iter().flatten()) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
    assert!(full.evidence.iterations != condensed.evidence.iterations);
}

/// A row of bars has the paper's multipliers, however it is written; with a weight at a joint the force
/// that a bar passes on there is that of the bars alone.
#[test]
fn the_full_equations_and_multipliers_are_those_of_a_row() {
    let paper = Problem::case("three-equal-bars").unwrap();
    let full = Solve::new().equations(Equations::Full).census(UseCensus::Never);
    let answer = full.run(&paper).unwrap();
    let multipliers = answer.multipliers_n(&answer.equilibria()[0]).unwrap();
    let up_mg = multipliers[0][2] / model::STANDARD_GRAVITY_M_S2;
    assert!((up_mg - 2.312_944_292_241_838).abs() < 1e-12, "{up_mg}");
    let cable = Problem::case("bridle").unwrap();
    assert!(matches!(full.run(&cable), Err(Error::ChainsOnly(_))));
    let drawn = paper.near(&answer.equilibria()[0].joints_m).unwrap();
    assert!(matches!(full.run(&drawn), Err(Error::ChainsOnly(_))));
    let found = Solve::new().census(UseCensus::Never).run(&cable).unwrap();
    assert_eq!(found.multipliers_n(&found.equilibria()[0]), None);
}

/// What `solve` looks up in a census only where it is asked to.
#[test]
fn a_census_is_taken_where_it_is_asked_for() {
    let rung = |name, census| {
        Solve::new().census(census).run(&Problem::case(name).unwrap()).unwrap().rung()
    };
    let reached = |name: &str, census| {
        let answer = Solve::new().census(census).run(&Problem::case(name).unwrap()).unwrap();
        answer.equilibria()[0].evidence.ladder.is_reached(Rung::Complete)
    };
    assert!(reached("two-bars", UseCensus::Auto) && !reached("two-bars", UseCensus::Never));
    assert!(!reached("ten-equal-bars", UseCensus::Auto));
    assert_eq!(rung("two-bars", UseCensus::Never), Some(Rung::Optimal));
}

#[test]
fn errors_are_joined_and_say_what_they_said() {
    let unknown = Problem::case("three-equal-bar").unwrap_err();
    assert!(
        matches!(&unknown, Error::UnknownCase { suggestion: Some("three-equal-bars"), .. }),
        "{unknown:?}"
    );
    let anchors = Anchors { start_m: [0.0; 3], end_m: [3.0, 0.0, 0.0] };
    let chain = Chain::new("short", 9.81, anchors, vec![Bar::homogeneous(1.0, 1.0).unwrap(); 2]);
    let refused = Problem::try_from(chain.unwrap()).unwrap_err();
    assert!(
        matches!(refused, Error::Refused(model::system::Refusal::OutOfReach { .. })),
        "{refused:?}"
    );
    let file = Problem::parse("name = 1", "chain.toml").unwrap_err();
    assert!(file.to_string().starts_with("chain.toml:1:"), "{file}");
    let long = Census::new().max_bars(3).run(&Problem::case("ten-equal-bars").unwrap());
    assert!(matches!(long, Err(Error::Census(_))));
    let threads = Solve::new().threads(funicular::MOST_THREADS + 1).run(&cases()[0]);
    assert!(matches!(threads, Err(Error::TooManyThreads(1025))), "{threads:?}");
}

#[test]
fn a_system_of_joints_is_the_row_that_it_is() {
    use model::system::{Member, System};
    let joints = samples::joints(&[[0.0; 3], [1.0, 0.0, 0.0]], &[1.0]);
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let members = vec![Member::bar(0, 2, bar), Member::bar(2, 1, bar)];
    let problem = Problem::from(System::new("a lamp", 9.81, joints, members).unwrap());
    assert!(problem.row().is_some() && problem.to_toml().contains("[joints]"));
    let found = Census::new().run(&problem).unwrap();
    // Two equal bars between level anchors hang, or stand: a row of bars, however it is told.
    assert!(found.complete() && found.equilibria.len() == 2 && found.row().is_some());
}

#[test]
fn a_batch_takes_chains_and_systems_alike() {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[2.0]);
    let cord = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = vec![Member::cable(0, 2, cord), Member::cable(2, 1, cord)];
    let lamp = Problem::from(System::new("lamp", 10.0, joints, members).unwrap());
    // Nothing holds the second: it falls.
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let loose = vec![Joint::free("A"), Joint::free("B")];
    let loose = System::new("loose", 10.0, loose, vec![Member::bar(0, 1, bar)]).unwrap();
    let problems = [lamp, Problem::from(loose), cases().remove(0)];
    let solve = Solve::new().census(UseCensus::Never).threads(2);
    let answers = solve.run_all(&problems).unwrap();
    let lamp = answers[0].as_ref().unwrap();
    assert!(lamp.agrees() && lamp.is_decided() && !lamp.check_failed());
    // By the triangle 3, 4, 5.
    assert!((lamp.equilibria()[0].axial_n[1] - 12.5).abs() < 1e-9);
    assert!(matches!(answers[1], Err(Error::Refused(_))));
    assert!(answers[2].as_ref().is_ok_and(SolveAnswer::agrees));
}
