//! Cells in which the force of some bar vanishes, so that its direction is free.
//!
//! At H = 0, V = −c_i the force `F_i` is zero: bar i carries nothing and may point anywhere. Bars
//! in a row whose common joints carry no weight (a group) lose their force together; away from that
//! pull they are parallel and act as one bar of the signed length Λ = Σ s l. Whatever the
//! direction, the other bars must leave a gap that the free ones can bridge:
//!
//! $$ \max(0,\ 2\max_g|\Lambda_g| - \sum_g|\Lambda_g|) \le
//!    \Bigl|D - \sum_{\text{others}} s_j l_j u_j\Bigr| \le \sum_g|\Lambda_g|. $$
//!
//! For one group this is a circle, and lengths in general position exclude it: the small cells
//! around the point are excluded. One bar alone that meets it is decided by
//! [`unloaded`](crate::slack::unloaded). The point itself, where the bars of a group need not be
//! parallel, is the business of [`families`](crate::slack::families).
//!
//! So near such a point that rounding hides where the force points, its direction is as good as
//! free: cells that do not hold the point, but are no wider than a last place, are treated alike.

use intervals::Interval;

use crate::closure::bar::BarTerm;
use crate::closure::{Pattern, signed};
use crate::plane::cell::Cell;
use crate::plane::system::System;

/// The patterns that a cell with free bars may hold a zero of, the pulls at which they are free
/// excepted where a group of several bars is free.
pub(crate) fn open(system: &System, cell: &Cell, patterns: &[Pattern]) -> Vec<Pattern> {
    let bars = system.bars();
    let mut free = vec![];
    let mut held = vec![];
    let weights = system.weights(cell.face);
    for (number, group) in system.groups.iter().enumerate() {
        let force = cell.force(weights[group.start]);
        let lost = cell.is_lost_around(number);
        if lost || force[0].contains(0.0) && force[1].contains(0.0) {
            free.push(group.clone());
        } else {
            held.extend(group.clone().map(|i| {
                (Pattern::bit(bars, i), BarTerm::value_over(cell, system.length[i], weights[i]))
            }));
        }
    }
    let may_close = |pattern: &&Pattern| {
        let mut gap = system.span;
        for (bit, value) in &held {
            let sign = if pattern.0 & bit == 0 { 1 } else { -1 };
            for k in 0..2 {
                gap[k] = gap[k] - signed(sign, value[k]);
            }
        }
        let distance = (gap[0].square() + gap[1].square()).sqrt();
        let links = free.iter().map(|group| {
            group
                .clone()
                .map(|i| signed(if pattern.compressed(bars, i) { -1 } else { 1 }, system.length[i]))
                .sum::<Interval>()
                .abs()
        });
        let [inner, outer] = reach(links);
        !(distance.lo() > outer || distance.hi() < inner)
    };
    patterns.iter().filter(may_close).copied().collect()
}

/// The smallest and the largest distance that links of these lengths bridge, rounded outward.
pub(crate) fn reach(links: impl Iterator<Item = Interval>) -> [f64; 2] {
    let mut total = Interval::ZERO;
    let mut longest = Interval::ZERO;
    for link in links {
        total = total + link;
        longest = Interval::new(longest.lo().max(link.lo()), longest.hi().max(link.hi()));
    }
    let inner = longest + longest - total;
    [inner.lo().max(0.0), total.hi()]
}
