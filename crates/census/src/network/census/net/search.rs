//! Branch and bound over the places of the knots, for all patterns of the swinging joints.
//!
//! Level by level, each box by itself and in parallel, the results taken in order: the answer does
//! not depend on the number of threads.

use intervals::Interval;
use rayon::prelude::*;

use super::cell::Pattern;
use super::examine::{Examined, Found, Verdict};
use super::layout::Layout;
use super::reach;
use crate::search::Progress;

/// A box is not cut below this part of the unit of length, 2⁻²⁶: rounding errors of forces are far
/// smaller, and what is not decided there is degenerate.
const LEAST_WIDTH: f64 = f64::from_bits((1023 - 26) << 52);

/// A part of a box smaller than this one is looked at again before it is cut.
const GOOD: f64 = 0.6;

/// Below so many tests in a level, threads cost more than they save.
const WORTH_THREADS: usize = 64;

/// A box, and the patterns that may have an equilibrium in it.
#[derive(Debug, Clone)]
pub(super) struct Task<const N: usize> {
    pub(super) at: [Interval; N],
    pub(super) patterns: Vec<Pattern>,
}

/// All that the search found.
#[derive(Debug)]
pub(super) struct Search<const N: usize> {
    pub(super) found: Vec<Found<N>>,
    pub(super) undecided: Vec<Task<N>>,
    pub(super) cells: u64,
    pub(super) tests: u64,
    /// Whether the budget of tests ended the search.
    pub(super) exhausted: bool,
}

#[derive(Debug)]
struct Outcome<const N: usize> {
    found: Vec<Found<N>>,
    next: Vec<Task<N>>,
    undecided: Vec<Task<N>>,
}

/// Search all places, with at most so many tests of a box for a pattern.
pub(super) fn search<const N: usize>(
    layout: &Layout,
    budget: u64,
    watch: &dyn Fn(Progress),
) -> Search<N> {
    let mut search =
        Search { found: vec![], undecided: vec![], cells: 0, tests: 0, exhausted: false };
    let Some(at) = reach::whole(layout) else { return search };
    let patterns = (0..1 << layout.swings.len()).collect();
    let mut level = vec![Task { at, patterns }];
    while !level.is_empty() {
        if search.tests >= budget {
            search.exhausted = true;
            search.undecided.append(&mut level);
            break;
        }
        let work = |task: &Task<N>| examine(layout, &search.found, task);
        let tests: usize = level.iter().map(|task| task.patterns.len()).sum();
        let outcomes: Vec<Outcome<N>> = if tests < WORTH_THREADS {
            level.iter().map(work).collect()
        } else {
            level.par_iter().map(work).collect()
        };
        search.cells += level.len() as u64;
        search.tests += tests as u64;
        level.clear();
        for outcome in outcomes {
            search.found.extend(outcome.found);
            search.undecided.extend(outcome.undecided);
            level.extend(outcome.next);
        }
        watch(Progress {
            done: search.cells,
            waiting: level.len() as u64,
            proved: search.found.len() as u64,
            undecided: search.undecided.len() as u64,
        });
    }
    search
}

/// Narrow, exclude, prove, cut.
fn examine<const N: usize>(layout: &Layout, known: &[Found<N>], task: &Task<N>) -> Outcome<N> {
    let mut outcome = Outcome { found: vec![], next: vec![], undecided: vec![] };
    let mut at = task.at;
    if reach::narrow(layout, &mut at).is_none() {
        return outcome;
    }
    let settled = |pattern: &Pattern| {
        let in_box = |found: &&Found<N>| {
            let parts = found.alone_in.iter().zip(&at);
            found.pattern == *pattern && parts.into_iter().all(|(all, part)| all.encloses(*part))
        };
        known.iter().any(|found| in_box(&found))
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
            Verdict::Within(part) if size(&part, &at) < GOOD => {
                outcome.next.push(Task { at: part, patterns: vec![pattern] });
            }
            Verdict::Within(part) => {
                patterns.push(pattern);
                left = Some(left.map_or(part, |all| std::array::from_fn(|k| all[k].hull(part[k]))));
            }
        }
    }
    let Some(left) = left else { return outcome };
    let widest =
        (0..N).fold(0, |best, k| if left[k].width() > left[best].width() { k } else { best });
    if left[widest].width() < LEAST_WIDTH {
        outcome.undecided.push(Task { at: left, patterns });
        return outcome;
    }
    let middle = left[widest].mid();
    for half in [Interval::new(left[widest].lo(), middle), Interval::new(middle, left[widest].hi())]
    {
        let mut at = left;
        at[widest] = half;
        outcome.next.push(Task { at, patterns: patterns.clone() });
    }
    outcome
}

/// The largest width of a part against that of the whole, where that is wide at all.
fn size<const N: usize>(part: &[Interval; N], whole: &[Interval; N]) -> f64 {
    let most = whole.iter().map(|x| x.width()).fold(0.0, f64::max);
    part.iter().map(|x| x.width()).fold(0.0, f64::max) / most
}
