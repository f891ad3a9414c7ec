//! Two vertical strands that just meet: they share the weight of the joint where they do in any way
//! they like.
//!
//! The answer is the limit of anchors that are moved apart a little: a horizontal pull H turns bar
//! i off the vertical by $H/|F_i|$, which takes $l_i H^2/(2 F_i^2)$ off its height, and both
//! strands must lose the same,
//!
//! $$ \sum_i l_i\\, \mathrm{sign}(F_i)/F_i^2 = 0, $$
//!
//! a monotone function of the force at the bottom, with a pole at either end of its range.

use crate::condensed::bottom::Bottom;
use crate::condensed::bracket::Bracket;
use crate::condensed::chain::Condensed;
use crate::condensed::newton::Budget;
use crate::condensed::pull::{Pull, Signs};

/// The force that strands a little apart tend to.
pub(super) fn solve(chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
    let force = [0.0, balanced(chain, budget)?];
    let jacobian = chain.upright(chain.all(), 0.0).closure(force).jacobian;
    Some(Pull::new(chain, Signs::Tension, force, jacobian, budget.spent))
}

/// The vertical force at the bottom for which both strands lose the same height when they turn.
pub(super) fn balanced(chain: &Condensed, budget: &mut Budget) -> Option<f64> {
    let Bottom { group, gap, .. } = &chain.bottom;
    let bars = &chain.bars;
    let load = if *gap < 0.0 {
        bars.loads.get(group.end).copied()
    } else {
        group.start.checked_sub(1).map(|k| bars.loads[k])
    };
    let end = -load.unwrap_or(0.0);
    let range = Bracket { low: end.min(0.0), high: end.max(0.0) };
    range.root(0.5 * end, end.abs(), 0.0, |vertical| {
        if !budget.spend() {
            return None;
        }
        // In units of the range: a square of a small force would underflow.
        let terms = || {
            bars.lengths.iter().zip(&bars.loads).map(|(length, load)| {
                let force = (vertical + load) / end.abs();
                (length / force.abs(), force)
            })
        };
        let lost = model::sum(terms().map(|(turn, force)| turn / force));
        let slope = 2.0 * terms().map(|(turn, force)| turn / (force * force)).sum::<f64>();
        Some((-lost, slope / end.abs()))
    })
}
