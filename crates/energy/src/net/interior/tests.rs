//! Which cables are slack, by hand.

use model::Vector;

use super::*;
use crate::net::frame::Rod;

const ZERO3: Vector = [0.0; 3];

/// Members side by side between two supports, of these lengths and kinds.
fn interior(rods: &[(f64, Kind)], force: &[f64], slack: &[f64]) -> (Interior, Shape) {
    let x = vec![ZERO3, [1.0, 0.0, 0.0]];
    let rods = rods.iter().map(|&(length, kind)| Rod::straight(0, 1, length, kind)).collect();
    let frame = Frame::of_rods(1, x.clone(), rods);
    let factor = Factor::new(&frame.spots, &frame.rods, &frame.meter).unwrap();
    let shape = Shape { x, force: force.to_vec() };
    let interior = Interior::new(Arc::new(frame), factor, &shape);
    (Interior { slack: slack.to_vec(), ..interior }, shape)
}

/// A cable is slack where its slack, over its length, is more than its force over the mean one.
#[test]
fn cables_are_slack_where_their_slack_is_more_than_their_force() {
    let rods = [(4.0, Kind::Cable), (4.0, Kind::Cable), (0.5, Kind::Cable), (4.0, Kind::Bar)];
    // The mean force is 2. Slack over length: 0.5, 0.5, 0.2, 2; force over the mean: 0.6, 0.4, 0.1,
    // 2.9.
    let (interior, shape) = interior(&rods, &[1.2, 0.8, 0.2, 5.8], &[2.0, 2.0, 0.1, 8.0]);
    let force = interior.settled(&shape).force;
    for (found, expected) in force.iter().zip([1.2, 0.0, 0.0, 5.8]) {
        assert!((found - expected).abs() <= 0.0, "{force:?}");
    }
    // A bar keeps its force, however small.
    let (interior, shape) = self::interior(&rods[2..], &[1.0, 1e-9], &[1e-9, 1.0]);
    assert!((interior.settled(&shape).force[1] - 1e-9).abs() <= 0.0);
}

/// Means by hand: products 2.4, 1.6, 0.02 and 46.4 over four members.
#[test]
fn the_gap_is_the_mean_of_force_times_slack() {
    let rods = [(4.0, Kind::Cable); 4];
    let force = [1.2, 0.8, 0.2, 5.8];
    let (interior, _) = interior(&rods, &force, &[2.0, 2.0, 0.1, 8.0]);
    assert!((interior.gap(&force) - 50.42 / 4.0).abs() < 1e-14);
    // Cables ask for 1e-12 of the mean of force times length, 8, bars for 1e-7 of it.
    for (kind, part) in [(Kind::Cable, 1e-12), (Kind::Bar, 1e-7)] {
        for (size, centred) in [(0.9, true), (1.1, false)] {
            let slack = [4.0 * part * size; 4];
            let (interior, _) = self::interior(&[(4.0, kind); 4], &force, &slack);
            assert_eq!(interior.centred(&force, 1e-4), centred);
            // Nor with a joint out of balance by more than the root of 1e-7.
            assert!(!interior.centred(&force, 4e-4));
        }
    }
}

#[test]
fn parts_of_a_step_end_at_the_boundary() {
    for (step, part) in [
        ([1.0, 2.0], 1.0 / INSIDE),
        ([-1.0, -1.0], 1.0 / INSIDE),
        ([-4.0, 5.0], 0.5),
        ([-4.0, -16.0], 0.25),
    ] {
        assert!((part_inside(&[2.0, 4.0], &step) - part).abs() < 1e-15);
    }
}
