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
//! [`unloaded`](crate::run::slack::unloaded). The point itself, where the bars of a group need not be
//! parallel, is the business of [`families`](crate::run::slack::families).
//!
//! So near such a point that rounding hides where the force points, its direction is as good as
//! free: cells that do not hold the point, but are no wider than a last place, are treated alike.

use std::ops::Range;

use numerics::Interval;

use crate::run::closure::bar::{BarTerm, size};
use crate::run::closure::{Pattern, signed};
use crate::run::plane::cell::Cell;
use crate::run::plane::system::System;

/// Those of the patterns, sorted, that a cell with free bars may hold a zero of, the pulls at which
/// they are free excepted where a group of several bars is free.
pub(crate) fn open(system: &System, cell: &Cell, patterns: &[Pattern]) -> Vec<Pattern> {
    let System { length, groups, span, .. } = system;
    open_of(length, system.weights(cell.face), groups, *span, cell, patterns)
}

/// The same for bars of these lengths and weights, to any place of a range of spans.
pub(crate) fn open_of(
    lengths: &[Interval],
    weights: &[Interval],
    groups: &[Range<usize>],
    span: [Interval; 2],
    cell: &Cell,
    patterns: &[Pattern],
) -> Vec<Pattern> {
    let mut open = vec![];
    Gaps::over(lengths, weights, groups, cell).walk(0, patterns, span, &mut open);
    open
}

/// The gaps that the bars with a direction leave to the free ones, for all patterns at once: sums
/// over the bars that patterns have in common are made once.
struct Gaps<'a> {
    lengths: &'a [Interval],
    /// What each bar in tension takes off the gap; nothing for free ones.
    held: Vec<Option<[Interval; 2]>>,
    /// How much bar i and all after it can take off, at most.
    rest: Vec<[Interval; 2]>,
    free: Vec<Range<usize>>,
    /// The sum of the lengths of the free bars.
    longest: Interval,
}

impl<'a> Gaps<'a> {
    fn over(
        lengths: &'a [Interval],
        weights: &[Interval],
        groups: &[Range<usize>],
        cell: &Cell,
    ) -> Self {
        let bars = lengths.len();
        let mut held = vec![None; bars];
        let mut free = vec![];
        for (number, group) in groups.iter().enumerate() {
            let force = cell.force(weights[group.start]);
            let lost = cell.is_lost_around(number);
            if lost || force[0].contains(0.0) && force[1].contains(0.0) {
                free.push(group.clone());
                continue;
            }
            for i in group.clone() {
                held[i] = Some(BarTerm::value_over(cell, lengths[i], weights[i]));
            }
        }
        let mut rest = vec![[Interval::ZERO; 2]; bars + 1];
        for (bar, value) in held.iter().enumerate().rev() {
            let value = value.map_or([Interval::ZERO; 2], |value| value.map(Interval::abs));
            rest[bar] = std::array::from_fn(|k| rest[bar + 1][k] + value[k]);
        }
        let longest = free.iter().flat_map(|group| &lengths[group.clone()]).copied().sum();
        Self { lengths, held, rest, free, longest }
    }

    fn walk(&self, bar: usize, patterns: &[Pattern], gap: [Interval; 2], open: &mut Vec<Pattern>) {
        // The gap is too wide whatever the signs to come.
        let wide = |k: usize| gap[k].mig() > (self.rest[bar][k] + self.longest).hi();
        if patterns.is_empty() || wide(0) || wide(1) {
            return;
        }
        let bars = self.lengths.len();
        if bar == bars {
            open.extend(patterns.iter().filter(|pattern| self.may_close(**pattern, gap)));
            return;
        }
        let bit = Pattern::bit(bars, bar);
        let (tension, compression) =
            patterns.split_at(patterns.partition_point(|pattern| pattern.0 & bit == 0));
        let [less, more] = match self.held[bar] {
            None => [gap, gap],
            Some(value) => [
                std::array::from_fn(|k| gap[k] - value[k]),
                std::array::from_fn(|k| gap[k] - (-value[k])),
            ],
        };
        self.walk(bar + 1, tension, less, open);
        self.walk(bar + 1, compression, more, open);
    }

    /// Whether the free bars may bridge the gap.
    fn may_close(&self, pattern: Pattern, gap: [Interval; 2]) -> bool {
        let bars = self.lengths.len();
        let distance = size(gap);
        let links = self.free.iter().map(|group| {
            let own = group.clone().map(|i| signed(pattern.sign(bars, i), self.lengths[i]));
            own.sum::<Interval>().abs()
        });
        let [inner, outer] = reach(links);
        !(distance.lo() > outer || distance.hi() < inner)
    }
}

/// The smallest and the largest distance that links of these lengths bridge, rounded outward.
fn reach(links: impl Iterator<Item = Interval>) -> [f64; 2] {
    let mut total = Interval::ZERO;
    let mut longest = Interval::ZERO;
    for link in links {
        total = total + link;
        longest = Interval::new(longest.lo().max(link.lo()), longest.hi().max(link.hi()));
    }
    let inner = longest + longest - total;
    [inner.lo().max(0.0), total.hi()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::closure::Closure;
    use crate::run::plane::face::Face;
    use crate::run::plane::loads::JointLoads;

    /// Where no bar is free the bars have to close the gap themselves, and where they do it is zero.
    #[test]
    fn bars_with_a_direction_close_the_gap_alone() {
        let chain = samples::homogeneous(10.0, &[(5.0, 1.0); 2], [6.0, 0.0, 0.0]).into_chain();
        let mut system = System::new(&chain, JointLoads::NONE);
        let at = Cell::point(Face::Near, [0.75, 0.25]);
        system.span = [Interval::ZERO; 2];
        system.span = Closure::gap_over(&system, &[1, -1], &at);
        let all = [0b00, 0b01, 0b10, 0b11].map(Pattern);
        assert_eq!(open(&system, &at, &all), [Pattern(0b01)]);
    }

    /// Links of 1, 5 and 2 reach from 5 - 3 to 8; of 3, 4 and 5 from 0.
    #[test]
    fn links_reach_from_what_the_longest_leaves_to_their_sum() {
        let of = |lengths: [f64; 3]| reach(lengths.into_iter().map(Interval::point));
        for (lengths, expected) in [([1.0, 5.0, 2.0], [2.0, 8.0]), ([3.0, 4.0, 5.0], [0.0, 12.0])] {
            let [inner, outer] = of(lengths);
            assert!(inner <= expected[0] && inner > expected[0] - 1e-14, "{inner}");
            assert!(outer >= expected[1] && outer < expected[1] + 1e-14, "{outer}");
        }
    }
}
