//! Branch and bound over the pull, for all patterns of tension and compression at once.
//!
//! Level by level: every cell of a level is worked on by itself, in parallel, and the results are
//! taken in order. So neither the answer nor the point where the search gives up depends on the
//! number of threads.

pub(crate) mod merge;
pub(crate) mod pattern_sums;
pub(crate) mod undecided;

use std::borrow::Cow;

use crate::branch_and_bound::worked;
use crate::closure::Pattern;
use crate::enclosure::krawczyk::{Finding, Zero, examine};
use crate::plane::cell::Cell;
use crate::plane::system::System;
use crate::search::pattern_sums::PatternSums;
use crate::settings::Settings;
use crate::slack::exclusion;
use crate::slack::straight::Straight;
use crate::slack::unloaded::Unloaded;

/// Below so many tests in a level, threads cost more than they save: waking one takes microseconds,
/// a test a tenth of one.
const WORTH_THREADS: usize = 2_000;

/// Cells of a level worked on before the progress is told: some seconds for long chains.
const AT_ONCE: usize = 65_536;

/// A contracted cell smaller than this part of the old one is looked at again before it is cut.
const GOOD_CONTRACTION: f64 = 0.5;

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

/// All that the search found.
#[derive(Debug, Default)]
pub(crate) struct Search {
    /// Zeros, proved; the same one several times where cells meet.
    pub(crate) zeros: Vec<(Pattern, Zero)>,
    /// Cells that could not be decided.
    pub(crate) undecided: Vec<Task>,
    /// Cells worked on.
    pub(crate) cells: u64,
    /// Tests of one cell for one pattern.
    pub(crate) tests: u64,
    /// Proofs tried.
    pub(crate) proofs: u64,
    /// Levels of the search.
    pub(crate) levels: u32,
    /// Whether the budget of tests ended the search.
    pub(crate) exhausted: bool,
}

#[derive(Debug, Default)]
struct Outcome {
    zeros: Vec<(Pattern, Zero)>,
    next: Vec<Task>,
    undecided: Option<Task>,
    proofs: u64,
}

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
    patterns: Vec<Pattern>,
    watch: &dyn Fn(Progress),
) -> Search {
    let budget = settings.max_tests_per_pattern.saturating_mul(patterns.len() as u64);
    let mut level: Vec<Task> = Cell::roots(system)
        .into_iter()
        .map(|cell| Task { cell, patterns: patterns.clone() })
        .collect();
    drop(patterns);
    let mut search = Search::default();
    while !level.is_empty() {
        if search.tests >= budget {
            search.exhausted = true;
            search.undecided.append(&mut level);
            break;
        }
        let work = |task: &Task| examine_cell(system, settings, settled, task);
        let mut next = vec![];
        let mut left = level.len();
        for some in level.chunks(AT_ONCE) {
            let tests: usize = some.iter().map(|task| task.patterns.len()).sum();
            let outcomes = worked(some, tests, WORTH_THREADS, work);
            left -= some.len();
            search.cells += some.len() as u64;
            search.tests += tests as u64;
            for outcome in outcomes {
                search.zeros.extend(outcome.zeros);
                search.undecided.extend(outcome.undecided);
                search.proofs += outcome.proofs;
                next.extend(outcome.next);
            }
            watch(search.progress(left + next.len()));
        }
        search.levels += 1;
        level = next;
    }
    search
}

impl Search {
    fn progress(&self, waiting: usize) -> Progress {
        Progress {
            done: self.cells,
            waiting: waiting as u64,
            proved: self.zeros.len() as u64,
            undecided: self.undecided.len() as u64,
        }
    }
}

/// Exclude, contract, prove, cut.
fn examine_cell(system: &System, settings: &Settings, settled: &Settled, task: &Task) -> Outcome {
    let cell = task.cell.recentred(system);
    let mut outcome = Outcome::default();
    let mut noisy = [true; 2];
    let mut asked = Cow::Borrowed(&task.patterns[..]);
    if cell.unit().is_infinite() {
        asked = exclusion::open(system, &cell, &asked).into();
    }
    let (patterns, left, across) = match PatternSums::over(system, &cell) {
        None => {
            noisy = [false; 2];
            let open = exclusion::open(system, &cell, &asked);
            (settled.left(system, &cell, &open).into_owned(), cell, wider(&cell))
        }
        Some(sums) => {
            let mut patterns = vec![];
            let mut left: Option<Cell> = None;
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
                            outcome.zeros.push((open.pattern, zero));
                            continue;
                        }
                        Finding::None => continue,
                        Finding::Unknown => {}
                    }
                }
                noisy = std::array::from_fn(|k| noisy[k] && open.noisy[k]);
                patterns.push(open.pattern);
                let part = Cell { face: cell.face, at: open.left };
                left = Some(left.map_or(part, |all| Cell {
                    face: cell.face,
                    at: std::array::from_fn(|k| all.at[k].hull(part.at[k])),
                }));
            }
            let mut across = sums.widest();
            if settled.straight.are_near(system, &cell) {
                (noisy, across) = ([false; 2], wider(&cell));
            }
            (patterns, left.unwrap_or(cell), across)
        }
    };
    if patterns.is_empty() {
        return outcome;
    }
    // Cutting is of use across coordinates that are wide and not lost in rounding errors.
    let unit = left.unit();
    let useful = |k: usize| !noisy[k] && left.at[k].width() >= settings.min_width * unit;
    let across = if useful(across) { across } else { 1 - across };
    if !useful(across) {
        outcome.undecided = Some(Task { cell: left, patterns });
        return outcome;
    }
    let area = |cell: &Cell| cell.at[0].width() * cell.at[1].width();
    if area(&left) < GOOD_CONTRACTION * area(&cell) {
        outcome.next.push(Task { cell: left, patterns });
    } else {
        let halves = left.cut(across);
        outcome.next.extend(halves.map(|cell| Task { cell, patterns: patterns.clone() }));
    }
    outcome
}

fn wider(cell: &Cell) -> usize {
    usize::from(cell.at[1].width() > cell.at[0].width())
}
