//! Steps that are too short and too long, by hand.

use std::num::NonZeroUsize;

use super::*;
use crate::condensed::kernel::Bars;
use crate::condensed::parallel::Workers;
use crate::condensed::system::Frame;

/// Two bars of length 1 that pull with 3 across and 4 up and down where they span 1.2.
fn search(off: f64, part: f64) -> (Option<f64>, usize) {
    let system = System {
        parts: [Bars { lengths: &[1.0], loads: &[-4.0] }, Bars { lengths: &[1.0], loads: &[4.0] }],
        strut: 0.0,
        frame: Frame::Upright { across: 1.2, rise: 0.0 },
        total_length: 2.0,
        workers: Workers::new(NonZeroUsize::MIN, 2),
    };
    let force = [3.0 + off, 0.0];
    let root = Root { force, closure: system.closure(force), contraction: 0.0 };
    let mut budget = Budget { spent: 0, limit: 100, closure: 1e-12 };
    let found = along(&system, &root, [-off * part, 0.0], &mut budget);
    (found.map(|(part, _)| part), budget.spent)
}

/// So near to the root the slope falls along the line by the part of the way that is made: after a
/// hundredth, four and sixteen hundredths; 0.9 of it counts.
#[test]
fn steps_are_lengthened_along_their_line() {
    assert_eq!(search(1e-4, 0.01), (Some(16.0), 3));
    assert_eq!(search(-1e-4, 0.01), (Some(16.0), 3));
    assert_eq!(search(1e-4, 0.03), (Some(4.0), 2));
    assert_eq!(search(1e-4, 0.2), (Some(1.0), 1));
}

/// Four times as far as the root the slope is -3 times the first: the secant meets zero at a
/// quarter.
#[test]
fn steps_are_shortened_by_the_secant() {
    let (Some(part), passes) = search(1e-4, 4.0) else { panic!("no step") };
    assert!((part - 0.25).abs() < 1e-4 && passes == 2);
    // Twenty times as far: not nearer to the end than a tenth of the way, where the slope is that of
    // the start the other way round; then half of that.
    let (Some(part), passes) = search(1e-4, 20.0) else { panic!("no step") };
    assert!((part - 0.05).abs() < 1e-4 && passes == 3, "{part} {passes}");
}
