//! The lowest bar in compression between anchors on one vertical: the closure along the vertical, down
//! one strand and up the other.

use super::super::axis::Axis;
use super::super::chain::Condensed;
use super::super::newton::Budget;
use super::super::pull::Pull;
use super::strut;

/// The bars before the lowest hang down, those after it lead up, and it fills the gap.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    strut::along(chain, &Axis::of_vertical_strands(chain), budget)
}
