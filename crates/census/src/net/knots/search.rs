//! Branch and bound over the places of the knots, for all patterns of the swinging joints, level by
//! level.

use numerics::Interval;

use super::box_test::{Examined, Found, Verdict};
use super::cell::Pattern;
use super::layout::Layout;
use super::reach;
use crate::branch_and_bound::{self, Plan, encloses, halves, hull, widest};
use crate::run::search::Progress;

/// A box is not cut below this part of the unit of length, 2⁻²⁶: rounding errors of forces are far
/// smaller, and what is not decided there is degenerate.
pub(in crate::net) const LEAST_WIDTH: f64 = f64::from_bits((1023 - 26) << 52);

/// A part of a box smaller than this one is looked at again before it is cut.
pub(in crate::net) const GOOD: f64 = 0.6;

/// Below so many tests in a level, threads cost more than they save.
const WORTH_THREADS: usize = 64;

/// A box, and the patterns that may have an equilibrium in it.
#[derive(Debug, Clone)]
pub(super) struct Task<const N: usize> {
    pub(super) at: [Interval; N],
    pub(super) patterns: Vec<Pattern>,
}

pub(super) type Search<const N: usize> = branch_and_bound::Search<Found<N>, Task<N>>;
type Outcome<const N: usize> = branch_and_bound::Outcome<Found<N>, Task<N>>;

/// Search all places, with at most so many tests of a box for a pattern.
pub(super) fn search<const N: usize>(
    layout: &Layout,
    budget: u64,
    watch: &dyn Fn(Progress),
) -> Search<N> {
    let patterns: Vec<Pattern> = (0..1 << layout.swings.len()).collect();
    let roots = reach::whole(layout).map(|at| Task { at, patterns }).into_iter().collect();
    let size = |task: &Task<N>| task.patterns.len();
    let plan = Plan { budget, batch: usize::MAX, worth_threads: WORTH_THREADS, size };
    Search::run(roots, &plan, |known, task| examine(layout, known, task), watch)
}

/// Narrow, exclude, prove, cut.
fn examine<const N: usize>(layout: &Layout, known: &[Found<N>], task: &Task<N>) -> Outcome<N> {
    let mut outcome = Outcome { tests: task.patterns.len() as u64, ..Outcome::default() };
    let mut at = task.at;
    if reach::narrow(layout, &mut at).is_none() {
        return outcome;
    }
    let settled = |pattern: &Pattern| {
        known.iter().any(|found| found.pattern == *pattern && encloses(&found.alone_in, &at))
    };
    let asked: Vec<Pattern> =
        task.patterns.iter().copied().filter(|pattern| !settled(pattern)).collect();
    if asked.is_empty() {
        return outcome;
    }
    let Some(examined) = Examined::new(layout, at) else { return outcome };
    let mut left: Option<[Interval; N]> = None;
    let mut patterns = vec![];
    for pattern in asked {
        match examined.pattern(pattern) {
            Verdict::Empty => {}
            Verdict::One(found) => outcome.found.push(found),
            Verdict::Within(part) if widest(&part).1 < GOOD * widest(&at).1 => {
                outcome.next.push(Task { at: part, patterns: vec![pattern] });
            }
            Verdict::Within(part) => {
                patterns.push(pattern);
                left = Some(left.map_or(part, |all| hull(all, part)));
            }
        }
    }
    let Some(left) = left else { return outcome };
    let (across, width) = widest(&left);
    if width < LEAST_WIDTH {
        outcome.undecided.push(Task { at: left, patterns });
        return outcome;
    }
    let half = |at| Task { at, patterns: patterns.clone() };
    outcome.next.extend(halves(left, across).map(half));
    outcome
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::arithmetic::points;
    use crate::net::knots::layout::{End, Swing};

    /// A knot at the anchor of two pairs of equal bars, both folded: nothing is said of their pulls,
    /// and a box is cut until it is as small as boxes get.
    #[test]
    fn the_smallest_boxes_are_not_cut() {
        let swing = |at: [f64; 3], lengths: [f64; 2]| Swing {
            joint: 0,
            members: [0, 1],
            ends: [End::Held(points(at)), End::Knot(0)],
            lengths: lengths.map(Interval::point),
            load: points([0.0, 0.0, -1.0]),
        };
        let layout = Layout {
            dim: 3,
            axes: [0, 1, 2],
            axis: None,
            knots: vec![0],
            loads: vec![points([0.0, 0.0, -1.0])],
            swings: vec![
                swing([0.0; 3], [1.0; 2]),
                swing([0.0; 3], [1.0; 2]),
                swing([2.0, 0.0, 0.0], [1.5, 1.0]),
            ],
            links: vec![],
        };
        for (part, expected) in [(1.0, [0, 2]), (0.25, [1, 0])] {
            let at = [Interval::around(0.0, part * LEAST_WIDTH); 3];
            let task = Task { at, patterns: vec![0] };
            let outcome = examine(&layout, &[], &task);
            assert_eq!([outcome.undecided.len(), outcome.next.len()], expected, "{part}");
            assert!(outcome.found.is_empty());
        }
    }
}
