//! Chains some of whose bars carry next to nothing, or that are folded to a millionth of their
//! length: each bar is held against the force that it carries itself, not against the largest of
//! the chain.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use energy::{Error, Settings, Solution, minimise};
use model::{Problem, Rung, Vector};

use crate::support::{difference, energy_unit, problem};

const GRAVITY: f64 = 9.806_65;

/// Largest angle, rad, between a bar and the force that it carries.
fn misaligned(problem: &Problem, solution: &Solution) -> f64 {
    let forces = &solution.equilibrium.multipliers_n[1..];
    let bars = problem.chain().bars().iter().zip(forces).zip(&solution.directions);
    bars.map(|((bar, force), u)| {
        let carried = bar.mass_kg() * GRAVITY * (bar.centre_m() / bar.length_m());
        let f: Vector = [force[0], force[1], force[2] - carried];
        let across =
            [u[1] * f[2] - u[2] * f[1], u[2] * f[0] - u[0] * f[2], u[0] * f[1] - u[1] * f[0]];
        let size = |v: Vector| v[0].hypot(v[1]).hypot(v[2]);
        size(across) / size(f)
    })
    .fold(0.0, f64::max)
}

fn solved(bars: &[(f64, f64, f64)], end_m: Vector) -> (Problem, Solution) {
    let problem = problem(bars, end_m, GRAVITY);
    let solution = minimise(&problem, &Settings::default()).unwrap();
    // Whatever weights are counted from, the energy is that of the centres.
    let height = |joint: usize| solution.equilibrium.joints_m[joint][2];
    let works = bars.iter().enumerate().map(|(i, (_, mass_kg, part))| {
        mass_kg * GRAVITY * (height(i) + part * (height(i + 1) - height(i)))
    });
    let off = (works.sum::<f64>() - solution.equilibrium.energy_j).abs();
    assert!(off < 1e-13 * energy_unit(&problem), "{off:e}");
    (problem, solution)
}

/// Massless bars that are longer than their gap by a part of 5e-9 or 1e-9 carry that part of the
/// weight. The joint between them lies on the line of its neighbours.
#[test]
fn massless_bars_that_just_bridge_their_gap() {
    for (over_m, last_kg) in [(1e-8, 1.0), (2e-9, 5.0)] {
        let bars = [(1.0, 1.0, 0.5), (1.0, 0.0, 0.5), (1.0, 0.0, 0.5), (1.0, last_kg, 0.5)];
        let (problem, solution) = solved(&bars, [2.0 + over_m, 0.0, 0.0]);
        assert!(solution.equilibrium.evidence.ladder.is_reached(Rung::Converged));
        // Measured 2e-8: the world's coordinates hold forces to a rounding of the weight, which is
        // nine orders above what these bars carry.
        let angle = misaligned(&problem, &solution);
        assert!(angle < 1e-6, "{angle:e}");
        let joints = &solution.equilibrium.joints_m;
        for k in 0..3 {
            let middle = 0.5 * (joints[1][k] + joints[3][k]);
            assert!((joints[2][k] - middle).abs() < 1e-12, "{joints:?}");
        }
        // The outer bars give way by what the inner ones lack, in the ratio of one over their
        // weights.
        let parts = [joints[1][0], 2.0 + over_m - joints[3][0]];
        assert!((parts[0] + parts[1] - over_m).abs() < 1e-15);
        assert!((parts[0] - last_kg * parts[1]).abs() < 1e-6 * over_m, "{parts:?}");
    }
}

/// Bars that bridge a gap exactly, and carry nothing: right angles of integers.
#[test]
fn bars_that_exactly_bridge_a_gap_and_carry_nothing() {
    type Case<'a> = (&'a [(f64, f64, f64)], Vector, &'a [Vector]);
    let cases: [Case; 4] = [
        // All weight is plumb below the first anchor, and 5 m and 1 m reach from it to the other
        // one.
        (
            &[(1.0, 3.0, 1.0), (5.0, 2.0, 0.0), (1.0, 0.0, 0.25)],
            [6.0, 0.0, -1.0],
            &[[0.0, 0.0, -1.0], [5.0, 0.0, -1.0]],
        ),
        // 2 m and 3 m reach to where the weight is plumb below the last anchor: 3, 4, 5.
        (
            &[(2.0, 0.0, 0.5), (3.0, 3.0, 1.0), (1.0, 0.0, 0.75)],
            [3.0, 0.0, 5.0],
            &[[1.2, 0.0, 1.6], [3.0, 0.0, 4.0]],
        ),
        // One level bar reaches to it; it is heavy, and the plumb bars carry its end.
        (
            &[(2.0, 2.0, 0.25), (1.0, 2.0, 0.75), (5.0, 0.0, 0.5), (1.0, 1.0, 0.75)],
            [2.0, 0.0, 7.0],
            &[[2.0, 0.0, 0.0], [2.0, 0.0, 1.0], [2.0, 0.0, 6.0]],
        ),
        (
            &[(1.0, 0.0, 0.0), (1.0, 1.0, 0.5), (3.0, 3.0, 0.5)],
            [1.0, 0.0, 4.0],
            &[[1.0, 0.0, 0.0], [1.0, 0.0, 1.0]],
        ),
    ];
    for (bars, end_m, joints) in cases {
        let (_, solution) = solved(bars, end_m);
        assert!(solution.equilibrium.evidence.ladder.is_reached(Rung::Converged));
        let found = &solution.equilibrium.joints_m;
        for (found, exact) in found[1..].iter().zip(joints) {
            assert!(difference(*found, *exact) < 1e-13, "{found:?} {exact:?}");
        }
    }
}

