//! Problems at the edge of what is allowed: an answer or an error, never a panic, a NaN or an
//! endless loop.

use lagrange::{Settings, Solution, condensed, constraint_matrix, jacobian, solve};
use model::{Anchors, Bar, Chain, InPlane, InSpace, Problem};
use nalgebra::DVector;

use crate::common::{problem, stream};
use crate::judge::judge;

/// Lengths, closure, force, moment and energy, in units of the largest force and the total length:
/// the tolerance of the solver. Worst measured: 2e-14, the moment on a bar of a nearly straight
/// chain.
const BALANCE: f64 = 1e-13;

/// The stable equilibrium between the origin and `end_m`, judged by Newton's laws.
fn solved(end_m: [f64; 3], bars: Vec<Bar>) -> Solution {
    judged(&samples::of_bars(9.81, bars, end_m))
}

fn judged(problem: &Problem) -> Solution {
    let found = solve(problem, &Settings::default()).unwrap();
    let judgement = judge(problem, &found.equilibrium);
    assert!(judgement.within(BALANCE), "{judgement:?}");
    assert_eq!(found.equilibrium.stability.in_space, InSpace::Stable);
    assert!(found.condition.is_finite() && found.condition >= 1.0);
    // No configuration has less energy than the one that the condensed equations find. The forces
    // multiply the rounding of the closure.
    let lowest = condensed::solve(problem, &condensed::Settings::default()).unwrap().equilibrium;
    let forces = lowest.multipliers_n.iter().flatten();
    let largest = forces.fold(0.0_f64, |largest, force| largest.max(force.abs()));
    let unit = largest * problem.chain().total_length_m();
    let above = (found.equilibrium.energy_j - lowest.energy_j) / unit;
    assert!(above.abs() <= BALANCE, "above the lowest by {above:e}");
    assert_eq!(found.equilibrium.stability, lowest.stability);
    found
}

fn bar(length: f64, mass: f64) -> Bar {
    Bar::homogeneous(length, mass).unwrap()
}

/// A V, both ends at one point, massless bars and points of weight, very different bars, at and near to the span at
/// which bars can fold flat and forces are indeterminate, and many bars.
#[test]
fn chains_of_all_sorts_hang() {
    let at_end = |mass: f64, at: f64| Bar::new(1.0, mass, at, [0.0; 3]).unwrap();
    let alike = |n: usize| vec![bar(1.0, 1.0); n];
    for (end_m, bars) in [
        ([1.0, 0.0, 0.0], alike(2)),
        ([0.0; 3], alike(3)),
        ([0.0; 3], vec![bar(1.0, 1.0), bar(0.7, 2.0), bar(1.1, 0.5), bar(0.3, 1.0)]),
        ([1.0, 0.0, 0.2], vec![bar(1.0, 0.0), bar(1.0, 1.0), bar(1.0, 0.0)]),
        ([1.0, 0.5, 0.0], vec![at_end(1.0, 1.0), at_end(0.0, 0.5), at_end(2.0, 0.0)]),
        ([0.3, 0.4, 0.1], vec![bar(1e-3, 1e3), bar(1.0, 1e-3), bar(1e-2, 1.0), bar(0.7, 1e-6)]),
        ([0.0, 0.0, -0.999_999], alike(3)),
        ([0.0, 0.0, -1.0], alike(3)),
        ([0.0, 0.0, -1.000_000_1], alike(3)),
        ([0.5, 0.0, 0.2], vec![bar(5e-4, 1e-3); 2000]),
    ] {
        let upright = end_m[..2] == [0.0; 2];
        let turns = bars.len() + usize::from(upright);
        assert_eq!(solved(end_m, bars).nullity, turns, "{end_m:?}");
    }
}

#[test]
fn nearly_taut_chains_pull_hard() {
    for slack in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let span = 4.0 * (1.0 - slack);
        let found = solved([span, 0.0, 0.0], vec![bar(1.0, 1.0); 4]);
        // Outer bars at the slope a, inner at b: H tan a = 3/2 mg, H tan b = 1/2 mg, and they
        // shorten the span by a² + b² = 4 slack, up to higher order; the span itself is known to a
        // rounding error, and so is the slack.
        let b = (0.4 * slack).sqrt();
        let pull = 0.5 * 9.81 / b;
        let got = found.equilibrium.multipliers_n[2][0];
        let bound = 4.0 * slack + 2.0 * f64::EPSILON / slack;
        assert!((got / pull - 1.0).abs() < bound, "{got} instead of {pull}, slack {slack}");
        // In any direction.
        solved([0.6 * span, 0.0, 0.8 * span], vec![bar(1.0, 1.0); 4]);
        solved([0.0, 0.0, -span], vec![bar(1.0, 1.0); 4]);
        solved([0.0, 0.0, span], vec![bar(1.0, 1.0); 4]);
    }
}

/// Massless bars beyond the last weight carry nothing and lie where they like.
#[test]
fn unloaded_bars() {
    for bars in [3, 4] {
        let mut chain = vec![bar(1.0, 0.0); bars];
        chain[0] = bar(1.0, 1.0);
        for end_m in [[0.0, 0.0, -2.0], [0.3, 0.0, -2.0], [1.0, 0.0, 0.0]] {
            let found = solved(end_m, chain.clone());
            let axial = &found.equilibrium.axial_n;
            assert!(
                (axial[0] - 0.5 * 9.81).abs() < 1e-12,
                "half of the weight at joint 1: {axial:?}"
            );
            assert!(axial[1..].iter().all(|force| force.abs() < 1e-12), "{axial:?}");
            let degenerate = found.equilibrium.stability.in_plane == InPlane::Degenerate;
            assert_eq!(degenerate, bars == 4, "three unloaded bars can move, two cannot");
        }
    }
}

#[test]
fn a_hundred_bars() {
    let found = judged(&samples::homogeneous(1.0, &[(0.04, 0.04); 100], [1.0, 0.0, 2.0]));
    assert_eq!(found.nullity, 100);
    // The continuous catenary from height 0 to 2 over a span of 1 with length 4 pulls with
    // 0.1636975295 (closed form); n bars differ from it by a part in n².
    let pull = found.equilibrium.multipliers_n[50][0];
    assert!((pull - 0.163_697_529_5).abs() < 1e-3, "{pull}");
}

#[test]
fn random_chains_short_and_long() {
    for (index, bars) in (2..=30).chain([60; 4]).enumerate() {
        for vertical in [false, true] {
            judged(&problem(&mut stream(71, 2 * index + usize::from(vertical)), bars, vertical));
        }
    }
}

/// A chain of one bar is no equilibrium problem, and its equations can be written down all the
/// same.
#[test]
fn equations_of_a_single_bar() {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
    let chain = Chain::new("one", 9.81, anchors, vec![bar(1.0, 1.0)]).unwrap();
    let (q, lambda) = (DVector::zeros(6), DVector::zeros(6));
    assert_eq!(constraint_matrix(&chain, &q).shape(), (6, 6));
    assert_eq!(jacobian(&chain, &q, &lambda).shape(), (12, 12));
}
