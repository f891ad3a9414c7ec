//! Sums to twice the digits against whole numbers, and the line of the bars against its angle.

use super::*;

/// A number as a multiple of 2^-80, exactly.
fn units(x: f64) -> i128 {
    let scaled = x * 2.0_f64.powi(80);
    assert!(scaled.fract().abs() <= 0.0 && scaled.abs() < 2.0_f64.powi(126));
    #[expect(clippy::cast_possible_truncation, reason = "a whole number in range, as asserted")]
    let whole = scaled as i128;
    whole
}

#[test]
fn a_turned_sum_is_exact() {
    let part = |k: i64| k as f64 * 2.0_f64.powi(-40);
    // Numbers of 40 bits, whose products need 80.
    let (c, s, x, z) = (659_706_976_665, 879_609_302_221, 1_099_511_627_775, -733_007_751_851);
    for (x, z) in [(x, z), (z, x), (x, x), (-x, z)] {
        let span = [[part(x), 0.0, part(z)], [0.0; 3]];
        let [first, rest] = rotated_sum(span, part(c), part(s));
        let product = |a: i64, b: i64| i128::from(a) * i128::from(b);
        let exact = [product(c, x) + product(s, z), product(c, z) - product(s, x)];
        assert_eq!([0, 2].map(|k| units(first[k]) + units(rest[k])), exact);
        assert!(first[1].abs() <= 0.0 && rest[1].abs() <= 0.0);
        // The rest is below a rounding of the first.
        assert!([0, 2].iter().all(|&k| rest[k].abs() <= f64::EPSILON * first[k].abs()));
    }
    let [_, rest] = rotated_sum([[0.0; 3], [2e-20, 0.0, 1e-20]], 0.6, 0.8);
    assert!((rest[0] - 2e-20).abs() < 1e-34 && (rest[2] + 1e-20).abs() < 1e-34);
}

/// Bars at small angles to a line at 0.4 rad: the first axis is laid along it, to the square of
/// these angles. Bars along an axis, bars that are not nearly parallel stay.
#[test]
fn the_first_axis_is_laid_along_nearly_parallel_bars() {
    let problem = samples::equal_bars(4, 4.0, 1.0, [0.0, 1.0, -0.5]);
    let (links, units) = ScaledChain::new(&problem, crate::run::settings::Motion::Plane);
    let along = |angles: [f64; 4]| -> (f64, f64) {
        let u = angles.map(|a: f64| [a.cos(), 0.0, a.sin()]);
        quarter_turn_to_line(&u, &links, &units)
    };
    let pi = std::f64::consts::PI;
    for line in [0.4_f64, 1.1, -0.7] {
        let (cosine, sine) = along([line + 1e-4, line - 1e-4, line + pi, line]);
        assert!((cosine * line.sin() - sine * line.cos()).abs() < 1e-7, "{line}");
        assert!((cosine.hypot(sine) - 1.0).abs() < 1e-15);
    }
    for stays in
        [[0.4, 0.5, 0.4, 0.3], [1e-4, 0.0, 2e-4, pi], [0.5 * pi, 0.5 * pi, -0.5 * pi, 0.4999 * pi]]
    {
        let (cosine, sine) = along(stays);
        assert!((cosine - 1.0).abs() <= 0.0 && sine.abs() <= 0.0, "{stays:?}");
    }
}

/// Weights in between, by hand: bars of 1, 2, 3 and 4 kg whose centres are in their middles.
#[test]
fn weights_count_from_any_bar() {
    let bars = [(1.0, 1.0, 0.5), (1.0, 2.0, 0.5), (1.0, 3.0, 0.5), (1.0, 4.0, 0.5)];
    let problem = samples::chain(&bars, [0.0, 2.0, 0.0]);
    for (bar, expected) in
        [(0, [0.0, -1.5, -4.0, -7.5]), (1, [1.5, 0.0, -2.5, -6.0]), (3, [7.5, 6.0, 3.5, 0.0])]
    {
        let found = counted_from(&problem, bar);
        for (found, expected) in found.iter().zip(expected) {
            assert!((10.0 * found - expected).abs() < 1e-15, "{bar}: {found}");
        }
    }
}

/// A bar straight down, two without any load between them across a gap as wide as they are long, and
/// a bar straight up. Where the two bear nothing they bridge the gap; where they bear something they
/// are no such bars.
#[test]
fn bars_that_bear_a_force_bridge_no_gap() {
    let bars = [(1.0, 1.0, 0.5), (0.5, 0.0, 0.25), (0.5, 0.0, 0.25), (1.0, 1.0, 0.5)];
    let problem = samples::chain(&bars, [1.0, 0.0, 0.0]);
    let (links, units) = ScaledChain::new(&problem, crate::run::settings::Motion::Plane);
    let links = ScaledChain {
        length: vec![1.0, 0.5, 0.5, 1.0],
        carried: vec![0.35, 0.1, 0.1, -0.15],
        span: [[1.0, 0.0, 0.0], [0.0; 3]],
        up: [0.0, 0.0, 1.0],
        ..links
    };
    let u = vec![[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    for (pull, bridges) in
        [(0.0, true), (0.9e-6, true), (1.1e-6, false), (1e-3, false), (0.6, false), (-0.1, false)]
    {
        let shape = Shape { moments: links.measure(&u), u: u.clone() };
        let multiplier = [pull, 0.0, -0.1];
        let mut point = Point { links: links.clone(), units, shape, multiplier };
        let found = point.straightened(problem.chain());
        assert_eq!(found.is_some(), bridges, "{pull}");
        // Nothing is in doubt, and what they bear is put right.
        assert!(found.is_none_or(|unknown| unknown.abs() <= 0.0));
        let left = if bridges { 0.0 } else { pull };
        assert!((point.multiplier[0] - left).abs() <= 0.0);
        assert!((point.multiplier[2] + 0.1).abs() <= 0.0);
    }
}

/// The same across a gap wider by 2^-44 of their length 1, which is a rounding: the plumb bars, of 1
/// as well, give way by that.
#[test]
fn what_is_missing_is_how_far_plumb_bars_give_way() {
    let wider = 1.0 + 2.0_f64.powi(-44);
    let bars = [(1.0, 1.0, 0.5), (0.5, 0.0, 0.25), (0.5, 0.0, 0.25), (1.0, 1.0, 0.5)];
    let problem = samples::chain(&bars, [wider, 0.0, 0.0]);
    let (links, units) = ScaledChain::new(&problem, crate::run::settings::Motion::Plane);
    let links = ScaledChain {
        length: vec![1.0, 0.5, 0.5, 1.0],
        carried: vec![0.25, 0.0, 0.0, -0.25],
        span: [[wider, 0.0, 0.0], [0.0; 3]],
        up: [0.0, 0.0, 1.0],
        ..links
    };
    let u = vec![[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let shape = Shape { moments: links.measure(&u), u };
    let mut point = Point { links, units, shape, multiplier: [0.0; 3] };
    let unknown = point.straightened(problem.chain()).unwrap();
    assert!((unknown * 2.0_f64.powi(44) - 1.0).abs() < 1e-9, "{unknown}");
}