/// Masses from 1e12 kg to 1 g: the light bars hang from the end of the heavy one as if it were
/// an anchor.
#[test]
fn light_bars_hang_from_a_heavy_one() {
    let light = [(1.0, 1.0, 0.5), (1.0, 1.0, 0.5), (1.0, 1e-3, 0.5)];
    let bars = [(1.0, 1e12, 0.5), light[0], light[1], light[2]];
    let end_m = [1.5, 0.0, -0.5];
    let (whole, solution) = solved(&bars, end_m);
    let angle = misaligned(&whole, &solution);
    assert!(angle < 1e-9, "{angle:e}");
    let joints = &solution.equilibrium.joints_m;
    assert!(difference(joints[1], [0.0, 0.0, -1.0]) < 1e-11);
    let (_, alone) = solved(&light, [end_m[0], 0.0, end_m[2] + 1.0]);
    for (joint, other) in joints[1..].iter().zip(&alone.equilibrium.joints_m) {
        let lowered = [other[0], other[1], other[2] - 1.0];
        assert!(difference(*joint, lowered) < 1e-10, "{joint:?} {lowered:?}");
    }
}

/// The same where the minimiser leaves the light bars anywhere: 14 orders, and twice 7 of them, in
/// which the second part hangs from the first as from an anchor. Bars that a heavy one stretches
/// are on one line with it.
#[test]
fn light_bars_are_minimised_by_themselves() {
    let light = [(2.0, 2.5, 0.5), (0.6, 1.3, 0.2), (1.7, 2.8, 0.7), (1.8, 1.0, 0.4)];
    let end_m = [0.146_703_5, 0.0, -0.566_608_6];
    for heavy_kg in [1e11, 1.3e14, 5e15] {
        let bars = [light[0], light[1], light[2], light[3], (0.98, heavy_kg, 0.3)];
        let (_, whole) = solved(&bars, end_m);
        assert!(whole.equilibrium.evidence.ladder.is_reached(Rung::Converged));
        let (_, alone) = solved(&light, [end_m[0], 0.0, end_m[2] - 0.98]);
        let joints = whole.equilibrium.joints_m.iter().zip(&alone.equilibrium.joints_m);
        for (joint, other) in joints {
            assert!(difference(*joint, *other) < 1e-10, "{heavy_kg}: {joint:?} {other:?}");
        }
    }
    let bars = [(1.0, 1e14, 0.5), (1.2, 3e7, 0.5), light[2], light[0], light[1]];
    let (_, whole) = solved(&bars, [1.5, 0.0, -1.0]);
    let (_, alone) = solved(&bars[2..], [1.5, 0.0, 1.2]);
    for (joint, other) in whole.equilibrium.joints_m[2..].iter().zip(&alone.equilibrium.joints_m) {
        let lowered = [other[0], other[1], other[2] - 2.2];
        assert!(difference(*joint, lowered) < 1e-6, "{joint:?} {lowered:?}");
    }
}

/// Nine bars, masses over eleven orders of magnitude.
#[test]
fn masses_over_eleven_orders() {
    let bars = [
        (1.081_259_322_577_131, 0.893_184_373_660_433, 0.648),
        (0.641_523_355_340_186, 1.683_512_995_696_769_6, 0.217),
        (0.571_418_069_962_305_7, 343_256.413_596_276_6, 0.568),
        (1.126_789_371_136_16, 0.003_333_774_284_791_184, 0.387),
        (1.251_823_869_778_012_6, 1.280_127_927_792_231_8e-5, 0.373),
        (0.657_624_177_204_464, 5.592_039_501_976_009e-6, 0.366),
        (0.843_655_498_011_039_3, 308.859_013_925_956_96, 0.244),
        (1.787_347_532_422_591, 1.292_732_100_827_836e-6, 0.412),
        (1.650_814_363_909_755_9, 1.425_079_372_503_757_2e-6, 0.405),
    ];
    let (problem, solution) = solved(&bars, [-1.242_153_239_056_932_8, 0.0, 2.328_793_451_647_824]);
    let angle = misaligned(&problem, &solution);
    assert!(angle < 1e-5, "{angle:e}");
    assert!(solution.equilibrium.evidence.residual < 1e-15);
}

