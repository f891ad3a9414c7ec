//! Every bar in tension, nearly straight: the closure along the line of the anchors.

use super::tension::nested;
use crate::condensed::axis::Axis;
use crate::condensed::catenary::Catenary;
use crate::condensed::chain::Condensed;
use crate::condensed::newton::{Budget, minimise, polish, within_a_few_passes};
use crate::condensed::pull::{Pull, Signs};
use crate::condensed::system::System;

/// Newton's method in the axes of the line; in reserve the nested searches in upright axes, their
/// root polished along the line.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let axis = Axis::through_the_anchors(chain, 0.0, 1.0);
    let upright = chain.upright(chain.all(), 0.0);
    let aligned = System { frame: axis.frame, ..upright };
    let start = Catenary::of(chain, axis.slack).force();
    let begin = axis.enter(start);
    let root =
        within_a_few_passes(budget, |few| minimise(&aligned, begin, None, few)).or_else(|| {
            let root = nested(&upright, start, budget)?;
            Some(polish(&aligned, axis.enter(root.force), budget))
        })?;
    Some(Pull::at(chain, Signs::Tension, axis.leave(root.force), &root, budget))
}
