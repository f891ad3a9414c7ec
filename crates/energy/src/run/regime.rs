//! How a chain lies between its anchors, decided before anything is solved.
//!
//! Two questions decide which way a chain is solved, and they are independent of each other: how
//! much length the chain can spare ([`Reach`]), and what holds its vertical plane ([`Turning`]).
//! Both are answered by the lengths and the anchors alone. What only a solution can tell (bars on
//! one line, a sharp bend) is an outcome of the attempt: modules `straight_fold` and `sharp_bend`.

use crate::run::scaled_chain::ScaledChain;
use crate::run::settings::Motion;
use crate::vector::dot;

/// How much length a chain can spare before its bars lie on one line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reach {
    /// A good part of its length: any axes and any start will do.
    Slack,
    /// Little, before it is taut or its longest bar folds on the others along the span: an axis of
    /// the frame lies along the span, where squares of small angles keep their digits.
    DrawnOut,
}

/// What holds the vertical plane of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turning {
    /// Nothing: the anchors are on one vertical and the turn about it is taken out of the Newton
    /// system.
    Free,
    /// Little: the anchors are nearly on one vertical. The chain is turned as a whole before
    /// Newton's steps, which only turn well by a part of the small angle between the verticals.
    Soft,
    /// The anchors, or a motion that is confined to the plane.
    Held,
}

/// Parts of the total length to spare below which a chain is drawn out along its span.
const DRAWN_OUT: f64 = 0.25;

/// Level distance of the anchors, in units of the length (a part between 1 and 1/2 of the total),
/// below which the turn of the whole chain is soft: steps along straight lines distort it more than
/// they win.
const NEARLY_VERTICAL: f64 = 0.01;

impl Reach {
    /// From the total length, the span and the longest bar, in any one unit.
    pub(crate) fn of(total: f64, span: f64, longest: f64) -> Self {
        let (taut, folded) = (total - span, total + span - 2.0 * longest);
        let spare = taut.min(folded);
        if spare < DRAWN_OUT * total && spare < span { Self::DrawnOut } else { Self::Slack }
    }
}

impl Turning {
    pub(crate) fn of(links: &ScaledChain) -> Self {
        if links.motion == Motion::Plane {
            return Self::Held;
        }
        if links.vertical {
            return Self::Free;
        }
        if dot(links.level(), links.span[0]).abs() > NEARLY_VERTICAL {
            Self::Held
        } else {
            Self::Soft
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reach_by_what_can_be_spared() {
        // Total, span, longest.
        for (total, span, longest, expected) in [
            (3.0, 2.0, 1.0, Reach::Slack),
            (3.0, 2.9, 1.0, Reach::DrawnOut),
            (3.0, 1.0, 1.8, Reach::DrawnOut),
            (3.0, 1.0, 1.99, Reach::DrawnOut),
            (2.0, 1.0 / 64.0, 1.0, Reach::Slack),
            (2.0, 1.0 / 256.0, 1.0 + 1e-3, Reach::DrawnOut),
            // Anchors at one point.
            (3.0, 0.0, 0.5, Reach::Slack),
        ] {
            assert_eq!(Reach::of(total, span, longest), expected, "{span} {longest}");
        }
    }

    #[test]
    fn the_turn_by_the_distance_of_the_verticals() {
        let links = |across: f64, vertical: bool, motion: Motion| ScaledChain {
            length: vec![0.5; 3],
            carried: vec![0.3, 0.0, -0.3],
            span: [[across, 0.0, 0.5], [0.0; 3]],
            up: [0.0, 0.0, 1.0],
            vertical,
            motion,
        };
        for (across, vertical, motion, expected) in [
            (0.5, false, Motion::Space, Turning::Held),
            (0.005, false, Motion::Space, Turning::Soft),
            (-0.005, false, Motion::Space, Turning::Soft),
            (0.0, true, Motion::Space, Turning::Free),
            (0.0, true, Motion::Plane, Turning::Held),
            (0.005, false, Motion::Plane, Turning::Held),
        ] {
            assert_eq!(Turning::of(&links(across, vertical, motion)), expected, "{across}");
        }
    }
}
