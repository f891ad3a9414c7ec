//! The lowest bar in compression, all others in tension: in upright axes, or in those of a line along
//! which the bars nearly lie.

use std::f64::consts::FRAC_PI_2;

use crate::condensed::axis::Axis;
use crate::condensed::bottom::Bottom;
use crate::condensed::bracket::Bracket;
use crate::condensed::chain::Condensed;
use crate::condensed::compression::Strut;
use crate::condensed::newton::{Budget, Root};
use crate::condensed::pull::{Pull, Signs};
use crate::condensed::span::Span;

/// Newton's method for compression and slope of the bar, nested searches in reserve.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let root = upright(chain).solve(budget)?;
    Some(pull(chain, &root, root.force, budget))
}

/// The chain nearly straight: all bars, the compressed one too, point nearly from anchor to anchor.
pub(super) fn taut(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let axis = Axis::through_the_anchors(chain, chain.bottom.shortest_reach, 1.0);
    along(chain, &axis, budget)
}

/// As long as the span and all others together, which fold back along it: the compressed bar points
/// from anchor to anchor, all others nearly against it. So do the forces.
pub(super) fn folded(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let axis = Axis::through_the_anchors(chain, chain.bottom.shortest_reach, -1.0);
    along(chain, &axis, budget)
}

/// Between anchors on one vertical: the bars before the lowest hang down, those after it lead up, and
/// it fills the gap.
pub(super) fn vertical(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    along(chain, &Axis::of_vertical_strands(chain), budget)
}

fn along(chain: &Condensed, axis: &Axis, budget: &mut Budget) -> Option<Pull> {
    let root = upright(chain).along(axis).solve(budget)?;
    Some(pull(chain, &root, axis.leave(root.force), budget))
}

/// The equations in upright axes, and where to start.
fn upright(chain: &Condensed) -> Strut<'_> {
    let Bottom { group, shortest_reach, gap, .. } = &chain.bottom;
    let Span { across, rise, .. } = chain.span;
    let beside = [group.start.checked_sub(1), Some(group.end)];
    let beside = beside.into_iter().flatten().filter_map(|k| chain.bars.loads.get(k));
    Strut {
        system: chain.upright(chain.around_the_bottom(), *shortest_reach),
        side: 1.0,
        level: [1.0, 0.0],
        between: Bracket { low: -FRAC_PI_2, high: FRAC_PI_2 },
        // With the strands straight the bar's slope follows from the height of the gap.
        angle: (gap / shortest_reach).clamp(-1.0, 1.0).asin(),
        line: rise.atan2(across),
        load: beside.fold(f64::INFINITY, |least, load| least.min(load.abs())),
        largest_load: chain.largest_load(),
    }
}

/// The pull with the longest of the lowest bars in compression.
fn pull(chain: &Condensed, root: &Root, force: [f64; 2], budget: &Budget) -> Pull {
    Pull::at(chain, Signs::Compressed(chain.bottom.longest), force, root, budget)
}
