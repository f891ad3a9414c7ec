//! Chains that cannot close.

use super::*;
use crate::run::settings::Motion;

fn straight(length: f64, span: f64) -> (ScaledChain, Vec<Vector>) {
    let links = ScaledChain {
        length: vec![length; 5],
        carried: vec![0.4, 0.2, 0.0, -0.2, -0.4],
        span: [[span, 0.0, 0.0], [0.0; 3]],
        up: [0.0, 0.0, 1.0],
        vertical: false,
        motion: Motion::Space,
    };
    (links, vec![[1.0, 0.0, 0.0]; 5])
}

/// The anchors are too far from each other by 0.05, of a length of 1.25.
#[test]
fn what_a_chain_lacks_is_a_part_of_its_length() {
    let (links, start) = straight(0.25, 1.3);
    let Err(Error::SeedNotClosed { gap, .. }) = descend(links, start, &Settings::default()) else {
        panic!("it does not close");
    };
    assert!((gap - 0.04).abs() < 1e-6, "{gap}");
}

/// A gap of rounding counts as closed, but not where the chain has no length to spare for it: five
/// times the double next to 0.2 is 1 and a quarter of a rounding.
#[test]
fn a_chain_that_is_too_short_by_a_rounding_does_not_close() {
    for roundings in [2.0, 0.0] {
        let (links, start) = straight(0.2, 1.0 + roundings * f64::EPSILON);
        assert!((links.spare() + roundings * f64::EPSILON).abs() <= 0.0);
        let Err(Error::SeedNotClosed { gap, .. }) =
            descend_to_line(links, start, &Settings::default())
        else {
            panic!("it does not close");
        };
        assert!(gap > 0.0 && gap < 1e-14, "{gap}");
    }
}
