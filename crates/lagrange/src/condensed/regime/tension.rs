//! Every bar in tension: the minimum of a convex function, from a catenary.

use std::num::NonZeroUsize;

use crate::condensed::bracket::Bracket;
use crate::condensed::catenary::Catenary;
use crate::condensed::chain::Condensed;
use crate::condensed::kernel::Bars;
use crate::condensed::loads::Arrays;
use crate::condensed::newton::{Budget, NEWTON_PASSES, Root, minimise, within_a_few_passes};
use crate::condensed::parallel::Workers;
use crate::condensed::pull::{Pull, Signs};
use crate::condensed::system::{Frame, System};

/// Newton's method from the minimum of the coarse chain; the nested searches in reserve.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let system = chain.upright(chain.all(), 0.0);
    let slack = chain.bars.total_length - chain.span.distance;
    let start = Catenary::of(chain, slack).force();
    let (near, contraction) = over_the_coarse(chain, start);
    let root = within_a_few_passes(budget, |few| minimise(&system, near, contraction, few))
        .or_else(|| nested(&system, start, budget))?;
    Some(Pull::at(chain, Signs::Tension, root.force, &root, budget))
}

/// The minimum for the coarse chain of the moments of the loads, and how fast it was reached.
fn over_the_coarse(chain: &Condensed, start: [f64; 2]) -> ([f64; 2], Option<f64>) {
    let Arrays { lengths, loads } = &chain.moments.coarse;
    if lengths.is_empty() {
        return (start, None);
    }
    let workers = Workers::new(NonZeroUsize::MIN, lengths.len());
    let parts = [Bars { lengths, loads }, Bars::NONE];
    let system = System { workers, ..chain.upright(parts, 0.0) };
    let mut budget = Budget { spent: 0, limit: NEWTON_PASSES, closure: f64::INFINITY };
    let root = minimise(&system, start, None, &mut budget);
    // Without a full step nothing was measured.
    let measured = |root: &Root| Some(root.contraction).filter(|contraction| *contraction > 0.0);
    root.map_or((start, None), |root| (root.force, measured(&root)))
}

/// Solve by two nested searches on monotone functions: for each horizontal pull H the vertical
/// force that closes the height, and with it the H that closes the width. Both exist and are
/// unique: the height grows with the force from below $-L$ to above L, and the width, the
/// derivative of the convex $\min_v \Phi$, grows with H. Slower than Newton's method and not to be
/// stopped; in upright axes.
pub(super) fn nested(system: &System<'_>, start: [f64; 2], budget: &mut Budget) -> Option<Root> {
    let Frame::Upright { .. } = system.frame else { return None };
    let mut force = start;
    let [floor_across, floor_up] = system.closure(start).floor;
    let scale = start[0].hypot(start[1]);
    // H over many orders of magnitude: search for its logarithm.
    Bracket::LINE.root(start[0].ln(), 1.0, floor_across, |log| {
        force[0] = log.exp();
        let height = |v: f64| {
            let closure = budget.spend().then(|| system.closure([force[0], v]))?;
            Some((closure.residual[1], closure.jacobian[2]))
        };
        force[1] = Bracket::LINE.root(force[1], scale, floor_up, height)?;
        let closure = budget.spend().then(|| system.closure(force))?;
        // Along the closed height dv/dH = -J12/J22.
        let [a, b, c] = closure.jacobian;
        Some((closure.residual[0], (a - b * b / c) * force[0]))
    })?;
    minimise(system, force, None, budget)
}