/// Two bars over anchors that are near: a triangle, whose forces are known in closed form. Of an angle between the bars the
/// directions leave the digits of its square.
#[test]
fn two_bars_over_near_anchors() {
    for exponent in [-2.0, -3.0, -4.0_f64] {
        for (slope, second_kg) in [(0.3_f64, 2.0), (0.927_295_218_001_612, 2.0), (-1.2, 0.4)] {
            let span = 2.0 * 10.0_f64.powf(exponent);
            let (s, c) = slope.sin_cos();
            let bars = [(1.0, 1.0, 0.5), (1.0, second_kg, 0.5)];
            let (_, solution) = solved(&bars, [span * c, 0.0, span * s]);
            // The joint lies half way along the span, and below it at right angles. Its load is
            // half the weight, 1.5 W; each bar bears (load along the height / 2 depth -+ load along
            // the span / span).
            let depth = (1.0 - 0.25 * span * span).sqrt();
            let load = 0.5 * (1.0 + second_kg) * GRAVITY;
            let (down, along) = (0.5 * load * c / depth, load * s / span);
            for (axial, expected) in
                solution.equilibrium.axial_n.iter().zip([down - along, down + along])
            {
                let error = (axial - expected).abs() / (down.abs() + along.abs());
                assert!(
                    error < 4.0 * f64::EPSILON / (span * span),
                    "{exponent} {slope}: {axial} {expected} {error:e}"
                );
            }
        }
    }
}

/// Anchors 3e-14 of the length off one vertical, and a chain with bars that carry nothing.
#[test]
fn nearly_upright_and_with_free_bars() {
    let bars = [
        (1.897_752_643_005_655_5, 1.444_571_075_835_585_9, 0.670_475_76),
        (0.966_275_296_485_222_6, 1.303_310_694_514_061_8, 0.127_402_76),
        (0.519_958_582_824_903_8, 2.208_322_628_172_228, 0.459_848_97),
    ];
    let (problem, solution) =
        solved(&bars, [7.988_872_883_551_471e-14, 0.0, -2.344_069_907_932_715]);
    assert!(misaligned(&problem, &solution) < 1e-9);
    assert_eq!(solution.equilibrium.stability.index_in_space, 0);

    let bars = [(2.0, 2.0, 0.5), (5.0, 0.0, 1.0), (1.0, 3.0, 1.0), (2.0, 0.0, 0.25)];
    let (_, solution) = solved(&bars, [0.0, 0.0, 4.0]);
    assert!(solution.equilibrium.evidence.ladder.is_reached(Rung::Converged));
    assert!(solution.equilibrium.evidence.residual < 1e-12);
}

/// A refusal says which of its conditions failed: here the curvature, not the gradient.
#[test]
fn a_refusal_names_what_failed() {
    let bars = [
        (1.255_500_362_663_090_5, 7.805_452_528_333_197_5, 0.114_724),
        (0.918_664_539_097_505, 0.204_380_921_938_253_83, 0.591_57),
        (0.880_385_837_988_994_8, 572_155.469_951_994_1, 0.948_97),
        (0.850_706_456_640_535_1, 0.009_278_828_755_431_25, 0.580_59),
        (0.811_059_445_842_767_1, 1.621_280_197_991_939_7e-5, 0.685_28),
        (0.620_975_569_135_896_4, 1_817.226_516_908_178, 0.921_77),
        (0.784_565_322_973_510_9, 4.389_229_361_613_876_6e-5, 0.871_39),
        (1.699_795_884_392_443_2, 0.001_789_164_926_882_817_9, 0.524_79),
        (0.589_429_595_141_301_2, 30.990_498_634_949_69, 0.599_60),
    ];
    let end_m = [1.351_531_009_109_534_3, 0.0, 0.487_688_159_224_655_36];
    let problem = problem(&bars, end_m, GRAVITY);
    match minimise(&problem, &Settings::default()) {
        // Solved, every bar lies along its force.
        Ok(solution) => assert!(misaligned(&problem, &solution) < 1e-6),
        Err(Error::NoDescent { gradient, directions, .. }) => {
            assert!(gradient > 1e-12 || directions > 0, "{gradient:e} {directions}");
        }
        Err(other) => panic!("{other}"),
    }
}
