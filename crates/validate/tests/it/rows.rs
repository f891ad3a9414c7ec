//! One model: a chain is a system, whatever its file is written like.
//!
//! Every chain of the registry and random ones, as a chain, as joints and members, with a load of 0
//! and of 1e-9 kg at a joint (or the least that doubles tell from its bars), and with the joints
//! and members in another order: the same places, forces and rungs.

use lagrange::condensed;
use model::system::{Joint, Member, System, SystemEquilibrium};
use model::{Equilibrium, Problem, Rung, Vector, cases};
use rayon::prelude::*;
use samples::random_chain;
use validate::systems::ask_with;
use validate::{Question, Tolerances, UseCensus};

use crate::judged::compare;

/// Random chains; `CHAINS=10000` tries more of them.
const CHAINS: u64 = 60;

/// How far places and forces may be apart, in units of the length and of the largest force, where
/// the load changes nothing.
const APART: f64 = 1e-12;

/// How the system of a chain is written.
#[derive(Debug, Clone, Copy)]
enum Written {
    /// As the chain.
    Plain,
    /// With a load of so many kg at the middle joint.
    Loaded(f64),
    /// Joints from the last to the first, every second member turned.
    Turned,
}

const WRITTEN: [Written; 4] =
    [Written::Plain, Written::Loaded(0.0), Written::Loaded(1e-9), Written::Turned];

fn written(problem: &Problem, how: Written) -> System {
    let system = System::from(problem.chain());
    let mut joints: Vec<Joint> = system.joints().to_vec();
    let mut members: Vec<Member> = system.members().to_vec();
    let last = joints.len() - 1;
    match how {
        Written::Plain => {}
        Written::Loaded(mass_kg) => {
            // What is lost in the rounding of the heaviest bar is refused.
            let bodies = members.iter().map(|member| member.body.mass_kg());
            let least_kg = 2.0 * f64::EPSILON * bodies.fold(0.0, f64::max);
            let mass_kg = if mass_kg > 0.0 { mass_kg.max(least_kg) } else { mass_kg };
            joints[last.div_ceil(2)].mass_kg = mass_kg;
        }
        Written::Turned => {
            joints.reverse();
            for (k, member) in members.iter_mut().enumerate() {
                (member.from, member.to) = (last - member.from, last - member.to);
                if k % 2 == 1 {
                    let body = &member.body;
                    let centre_m = body.length_m() - body.centre_m();
                    let moments = body.inertia_kg_m2();
                    let turned =
                        model::Bar::new(body.length_m(), body.mass_kg(), centre_m, moments);
                    member.body = turned.unwrap();
                    std::mem::swap(&mut member.from, &mut member.to);
                }
            }
        }
    }
    System::new(system.name(), system.gravity_m_s2(), joints, members).unwrap()
}

/// The places in the order of the chain.
fn places(found: &SystemEquilibrium, how: Written) -> Vec<Vector> {
    let mut places = found.joints_m.clone();
    if matches!(how, Written::Turned) {
        places.reverse();
    }
    places
}

fn largest(vectors: &[Vector]) -> f64 {
    vectors.as_flattened().iter().fold(0.0, |most, x| x.abs().max(most))
}

/// What a way of writing changes of an answer.
fn misses(name: &str, problem: &Problem) -> Vec<String> {
    let question = Question { census: UseCensus::Never, ..Question::default() };
    let lagrange = condensed::solve(problem, &condensed::Settings::default());
    let energy = energy::minimise(problem, &energy::Settings::default());
    let answers =
        [lagrange.ok().map(|one| one.equilibrium), energy.ok().map(|one| one.equilibrium)];
    let mut chain: Vec<Equilibrium> = answers.into_iter().flatten().collect();
    let chain_agrees =
        chain.len() == 2 && compare(problem, &mut chain, &Tolerances::project()).agrees();
    let length_m = problem.chain().total_length_m();
    let mut misses = vec![];
    for how in WRITTEN {
        let system = written(problem, how);
        let found = ask_with(&system, &question, &|_| {});
        if chain_agrees != found.agrees() {
            let said = found.agreement.as_ref().map(|agreement| &agreement.disagreement);
            misses.push(format!(
                "{name}, {how:?}: agrees: {} {said:?} {:?}",
                found.agrees(),
                found.failures
            ));
        }
        for (one, other) in chain.iter().zip(&found.equilibria) {
            // A load of 1e-9 kg moves nothing that a comparison of chains turned about a vertical sees.
            let load = if let Written::Loaded(mass_kg) = how { mass_kg } else { 0.0 };
            let apart = APART + load / problem.chain().total_mass_kg();
            let heights = |places: &[Vector]| places.iter().map(|at| at[2]).collect::<Vec<_>>();
            let off = heights(&one.joints_m)
                .iter()
                .zip(heights(&places(other, how)))
                .fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            let scale = largest(&one.joints_m).max(length_m);
            if matches!(how, Written::Plain | Written::Loaded(0.0))
                && (off.is_nan() || off > apart * scale)
            {
                misses.push(format!("{name}, {how:?}, {}: {off:e} m apart", one.solver));
            }
            let [a, b] = [&one.evidence, &other.evidence].map(model::Evidence::rung);
            if chain_agrees && b < a.min(Some(Rung::Optimal)) {
                misses.push(format!("{name}, {how:?}, {}: {a:?} becomes {b:?}", one.solver));
            }
        }
    }
    misses
}

#[test]
fn a_chain_is_a_system_however_it_is_written() {
    let mut found: Vec<String> =
        cases::all().iter().flat_map(|case| misses(case.name, &case.problem())).collect();
    let count = std::env::var("CHAINS").ok().and_then(|n| n.parse().ok()).unwrap_or(CHAINS);
    let random = (0..count).into_par_iter().flat_map_iter(|seed| {
        let (shape, problem) = random_chain(seed);
        misses(&format!("random {seed}, {shape:?}"), &problem)
    });
    found.extend(random.collect::<Vec<_>>());
    assert!(found.is_empty(), "{}:\n{}", found.len(), found.join("\n"));
}

/// The judge's budgets do not depend on the number of bars: in a hundred thousand of them the pull is
/// many times what acts at a joint.
#[test]
fn a_long_row_agrees() {
    let problem = samples::equal_bars(100_000, 100_000.0, 1e5, [50_000.0, 0.0, -1.0]);
    let question = Question { census: UseCensus::Never, ..Question::default() };
    let found = ask_with(&System::from(problem.chain()), &question, &|_| {});
    let said = found.agreement.as_ref().map(|agreement| &agreement.disagreement);
    assert!(found.agrees(), "{said:?}");
    let rungs: Vec<_> = found.equilibria.iter().map(|one| one.evidence.rung()).collect();
    assert_eq!(rungs, [Some(Rung::Optimal); 2]);
}
