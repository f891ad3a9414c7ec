//! Branch and bound over the pull, for all patterns of tension and compression at once.
//!
//! Level by level: every cell of a level is worked on by itself, in parallel, and the results are
//! taken in order. So neither the answer nor the point where the search gives up depends on the
//! number of threads.

pub(crate) mod merge;
pub(crate) mod pattern_sums;
pub(crate) mod undecided;

use std::borrow::Cow;

use numerics::Interval;

use crate::branch_and_bound::{self, Plan, hull};
use crate::run::closure::Pattern;
use crate::run::enclosure::krawczyk::{Finding, Zero, examine};
use crate::run::plane::cell::Cell;
use crate::run::plane::system::System;
use crate::run::search::pattern_sums::PatternSums;
use crate::run::slack::exclusion;
use crate::run::slack::straight::Straight;
use crate::run::slack::unloaded::Unloaded;
use crate::settings::Settings;

/// Below so many tests in a level, threads cost more than they save: waking one takes microseconds,
/// a test a tenth of one.
const WORTH_THREADS: usize = 2_000;

/// A cell narrower than this, on a face of the half cube of pulls (whose edges have length 2), is not cut any more:
/// 2⁻⁴⁰. Below 2⁻⁴⁸ rounding errors decide.
const MIN_WIDTH: f64 = f64::from_bits((1023 - 40) << 52);

/// A contracted cell smaller than this part of the old one is looked at again before it is cut.
pub(crate) const GOOD_CONTRACTION: f64 = 0.5;

/// How far a census has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Cells done.
    pub done: u64,
    /// Cells waiting; grows at first, and is 0 at the end.
    pub waiting: u64,
    /// Zeros of the closure proved so far, those that neighbouring cells share several times.
    pub proved: u64,
    /// Cells given up so far, neighbours not yet joined.
    pub undecided: u64,
}

/// A cell, and the patterns that may have a zero in it.
#[derive(Debug, Clone)]
pub(crate) struct Task {
    pub(crate) cell: Cell,
    pub(crate) patterns: Vec<Pattern>,
}

/// Zeros, proved, the same one several times where cells meet; and cells that could not be decided.
pub(crate) type Search = branch_and_bound::Search<(Pattern, Zero), Task>;
type Outcome = branch_and_bound::Outcome<(Pattern, Zero), Task>;

/// What is settled before the search.
pub(crate) struct Settled<'a> {
    pub(crate) unloaded: &'a Unloaded,
    pub(crate) straight: &'a Straight,
}

impl Settled<'_> {
    /// The patterns that may have equilibria in a cell besides those that are settled.
    fn left<'p>(
        &self,
        system: &System,
        cell: &Cell,
        patterns: &'p [Pattern],
    ) -> Cow<'p, [Pattern]> {
        self.straight.left(system, cell, self.unloaded.left(system, cell, patterns))
    }
}

/// Search the whole half cube for zeros of these patterns, sorted, but for what is settled with
/// unloaded bars and straight positions. `watch` hears of the progress after each level, and within
/// large ones.
pub(crate) fn search(
    system: &System,
    settings: &Settings,
    settled: &Settled,
    patterns: &[Pattern],
    watch: &dyn Fn(Progress),
) -> Search {
    let budget = settings.max_tests_per_pattern.saturating_mul(patterns.len() as u64);
    let root = |cell| Task { cell, patterns: patterns.to_vec() };
    let roots = Cell::roots(system.vertical).into_iter().map(root).collect();
    let size = |task: &Task| task.patterns.len();
    let plan = Plan { budget, batch: usize::MAX, worth_threads: WORTH_THREADS, size };
    Search::run(roots, &plan, |_, task| examine_cell(system, settled, task), watch)
}

/// Exclude, contract, prove, cut.
fn examine_cell(system: &System, settled: &Settled, task: &Task) -> Outcome {
    let cell = task.cell.recentred(system);
    let mut outcome = Outcome { tests: task.patterns.len() as u64, ..Outcome::default() };
    let mut noisy = [true; 2];
    let mut asked = Cow::Borrowed(&task.patterns[..]);
    if cell.unit().is_infinite() {
        asked = exclusion::open(system, &cell, &asked).into();
    }
    let (patterns, left, across) = match PatternSums::over(system, &cell) {
        None => {
            noisy = [false; 2];
            let open = exclusion::open(system, &cell, &asked);
            (settled.left(system, &cell, &open).into_owned(), cell, cell.wider())
        }
        Some(sums) => {
            let mut patterns = vec![];
            let mut left: Option<[Interval; 2]> = None;
            let all = sums.open(&asked);
            // What is settled is asked last: few patterns are left, and the sums are shared.
            let of_all: Vec<Pattern> = all.iter().map(|open| open.pattern).collect();
            let unsettled = settled.left(system, &cell, &of_all);
            let mut unsettled = unsettled.iter().copied().peekable();
            for open in all {
                if unsettled.next_if_eq(&open.pattern).is_none() {
                    continue;
                }
                if open.promising {
                    outcome.proofs += 1;
                    let signs: Vec<i8> = open.pattern.signs(system.bars()).collect();
                    match examine(system, &signs, &cell) {
                        Finding::One(zero) => {
                            outcome.found.push((open.pattern, zero));
                            continue;
                        }
                        Finding::None => continue,
                        Finding::Unknown => {}
                    }
                }
                noisy = std::array::from_fn(|k| noisy[k] && open.noisy[k]);
                patterns.push(open.pattern);
                left = Some(left.map_or(open.left, |all| hull(all, open.left)));
            }
            let mut across = sums.widest();
            if settled.straight.are_near(system, &cell) {
                (noisy, across) = ([false; 2], cell.wider());
            }
            (patterns, Cell { face: cell.face, at: left.unwrap_or(cell.at) }, across)
        }
    };
    if patterns.is_empty() {
        return outcome;
    }
    // Cutting is of use across coordinates that are wide and not lost in rounding errors.
    let unit = left.unit();
    let useful = |k: usize| !noisy[k] && left.at[k].width() >= MIN_WIDTH * unit;
    let across = if useful(across) { across } else { 1 - across };
    if !useful(across) {
        outcome.undecided.push(Task { cell: left, patterns });
        return outcome;
    }
    if left.area() < GOOD_CONTRACTION * cell.area() {
        outcome.next.push(Task { cell: left, patterns });
    } else {
        let halves = left.cut(across);
        outcome.next.extend(halves.map(|cell| Task { cell, patterns: patterns.clone() }));
    }
    outcome
}
