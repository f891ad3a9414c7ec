//! Both solvers against the chain as a conic programme, up to thousands of bars.

use lagrange::condensed;
use model::{Anchors, Bar, Chain, Equilibrium, Problem, Vector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use samples::random_chain;
use validate::Tolerances;
use validate::cables::hold_against_cables;

/// Joints in units of the length. Measured, like forces and energies: 7e-16.
const JOINTS: f64 = 1e-12;

fn solved(problem: &Problem) -> [Equilibrium; 2] {
    [
        condensed::solve(problem, &condensed::Settings::default()).unwrap().equilibrium,
        energy::minimise(problem, &energy::Settings::default()).unwrap().equilibrium,
    ]
}

fn problem(bars: Vec<Bar>, end_m: Vector) -> Problem {
    let anchors = Anchors { start_m: [0.1, 0.2, 0.3], end_m };
    Problem::new(Chain::new("cables", 9.806_65, anchors, bars).unwrap()).unwrap()
}

fn equal(n: usize) -> Problem {
    let bar = Bar::homogeneous(1.5 / n as f64, 1.0 / n as f64).unwrap();
    problem(vec![bar; n], [1.1, 0.2, 0.1])
}

/// Lengths over two orders of magnitude, masses over two, centres anywhere, anchors in space.
fn unequal(n: usize, seed: u64) -> Problem {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let bars: Vec<Bar> = (0..n)
        .map(|_| {
            let length = 10.0_f64.powf(rng.random_range(-1.0..1.0)) / n as f64;
            let mass = 10.0_f64.powf(rng.random_range(-1.0..1.0));
            Bar::new(length, mass, length * rng.random_range(0.0..1.0), [0.0; 3]).unwrap()
        })
        .collect();
    let total = model::sum(bars.iter().map(Bar::length_m));
    problem(bars, [0.1 + 0.5 * total, 0.2 - 0.4 * total, 0.3 + 0.2 * total])
}

#[test]
fn taut_cables_are_the_chain_of_both_solvers() {
    let tolerances = Tolerances::project();
    let chains = [2, 3, 10, 100, 1000].map(equal).into_iter();
    let chains = chains.chain([2, 5, 10, 100, 1000, 5000].map(|n| unequal(n, 9)));
    for problem in chains {
        for found in solved(&problem) {
            let cables = hold_against_cables(&problem, &found).unwrap();
            println!("{:5} {:8} {cables:?}", problem.chain().bars().len(), found.solver);
            assert!(cables.taut && cables.in_tension, "{cables:?}");
            assert!(cables.confirm(&tolerances), "{}: {cables:?}", found.solver);
            assert!(cables.joints.unwrap() <= JOINTS, "{}: {cables:?}", found.solver);
            // A wrong force is not confirmed.
            let mut wrong = found.clone();
            wrong.axial_n[0] *= 1.0 + 1e-6;
            assert!(!hold_against_cables(&problem, &wrong).unwrap().confirm(&tolerances));
        }
    }
}

/// Chains of all hard shapes.
const HARD: u64 = 200;

/// The chains of all hard shapes: whatever is in tension is confirmed, the rest is above the bound.
#[test]
fn the_hard_shapes_against_the_cables() {
    let tolerances = Tolerances::project();
    let found: Vec<_> = (0..HARD)
        .into_par_iter()
        .flat_map_iter(|seed| {
            let (shape, problem) = random_chain(seed);
            solved(&problem).map(|found| {
                let cables = hold_against_cables(&problem, &found).unwrap();
                (format!("{seed}: {shape:?}, {}", found.solver), cables)
            })
        })
        .collect();
    for (what, cables) in &found {
        assert!(cables.confirm(&tolerances), "{what}: {cables:?}");
    }
    let taut = found.iter().filter(|(_, cables)| cables.taut).count();
    let determined = found.iter().filter(|(_, cables)| cables.axial.is_some()).count();
    println!("{taut} of {} taut, {determined} with determined forces", found.len());
    assert!(taut > found.len() / 3 && taut < 2 * found.len() / 3, "{taut} of {}", found.len());
    assert!(determined > found.len() / 2, "{determined} of {}", found.len());
}
