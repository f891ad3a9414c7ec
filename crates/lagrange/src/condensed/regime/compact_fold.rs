//! A fold whose anchors are too near to each other to say along which line it lies: the axes turn
//! with the compressed bar.

use super::strut;
use crate::condensed::chain::Condensed;
use crate::condensed::compression::Strut;
use crate::condensed::folded::Folded;
use crate::condensed::newton::Budget;
use crate::condensed::pull::Pull;

/// The closure along the force of the bar, in whatever direction the iteration tries.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let turning = Strut { folded: Folded::of(chain), ..strut::upright(chain) };
    let root = turning.solve(budget)?;
    Some(strut::pull(chain, &root, root.force, budget))
}
