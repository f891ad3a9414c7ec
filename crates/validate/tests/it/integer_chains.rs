//! Chains of small integers: the numbers that people try first, and the ones on which bars fit into
//! straight lines, close gaps exactly, and carry nothing.
//!
//! `CHAINS=3000 cargo test --release -p validate --test it integer -- --nocapture` tries more of
//! them, and lists those that do not agree.

use model::system::{System, SystemEquilibrium};
use model::{Anchors, Bar, Chain, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use validate::systems::{ask, ask_with};
use validate::{Question, Solvers, UseCensus};

/// Two to eight bars with lengths of 1 to 5 m and masses of 0 to 3 kg, their centres at quarters.
fn drawn(seed: u64) -> Option<Problem> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let count = random.random_range(2..=8);
    let mut far = 0;
    let bars: Vec<Bar> = (0..count)
        .map(|_| {
            let length: i32 = random.random_range(1..=5);
            far += length;
            let length_m = f64::from(length);
            let mass_kg = f64::from(random.random_range(0..=3));
            let centre_m = length_m * f64::from(random.random_range(0..=4)) / 4.0;
            Bar::new(length_m, mass_kg, centre_m, [0.0; 3]).unwrap()
        })
        .collect();
    let [x, z] = [0..=far, -far..=far].map(|range| f64::from(random.random_range(range)));
    let end_m = [x, 0.0, z];
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    // What is no equilibrium problem is refused.
    Problem::new(Chain::new("integers", model::STANDARD_GRAVITY_M_S2, anchors, bars).ok()?).ok()
}

/// What is known of a chain on which the solvers do not agree, the census included.
fn what_speaks_against(problem: &Problem) -> String {
    let answer = ask(&System::from(problem.chain()), Solvers::Both, &|_| {});
    let mut told: Vec<String> = answer.failures.iter().map(ToString::to_string).collect();
    told.extend(answer.agreement.iter().map(|agreement| agreement.disagreement.to_string()));
    for found in &answer.equilibria {
        let SystemEquilibrium { solver, joints_m, axial_n, evidence, .. } = found;
        told.push(format!("{solver}: {joints_m:?} {axial_n:?} {:?}", evidence.ladder.verified));
    }
    let bars = problem.chain().bars().iter().map(|b| (b.length_m(), b.mass_kg(), b.centre_m()));
    told.push(format!("{:?} {:?}", problem.chain().anchors().end_m, bars.collect::<Vec<_>>()));
    told.join("\n    ")
}

#[test]
fn both_solvers_agree_on_chains_of_small_integers() {
    let count: u64 = std::env::var("CHAINS").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let found: Vec<_> = (0..count)
        .into_par_iter()
        .filter_map(|seed| {
            let problem = drawn(seed)?;
            let question = Question { census: UseCensus::Never, ..Question::default() };
            let answer = ask_with(&System::from(problem.chain()), &question, &|_| {});
            let why = (!answer.agrees()).then(|| what_speaks_against(&problem));
            Some((seed, why))
        })
        .collect();
    println!("{} chains", found.len());
    let others: Vec<_> =
        found.iter().filter_map(|(seed, why)| Some((seed, why.as_ref()?))).collect();
    for (seed, why) in &others {
        println!("{seed}: {why}");
    }
    assert!(others.is_empty());
}
