//! Weights counted from a bar, and bars that bridge a gap.

use super::*;

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
