//! A thousand random chains of all hard shapes: both solvers hang each from no guess, and agree.
//!
//! `CHAINS=100000 cargo test -p validate --test it chains:: -- --nocapture` asks for more; the
//! chains that come after the first thousand are no part of the checks.

use std::collections::BTreeMap;

use lagrange::condensed;
use model::{Equilibrium, InPlane, Problem, Rung};
use rayon::prelude::*;
use samples::{Shape, folded_chain, random_chain};
use validate::Tolerances;
use validate::systems::SystemAgreement;

use crate::judged::compare;

/// Chains of the test.
const CHAINS: u64 = 1000;

/// Both hanging equilibria, or why there is none.
fn solved(problem: &Problem) -> Result<[Equilibrium; 2], String> {
    let lagrange = condensed::solve(problem, &condensed::Settings::default());
    let energy = energy::minimise(problem, &energy::Settings::default());
    match (lagrange, energy) {
        (Ok(lagrange), Ok(energy)) => Ok([lagrange.equilibrium, energy.equilibrium]),
        (lagrange, energy) => {
            let why = [lagrange.err().map(|e| e.to_string()), energy.err().map(|e| e.to_string())];
            Err(format!("lagrange: {:?}, energy: {:?}", why[0], why[1]))
        }
    }
}

/// What became of one chain.
struct Outcome {
    shape: Shape,
    bars: usize,
    compressed: bool,
    optimal: bool,
    iterations: [usize; 2],
    compared: Result<SystemAgreement, String>,
}

fn outcome(seed: u64, tolerances: &Tolerances) -> Outcome {
    let (shape, problem) = random_chain(seed);
    let bars = problem.chain().bars().len();
    let mut outcome = Outcome {
        shape,
        bars,
        compressed: false,
        optimal: false,
        iterations: [0; 2],
        compared: Err(String::new()),
    };
    outcome.compared = solved(&problem).map(|mut answers| {
        let agreement = compare(&problem, &mut answers, tolerances);
        outcome.optimal = answers.iter().all(|a| a.evidence.ladder.is_reached(Rung::Optimal));
        outcome.compressed = answers[0].axial_n.iter().any(|force| *force < 0.0);
        outcome.iterations = answers.each_ref().map(|a| a.evidence.iterations);
        agreement
    });
    outcome
}

/// What became of the chains of one shape.
#[derive(Default)]
struct Row {
    chains: usize,
    agreed: usize,
    optimal: usize,
    compressed: usize,
    free: usize,
    iterations: [usize; 2],
}

/// Measured: all agree. Largest differences over the thousand, by the budgets of the project.
#[test]
fn both_solvers_agree_on_a_thousand_random_chains() {
    let count = std::env::var("CHAINS").map_or(CHAINS, |count| count.parse().unwrap());
    let tolerances = Tolerances::project();
    let outcomes: Vec<_> =
        (0..count).into_par_iter().map(|seed| outcome(seed, &tolerances)).collect();
    let mut table: BTreeMap<Shape, Row> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (seed, outcome) in outcomes.iter().enumerate() {
        let row = table.entry(outcome.shape).or_default();
        row.chains += 1;
        row.optimal += usize::from(outcome.optimal);
        row.compressed += usize::from(outcome.compressed);
        for (most, here) in row.iterations.iter_mut().zip(outcome.iterations) {
            *most = here.max(*most);
        }
        let what = format!("{seed}: {:?}, {} bars", outcome.shape, outcome.bars);
        match &outcome.compared {
            Ok(agreement) => {
                row.agreed += usize::from(agreement.agrees());
                row.free += usize::from(agreement.free_joints > 0);
                if !agreement.agrees() {
                    wrong.push(format!("{what}: {:?}", agreement.disagreement));
                }
            }
            Err(why) => wrong.push(format!("{what}: {why}")),
        }
    }
    println!("shape            chains agreed optimal compressed  free  most iterations");
    for (shape, row) in &table {
        let Row { chains, agreed, optimal, compressed, free, iterations } = row;
        let shape = format!("{shape:?}");
        println!(
            "{shape:15} {chains:7} {agreed:6} {optimal:7} {compressed:10} {free:5}  {iterations:?}"
        );
    }
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(table.len() == Shape::ALL.len() || count < Shape::ALL.len() as u64);
    // No configuration has less energy than any of these, proved.
    let optimal: usize = table.values().map(|row| row.optimal).sum();
    assert!(optimal as u64 == count || count > CHAINS, "{optimal} of {count} proved optimal");
    // The shapes are what they are called, and the test is no walk through easy chains.
    assert!(table.get(&Shape::OneCompressed).is_none_or(|row| 2 * row.compressed > row.chains));
}

