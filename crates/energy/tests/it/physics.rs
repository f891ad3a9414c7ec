//! What physics gives for free.

use energy::{Settings, Solution, minimise};
use model::{Anchors, Bar, Chain, Problem, Vector};
use proptest::prelude::*;

use crate::support::difference;

/// Length, mass, part of the length at which the centre lies.
type Raw = (f64, f64, f64);

#[derive(Debug, Clone)]
struct Case {
    bars: Vec<Raw>,
    end: Vector,
    gravity: f64,
}

/// Chains that neither a rounding nor a thousand of them can bring near to straight.
fn cases() -> impl Strategy<Value = Case> {
    let bar = (0.5..2.0, prop_oneof![1 => Just(0.0), 5 => 0.1..3.0], 0.0..1.0);
    (prop::collection::vec(bar, 3..9), 0.1..0.9, -1.0..1.0, 0.0..6.2, 1.0..20.0).prop_filter_map(
        "needs mass",
        |(bars, part, z, angle, gravity): (Vec<Raw>, f64, f64, f64, f64)| {
            let total: f64 = bars.iter().map(|b| b.0).sum();
            let longest = bars.iter().fold(0.0_f64, |m, b| m.max(b.0));
            let least = (2.0 * longest - total).max(0.0);
            let span = least + part * (total - least);
            let r = (1.0 - z * z).sqrt();
            let end = [r * angle.cos(), r * angle.sin(), z].map(|x: f64| span * x);
            bars.iter().any(|b| b.1 > 0.0).then_some(Case { bars, end, gravity })
        },
    )
}

impl Case {
    fn problem(&self) -> Problem {
        let bar = |&(l, m, r): &(f64, f64, f64)| {
            Bar::new(l, m, (r * l).min(l), [0.0; 3]).expect("a valid bar")
        };
        samples::of_bars(self.gravity, self.bars.iter().map(bar), self.end)
    }

    fn solve(&self) -> Solution {
        minimise(&self.problem(), &Settings::default()).expect("converges")
    }

    fn length(&self) -> f64 {
        self.bars.iter().map(|b| b.0).sum()
    }

    fn weight(&self) -> f64 {
        self.gravity * self.bars.iter().map(|b| b.1).sum::<f64>()
    }
}

/// Largest differences of joints over the length and of forces over the weight, after mapping both.
fn compare(
    case: &Case,
    (a, b): (&Solution, &Solution),
    joint: impl Fn(Vector) -> Vector,
    force: impl Fn(Vector) -> Vector,
) -> (f64, f64) {
    let (a, b) = (&a.equilibrium, &b.equilibrium);
    // An equilibrium does not say where a joint between two bars without force is.
    let held = |k: usize| {
        let bars = [k.checked_sub(1), Some(k)].map(|bar| bar.and_then(|bar| a.axial_n.get(bar)));
        bars.iter().any(|force| force.is_none_or(|n| n.abs() > NO_FORCE * case.weight()))
    };
    let joints = a.joints_m.iter().zip(&b.joints_m).enumerate().filter(|(k, _)| held(*k));
    let joints = joints.map(|(_, (p, q))| difference(joint(*p), *q)).fold(0.0, f64::max);
    let forces = a.multipliers_n.iter().zip(&b.multipliers_n);
    let forces = forces.map(|(p, q)| difference(force(*p), *q)).fold(0.0, f64::max);
    (joints / case.length(), forces / case.weight())
}

/// A force below this part of the weight counts as zero.
const NO_FORCE: f64 = 1e-12;

/// The worst of 21,000 chains stayed below 2e-14 (3,000 per property); the rest is room for the
/// worst-conditioned one of those to come.
const TOLERANCE: f64 = 1e-12;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn turning_the_anchors_about_the_vertical_turns_the_chain(case in cases(), angle in 0.0..6.2_f64) {
        let (s, c) = angle.sin_cos();
        let turn = |v: Vector| [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]];
        let turned = Case { end: turn(case.end), ..case.clone() };
        let (joints, forces) = compare(&case, (&case.solve(), &turned.solve()), turn, turn);
        prop_assert!(joints < TOLERANCE && forces < TOLERANCE, "{joints:e} {forces:e}");
    }

    #[test]
    fn the_mirror_image_of_the_anchors_has_the_mirror_image_of_the_chain(case in cases()) {
        let mirror = |v: Vector| [-v[0], v[1], v[2]];
        let image = Case { end: mirror(case.end), ..case.clone() };
        let (joints, forces) = compare(&case, (&case.solve(), &image.solve()), mirror, mirror);
        prop_assert!(joints < TOLERANCE && forces < TOLERANCE, "{joints:e} {forces:e}");
    }

    #[test]
    fn a_chain_read_from_its_other_end_is_the_same_chain(case in cases()) {
        let bars = case.bars.iter().rev().map(|&(l, m, r)| (l, m, 1.0 - r)).collect();
        let back = Case { bars, end: case.end.map(|x| -x), ..case.clone() };
        let (a, mut b) = (case.solve(), back.solve());
        // The other anchor was its origin, and the force between two bars acts on the other one.
        let n = case.bars.len();
        b.equilibrium.joints_m.reverse();
        b.equilibrium.multipliers_n.reverse();
        for k in 1..n {
            b.equilibrium.multipliers_n[k] = b.equilibrium.multipliers_n[k].map(|x| -x);
        }
        let to_end = |v: Vector| std::array::from_fn(|k| v[k] - case.end[k]);
        let (joints, forces) = compare(&case, (&a, &b), to_end, |f| f);
        prop_assert!(joints < TOLERANCE && forces < TOLERANCE, "{joints:e} {forces:e}");
    }

    #[test]
    fn moving_both_anchors_moves_the_chain(case in cases(), by in prop::array::uniform3(-5.0..5.0_f64)) {
        let problem = case.problem();
        let chain = problem.chain();
        let moved = |v: Vector| -> Vector { std::array::from_fn(|k| v[k] + by[k]) };
        let anchors = Anchors { start_m: by, end_m: moved(case.end) };
        let there = Chain::new("there", case.gravity, anchors, chain.bars().to_vec()).unwrap();
        let there = minimise(&Problem::new(there).unwrap(), &Settings::default()).unwrap();
        let here = case.solve();
        let (joints, forces) = compare(&case, (&here, &there), moved, |f| f);
        prop_assert!(joints < TOLERANCE && forces < TOLERANCE, "{joints:e} {forces:e}");
        // Energy counts from joint 0.
        let energy = (there.equilibrium.energy_j - here.equilibrium.energy_j).abs();
        prop_assert!(energy / (case.weight() * case.length()) < 1e-12);
    }

    #[test]
    fn the_energy_is_that_of_the_centres_of_weight(case in cases()) {
        let found = case.solve().equilibrium;
        let energy: f64 = case.bars.iter().enumerate().map(|(i, &(_, m, r))| {
            let (p, q) = (found.joints_m[i][2], found.joints_m[i + 1][2]);
            m * case.gravity * (p + r * (q - p))
        }).sum();
        prop_assert!((found.energy_j - energy).abs() / (case.weight() * case.length()) < 1e-13);
    }
}
