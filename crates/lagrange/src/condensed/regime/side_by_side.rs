//! Every bar in tension, in two nearly vertical strands: the closure along the vertical, down one
//! strand and up the other.

use super::indeterminate::balanced;
use crate::condensed::axis::Axis;
use crate::condensed::chain::Condensed;
use crate::condensed::newton::{Budget, minimise, within_a_few_passes};
use crate::condensed::pull::{Pull, Signs};
use crate::condensed::system::System;

/// Newton's method along the vertical, from strands that are just not vertical.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let start = little_apart(chain, budget)?;
    let (axis, split) = Axis::down_and_up(chain);
    let upright = chain.upright(chain.split(split), 0.0);
    let aligned = System { frame: axis.frame, ..upright };
    let begin = axis.enter(start);
    let root = within_a_few_passes(budget, |few| minimise(&aligned, begin, None, few))?;
    Some(Pull::at(chain, Signs::Tension, axis.leave(root.force), &root, budget))
}

/// The force at the bottom of strands whose anchors are a little apart: to first order in H they
/// turn as far as that asks for, $H \sum_i l_i/|F_i| = $ the way across.
fn little_apart(chain: &Condensed, budget: &mut Budget) -> Option<[f64; 2]> {
    let vertical = balanced(chain, budget)?;
    let bars = chain.bars.lengths.iter().zip(&chain.bars.loads);
    let turns = model::sum(bars.map(|(length, load)| length / (vertical + load).abs()));
    Some([chain.span.across / turns, vertical])
}