/// Condition with which one rounding leaves joints as uncertain as the 1e-10 of the size that
/// solvers are asked to agree to.
const NEARLY_FREE: f64 = 1e-10 / f64::EPSILON;

/// Chains at the edge of what doubles resolve: the solvers agree, or one of them refuses, or says
/// in its evidence that its forces are uncertain, that the position is degenerate, or by its
/// condition number that the chain turns next to freely about anchors so close. None is wrong
/// without a word.
#[test]
fn chains_all_but_folded_are_right_or_say_how_uncertain() {
    let count = std::env::var("CHAINS").map_or(CHAINS, |count| count.parse().unwrap());
    let tolerances = Tolerances::project();
    let outcomes: Vec<Result<bool, String>> = (0..count)
        .into_par_iter()
        .map(|seed| {
            let problem = folded_chain(seed);
            let Ok(mut answers) = solved(&problem) else { return Ok(false) };
            let agreement = compare(&problem, &mut answers, &tolerances);
            let uncertain = |answer: &Equilibrium| {
                answer.stability.in_plane == InPlane::Degenerate
                    || answer.evidence.condition > NEARLY_FREE
                    || answer.evidence.force_uncertainty().is_some()
            };
            if agreement.agrees() {
                Ok(true)
            } else if answers.iter().any(uncertain) {
                Ok(false)
            } else {
                Err(format!(
                    "{seed}: {:?} {:?}\n{:?}",
                    answers.each_ref().map(|a| a.evidence.condition),
                    agreement.disagreement,
                    problem.chain()
                ))
            }
        })
        .collect();
    let agreed = outcomes.iter().filter(|outcome| **outcome == Ok(true)).count();
    let wrong: Vec<_> = outcomes.iter().filter_map(|outcome| outcome.as_ref().err()).collect();
    println!("{agreed} of {count} agree");
    assert!(
        wrong.is_empty(),
        "{} of {count}, the first {:?}",
        wrong.len(),
        &wrong[..wrong.len().min(5)]
    );
    // Measured:
    assert!(2 * agreed as u64 > count, "{agreed} of {count} agree");
}

/// Heavy bars hang straight down from both anchors, massless ones between them: an equilibrium says
/// nothing about the joints between the massless ones, and everything about the others.
#[test]
fn loose_bars_are_compared_by_what_is_determined() {
    let tolerances = Tolerances::project();
    for (massless, free) in [(1, 0), (2, 1), (3, 2), (7, 6)] {
        let heavy = [(1.0, 1.0); 2];
        let bars = [&heavy[..], &vec![(1.0, 0.0); massless], &heavy].concat();
        // One bar alone has to fill the gap.
        let span = if massless == 1 { 1.0 } else { 0.75 };
        let problem = samples::homogeneous(1.0, &bars, [span, 0.0, 0.0]);
        let mut answers = solved(&problem).unwrap();
        let agreement = compare(&problem, &mut answers, &tolerances);
        assert!(agreement.agrees(), "{massless}: {:?}", agreement.disagreement);
        assert_eq!(agreement.free_joints, free, "{massless}");
        for answer in &answers {
            assert!((answer.joints_m[2][2] + 2.0).abs() < 1e-9, "{massless}");
            assert!((answer.reactions_n.start[2] - 2.0).abs() < 1e-9, "{massless}");
        }
        if free > 0 {
            // A joint that is held is compared all the same, and the lengths of loose bars are
            // judged.
            for k in [2, 3] {
                let mut moved = answers.clone();
                moved[1].joints_m[k][0] += 1e-6;
                assert!(!compare(&problem, &mut moved, &tolerances).agrees(), "{massless}");
            }
        }
    }
}

/// A bar of three metres stands on the lowest joint of a strand and pulls the first anchor up: all
/// bars are upright, and lengths alone do not say how the ties share the weight. Neither solver's
/// forces are worth anything, and both say so.
#[test]
fn upright_chains_with_a_prop_say_that_their_forces_are_uncertain() {
    let bars = [(1.0, 1.0), (3.0, 1.0), (1.0, 1.0), (1.0, 5.0), (1.0, 1.0)];
    let mut answers = solved(&samples::homogeneous(9.81, &bars, [0.0, 0.0, 1.0])).unwrap();
    for answer in &mut answers {
        let heights = answer.joints_m.iter().map(|joint| joint[2]);
        assert!(
            heights.zip([0.0, 1.0, -2.0, -1.0, 0.0, 1.0]).all(|(z, at)| (z - at).abs() < 1e-12)
        );
        let uncertainty = answer.evidence.force_uncertainty().unwrap();
        // All of the largest force, to the digit that is told.
        assert!((uncertainty.relative - 1.0).abs() < 0.5, "{}: {uncertainty:?}", answer.solver);
    }
}
