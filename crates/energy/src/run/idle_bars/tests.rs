//! Bars that are bent, and gaps that they bridge, by hand.

use model::{Anchors, Bar};

use super::*;

const UP: model::Vector = [0.0, 0.0, 1.0];

/// Bars of 5, 3 and 1 that are longer than a line of 8, 7 or 4 by 1, 2 and 5: the first one makes a
/// triangle with the other two, which stay in line.
#[test]
fn bars_are_bent_at_their_first_joint() {
    for gap in [8.0, 7.0, 4.0] {
        for line in [[1.0, 0.0, 0.0], [0.8, 0.0, 0.6], [-0.6, 0.0, 0.8], [0.0, 0.0, 1.0]] {
            let length = [5.0, 3.0, 1.0];
            let mut u = [line; 3];
            bend(&mut u, &length, (9.0 - gap) / 9.0, UP);
            let end = u.iter().zip(length).fold([0.0; 3], |sum, (u, l)| along(sum, l, *u));
            assert!(norm(along(end, -gap, line)) < 1e-14, "{gap} {line:?}");
            assert!(norm(along(u[1], -1.0, u[2])) <= 0.0);
            // Carnot: 25 + gap² - 16 = 2 . 5 gap cos.
            let cosine = (9.0 + gap * gap) / (10.0 * gap);
            assert!((dot(u[0], line) - cosine).abs() < 1e-14);
            // Below the line.
            let rise = dot(u[0], UP) - cosine * dot(line, UP);
            assert!(rise < 0.0 || line[2] > 0.99, "{gap} {line:?}");
            assert!(u.iter().all(|u| (norm(*u) - 1.0).abs() < 1e-15));
        }
    }
}

fn chain(lengths: &[f64], start_m: model::Vector, end_m: model::Vector) -> Chain {
    let bars = lengths.iter().map(|length| Bar::homogeneous(*length, 1.0).unwrap()).collect();
    Chain::new("gap", 9.81, Anchors { start_m, end_m }, bars).unwrap()
}

/// Bars of 2 and 3 between one plumb bar down and one up, both of 1: the gap is that of the
/// anchors. Of R = 5 and a gap g = 4 the part is 1/5.
#[test]
fn slack_is_a_part_of_the_bars_that_bridge() {
    let slack_of = |end_m: model::Vector, rises: [bool; 4]| {
        let from = [7.0, -1.0, 2.0];
        let end_m = [0, 1, 2].map(|k| from[k] + end_m[k]);
        slack(&chain(&[1.0, 2.0, 3.0, 1.0], from, end_m), &(1..3), &rises)
    };
    let valley = [false, false, false, true];
    assert!((slack_of([4.0, 0.0, 0.0], valley) - 0.2).abs() < 1e-15);
    assert!((slack_of([0.0, 2.4, 3.2], valley) - 0.2).abs() < 1e-15);
    assert!(slack_of([5.0, 0.0, 0.0], valley).abs() <= 0.0);
    assert!(slack_of([3.0, 0.0, -4.0], valley).abs() <= 0.0);
    assert!((slack_of([6.0, 0.0, 0.0], valley) + 0.2).abs() < 1e-15);
    // Both down: of the height -4 the plumb bars take 2, and 2 are left beside 1.5 across.
    let down = [false; 4];
    assert!((slack_of([1.5, 0.0, -4.0], down) - 0.5).abs() < 1e-15);
    assert!((slack_of([1.5, 0.0, 4.0], [true; 4]) - 0.5).abs() < 1e-15);
}
