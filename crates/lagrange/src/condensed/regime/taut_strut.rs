//! The lowest bar in compression, the chain nearly straight: the axes of the line of the anchors.

use super::strut;
use crate::condensed::axis::Axis;
use crate::condensed::chain::Condensed;
use crate::condensed::newton::Budget;
use crate::condensed::pull::Pull;

/// All bars, the compressed one too, point nearly from anchor to anchor.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let axis = Axis::through_the_anchors(chain, chain.bottom.shortest_reach, 1.0);
    strut::along(chain, &axis, budget)
}
