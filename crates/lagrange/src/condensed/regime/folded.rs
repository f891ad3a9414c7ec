//! The lowest bar in compression as long as the span and all others together, which fold back along
//! it: the axes of the line of the anchors.

use super::strut;
use crate::condensed::axis::Axis;
use crate::condensed::chain::Condensed;
use crate::condensed::newton::Budget;
use crate::condensed::pull::Pull;

/// The compressed bar points from anchor to anchor, all others nearly against it.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    // The forces point against the bar.
    let axis = Axis::through_the_anchors(chain, chain.bottom.shortest_reach, -1.0);
    strut::along(chain, &axis, budget)
}
