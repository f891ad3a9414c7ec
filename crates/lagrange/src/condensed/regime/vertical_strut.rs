//! The lowest bar in compression between anchors on one vertical: the closure along the vertical,
//! down one strand and up the other.

use super::strut;
use crate::condensed::axis::Axis;
use crate::condensed::chain::Condensed;
use crate::condensed::newton::Budget;
use crate::condensed::pull::Pull;

/// The bars before the lowest hang down, those after it lead up, and it fills the gap.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    strut::along(chain, &Axis::of_vertical_strands(chain), budget)
}
