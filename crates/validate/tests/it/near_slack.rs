//! Bars without load between two plumb parts of a chain, longer or shorter than the gap that these
//! leave by parts from 0.1 down to one rounding, and by nothing.

use lagrange::condensed::Settings;
use model::{Bar, Problem, Rung};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use validate::Tolerances;

use crate::judged::compare;

const EPSILON: f64 = f64::EPSILON;

/// One or two bars hang from the first anchor and none to two from the last; of two to four without
/// mass between them the lengths are `1 + part` times the gap, as nearly as doubles tell.
fn drawn(random: &mut ChaCha8Rng, part: f64) -> Problem {
    let [first, between, last] =
        [1..=2, 2..=4, 0..=2].map(|range| random.random_range::<usize, _>(range));
    let integers = random.random_range(0..2) == 0;
    let lengths: Vec<f64> = (0..first + between + last)
        .map(|_| {
            if integers {
                f64::from(random.random_range(1..=5))
            } else {
                random.random_range(0.3..2.0)
            }
        })
        .collect();
    let sum = |of: &[f64]| of.iter().sum::<f64>();
    let gap = sum(&lengths[first..first + between]) * (1.0 - part);
    let slope = match random.random_range(0..3) {
        0 => random.random_range(-1.2..1.2),
        _ => 0.0_f64,
    };
    let rise = sum(&lengths[first + between..]) - sum(&lengths[..first]);
    let end_m = [gap * slope.cos(), 0.0, gap * slope.sin() + rise];
    let mass = |k| {
        if (first..first + between).contains(&k) { 0.0 } else { random.random_range(0.2..3.0) }
    };
    let masses: Vec<f64> = (0..lengths.len()).map(mass).collect();
    let bars = lengths.iter().zip(masses).map(|(l, m)| Bar::homogeneous(*l, m).unwrap());
    samples::of_bars(9.81, bars, end_m)
}

/// A part to spare or missing.
fn part(random: &mut ChaCha8Rng) -> f64 {
    let size = match random.random_range(0..8) {
        0 => 0.0,
        1 => EPSILON,
        2 => EPSILON * f64::from(random.random_range(2..=8)),
        _ => 10_f64.powf(random.random_range(-16.0..-1.0)),
    };
    if random.random_range(0..2) == 0 { size } else { -size }
}

/// Both solvers have an answer, know it, and agree on joints, forces and energies; that a bar whose
/// force is a rounding of the largest makes the minimum degenerate, only one of them may say.
#[test]
fn solvers_agree_on_chains_that_are_nearly_slack() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let (mut others, mut undecided) = (Vec::new(), 0);
    for number in 0..1000 {
        let part = part(&mut random);
        let problem = drawn(&mut random, part);
        let lagrange = lagrange::condensed::solve(&problem, &Settings::default()).unwrap();
        let Ok(energy) = energy::minimise(&problem, &energy::Settings::default()) else {
            others.push(format!("{number}, {part:e}: no answer"));
            continue;
        };
        let mut answers = [lagrange.equilibrium, energy.equilibrium];
        let agreement = compare(&problem, &mut answers, &Tolerances::project());
        let known = answers.iter().all(|a| a.evidence.ladder.is_reached(Rung::Converged));
        undecided += usize::from(answers[0].stability.in_plane != answers[1].stability.in_plane);
        if !(agreement.agrees() && known) {
            let residual = answers[1].evidence.residual;
            others.push(format!("{number}, {part:e}: {} {residual:e}", agreement.disagreement));
        }
    }
    println!("{} of 1000 do not agree:\n{}", others.len(), others.join("\n"));
    println!("{undecided} of 1000 are degenerate by one solver alone");
    assert!(others.is_empty());
}
