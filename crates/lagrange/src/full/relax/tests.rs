//! The slope of the merit, by a second reading.

use super::*;
use crate::full::mechanism::{Mechanism, Units};

/// Where a step lifts the weights and closes the gap, and there are no multipliers, the penalty is
/// twice what lets the merit stand still: it falls by as much as the weights rise.
#[test]
fn the_penalty_is_twice_what_lifts_the_weights() {
    let problem = model::cases::paper();
    let chain = problem.chain();
    let mechanism = Mechanism::scaled(chain, Units::total(chain));
    let mut lifted = 0;
    for k in 0..40 {
        let mut chain = Reduced::new(mechanism.clone(), 0.1);
        let angle = |bar: u32| 0.4 + 2.1 * (f64::from(k) * 0.7 + f64::from(bar) * 1.9).sin();
        chain.start(&[0, 1, 2].map(|bar| [0.2, 1.3, angle(bar)]));
        chain.choose_unit();
        let gap = chain.here.closure.norm();
        viscous_step(&mut chain, 1.0, gap);
        chain.here.pull = -chain.matrix.pull_step;
        let moves: Vec<Vector3<f64>> = chain.matrix.moves().collect();
        let work: f64 = moves.iter().zip(&chain.carried).map(|(v, weight)| v.z * weight).sum();
        let end = moves[0] + moves[1] + moves[2];
        let closing = -(end.x * chain.here.closure.x
            + end.y * chain.here.closure.y
            + end.z * chain.here.closure.z)
            / gap;
        if work >= 0.0 || closing <= 0.0 {
            continue;
        }
        lifted += 1;
        let mut penalty = 0.0;
        let found = slope(&chain, &mut penalty, gap);
        assert!((penalty * closing + 2.0 * work).abs() < 1e-12 * work.abs(), "{k}");
        assert!((found - work).abs() < 1e-12 * work.abs(), "{k}");
        // One that is larger stays.
        let mut larger = 3.0 * penalty;
        let found = slope(&chain, &mut larger, gap);
        assert!((larger - 3.0 * penalty).abs() <= 0.0);
        assert!((found - 5.0 * work).abs() < 1e-11 * work.abs());
    }
    assert!(lifted >= 5, "{lifted}");
}
