//! The bottom of the chain: is every bar in tension, or is one in the way?
//!
//! Let both strands hang straight down, bars before bar k from the start anchor and bars after it
//! from the end anchor. Bar k would have to fill the gap
//!
//! $$ G_k = D + \Bigl(\sum_{i<k} l_i - \sum_{i>k} l_i\Bigr) e_z. $$
//!
//! Its height grows by $l_k + l_{k+1}$ from one bar to the next, so there is one bar with
//! $|e_z \cdot G_k| \le l_k$: the bottom bar. If $|G_k| > l_k$ the strands are pulled together,
//! and the convex function $\Phi(q) = \sum l_i |q + b_i e_z| - q \cdot D$ has its minimum where no
//! force vanishes: all bars are in tension. If $|G_k| \le l_k$ the minimum is the kink $q = 0$
//! (there $D - \sum_{i \ne k} l_i u_i = G_k$ must not be longer than $l_k$): as a cable the bar
//! would be slack, as a bar it pushes the strands apart. No iteration is needed to know.
//!
//! Bars that share the force q with bar k, because no joint between them carries weight, belong to
//! the bottom too.

use std::ops::Range;

use super::bar_data::BarData;
use super::sums::{BLOCK, DoubleDouble};
use crate::thresholds::{NO_LOAD, RECHECKED_GAP};

#[derive(Debug, Clone)]
pub(super) struct Bottom {
    /// All bars with the same force.
    pub group: Range<usize>,
    /// Their length.
    pub length: f64,
    /// The longest of them.
    pub longest: usize,
    /// Length of the longest minus that of the rest of the group: nearer than this its ends cannot
    /// come. For one bar its length; negative when the group folds to a point.
    pub shortest_reach: f64,
    /// Height of the gap between the straight strands.
    pub gap: f64,
    /// By how much the gap is higher than the group is long, to all digits where that is little.
    pub over: f64,
}

impl Bottom {
    /// The first bar whose second end lies at or above the lowest point that strands of equal depth
    /// reach: where `rise + 2 (l_1 + ... + l_k) >= total`.
    pub fn bar(bars: &BarData, rise: f64) -> usize {
        let BarData { lengths, blocks, total_length: total, .. } = bars;
        let beyond = |length: f64| 2.0 * length + (rise - total) >= 0.0;
        // The first block has nothing before it, so there is always one to look in.
        let block = blocks.partition_point(|block| !beyond(block.length)).saturating_sub(1);
        let first = block * BLOCK;
        let mut length = blocks[block].length;
        for (k, l) in lengths[first..].iter().enumerate() {
            length += l;
            if beyond(length) {
                return first + k;
            }
        }
        lengths.len() - 1
    }

    /// Everything about the bottom, once loads are counted from it.
    pub fn new(bar: usize, bars: &BarData, rise: f64) -> Self {
        let loads = &bars.loads;
        let largest = loads[0].abs().max(loads[loads.len() - 1].abs());
        let unloaded = |load: &f64| load.abs() <= NO_LOAD * largest;
        let first = bar - loads[..bar].iter().rev().take_while(|load| unloaded(load)).count();
        let end = bar + 1 + loads[bar + 1..].iter().take_while(|load| unloaded(load)).count();
        let group = first..end;
        let lengths = &bars.lengths[group.clone()];
        let length = model::sum(lengths.iter().copied());
        let longest = (group.clone())
            .fold(bar, |best, k| if bars.lengths[k] > bars.lengths[best] { k } else { best });
        let block = first / BLOCK;
        let strand =
            bars.blocks[block].length + bars.lengths[block * BLOCK..first].iter().sum::<f64>();
        let other = (bars.total_length - strand) - length;
        let mut gap = (strand - other) + rise;
        let mut over = gap.abs() - length;
        if over.abs() <= RECHECKED_GAP * bars.total_length {
            let [strand, other, own] = [&bars.lengths[..first], &bars.lengths[end..], lengths]
                .map(|lengths| DoubleDouble::total(lengths.iter().copied()));
            let height = strand.add(other.negate()).plus(rise);
            gap = height.value();
            over = if gap < 0.0 { height.negate() } else { height }.add(own.negate()).value();
        }
        let shortest_reach = 2.0 * bars.lengths[longest] - length;
        Self { group, length, longest, shortest_reach, gap, over }
    }

    /// How far the group is from straight when its ends are `gap` apart: from stretched out, or
    /// from folded on its longest bar. Negative when it cannot be.
    pub fn room(&self, gap: f64) -> f64 {
        (self.length - gap).min(gap - self.shortest_reach)
    }
}
