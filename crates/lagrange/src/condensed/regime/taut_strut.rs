//! The lowest bar in compression, the chain nearly straight: the axes of the line of the anchors.

use super::super::axis::Axis;
use super::super::chain::Condensed;
use super::super::newton::Budget;
use super::super::pull::Pull;
use super::strut;

/// All bars, the compressed one too, point nearly from anchor to anchor.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let axis = Axis::through_the_anchors(chain, chain.bottom.shortest_reach, 1.0);
    strut::along(chain, &axis, budget)
}
