//! What physics gives for free: turn about the vertical, mirror image, reversal, scales.
//!
//! The stable equilibrium of a chain whose anchors are not on one vertical is unique, so that two
//! solves of the same physics must meet.

use lagrange::{Settings, Solution, solve};
use model::{Anchors, Bar, Chain, Problem, Vector};
use proptest::prelude::*;

use crate::common::{distance, problem, stream};

/// Two solves of the same physics agree to a few rounding errors of the data times the condition of
/// the system. Worst of 12,000 cases measured: less than a tenth of this.
const ROUNDING: f64 = 1e-15;

fn solved(problem: &Problem) -> Solution {
    solve(problem, &Settings::default()).unwrap()
}

fn rebuilt(gravity: f64, start_m: Vector, end_m: Vector, bars: Vec<Bar>) -> Problem {
    let anchors = Anchors { start_m, end_m };
    Problem::new(Chain::new("rebuilt", gravity, anchors, bars).unwrap()).unwrap()
}

/// Joints and forces that are expected, in units of the total length and the total weight.
fn assert_same(problem: &Problem, found: &Solution, joints: &[Vector], forces: &[Vector]) {
    let chain = problem.chain();
    let weight = chain.total_mass_kg() * chain.gravity_m_s2();
    let bound = ROUNDING * found.condition;
    let gap = distance(&found.equilibrium.joints_m, joints) / chain.total_length_m();
    assert!(gap <= bound, "joints {gap:e} apart, bound {bound:e}");
    let gap = distance(&found.equilibrium.multipliers_n, forces) / weight;
    assert!(gap <= bound, "forces {gap:e} apart, bound {bound:e}");
}

fn mapped(vectors: &[Vector], map: impl Fn(&Vector) -> Vector) -> Vec<Vector> {
    vectors.iter().map(map).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn turn_about_the_vertical(index in 0..10_000_usize, bars in 2..8_usize, angle in -3.0..3.0) {
        let problem = problem(&mut stream(31, index), bars, false);
        let (sin, cos) = f64::sin_cos(angle);
        let turn = |v: &Vector| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
        let chain = problem.chain();
        let end = turn(&chain.anchors().end_m);
        let turned = rebuilt(chain.gravity_m_s2(), [0.0; 3], end, chain.bars().to_vec());
        let (a, b) = (solved(&problem).equilibrium, solved(&turned));
        assert_same(&turned, &b, &mapped(&a.joints_m, turn), &mapped(&a.multipliers_n, turn));
    }

    #[test]
    fn mirror_image(index in 0..10_000_usize, bars in 2..8_usize) {
        let problem = problem(&mut stream(32, index), bars, false);
        let mirror = |v: &Vector| [-v[0], v[1], v[2]];
        let chain = problem.chain();
        let end = mirror(&chain.anchors().end_m);
        let mirrored = rebuilt(chain.gravity_m_s2(), [0.0; 3], end, chain.bars().to_vec());
        let (a, b) = (solved(&problem).equilibrium, solved(&mirrored));
        assert_same(&mirrored, &b, &mapped(&a.joints_m, mirror), &mapped(&a.multipliers_n, mirror));
    }

    /// Read from the other end: the joints in reverse, the inner forces with it and, as reactions
    /// to what they were, with the other sign; the reactions change places.
    #[test]
    fn reversal(index in 0..10_000_usize, bars in 2..8_usize) {
        let problem = problem(&mut stream(33, index), bars, false);
        let chain = problem.chain();
        let reverse = |bar: &Bar| {
            Bar::new(bar.length_m(), bar.mass_kg(), bar.length_m() - bar.centre_m(), [0.0; 3]).unwrap()
        };
        let anchors = chain.anchors();
        let reversed: Vec<Bar> = chain.bars().iter().rev().map(reverse).collect();
        let reversed = rebuilt(chain.gravity_m_s2(), anchors.end_m, anchors.start_m, reversed);
        let (a, b) = (solved(&problem).equilibrium, solved(&reversed));
        let joints: Vec<Vector> = a.joints_m.iter().rev().copied().collect();
        let mut forces: Vec<Vector> =
            a.multipliers_n.iter().rev().map(|f| [-f[0], -f[1], -f[2]]).collect();
        forces[0] = a.reactions_n.end;
        forces[bars] = a.reactions_n.start;
        assert_same(&reversed, &b, &joints, &forces);
    }
}
