//! Branch and bound: tasks are worked on, and those they leave, until none is left or the budget is
//! spent.
//!
//! A batch of tasks at a time, each by itself and in parallel, the results taken in order. So
//! neither the answer nor the point where a search gives up depends on the number of threads.

use numerics::{Interval, in_parallel};

use crate::run::search::Progress;

/// How far a search goes, and in what steps.
pub(crate) struct Plan<T> {
    /// Tests after which all tasks that wait are undecided.
    pub(crate) budget: u64,
    /// Tasks that are worked on together, the latest first: all that wait go level by level, few
    /// of them go deep first and leave little waiting.
    pub(crate) batch: usize,
    /// Below so many expected tests in a batch, threads cost more than they save.
    pub(crate) worth_threads: usize,
    /// Expected tests of a task.
    pub(crate) size: fn(&T) -> usize,
}

/// What comes of a task.
#[derive(Debug)]
pub(crate) struct Outcome<F, T> {
    /// What was proved.
    pub(crate) found: Vec<F>,
    /// What is to be worked on next.
    pub(crate) next: Vec<T>,
    /// What cannot be decided.
    pub(crate) undecided: Vec<T>,
    /// Tests that it took, those of Newton's method included.
    pub(crate) tests: u64,
    /// Proofs of existence tried.
    pub(crate) proofs: u64,
}

impl<F, T> Default for Outcome<F, T> {
    fn default() -> Self {
        Self { found: vec![], next: vec![], undecided: vec![], tests: 0, proofs: 0 }
    }
}

/// Tasks of a batch worked on before the progress is told: some seconds for long chains.
const AT_ONCE: usize = 65_536;

/// All that a search found.
#[derive(Debug)]
pub(crate) struct Search<F, T> {
    /// What was proved; the same several times where tasks meet.
    pub(crate) found: Vec<F>,
    /// What could not be decided.
    pub(crate) undecided: Vec<T>,
    /// Tasks worked on.
    pub(crate) cells: u64,
    /// Tests that they took.
    pub(crate) tests: u64,
    /// Proofs of existence tried.
    pub(crate) proofs: u64,
    /// Batches of tasks; without a limit to them the levels of the search.
    pub(crate) batches: u32,
    /// Whether the budget of tests ended the search.
    pub(crate) exhausted: bool,
}

impl<F: Send + Sync, T: Send + Sync> Search<F, T> {
    /// Work on all tasks that come of the roots. `work` hears what was found in earlier batches,
    /// `watch` of the progress after each, and within large ones.
    pub(crate) fn run(
        roots: Vec<T>,
        plan: &Plan<T>,
        work: impl Fn(&[F], &T) -> Outcome<F, T> + Sync,
        watch: &dyn Fn(Progress),
    ) -> Self {
        let mut search = Self {
            found: vec![],
            undecided: vec![],
            cells: 0,
            tests: 0,
            proofs: 0,
            batches: 0,
            exhausted: false,
        };
        let mut waiting = roots;
        while !waiting.is_empty() {
            if search.tests >= plan.budget {
                search.exhausted = true;
                search.undecided.append(&mut waiting);
                break;
            }
            let batch = waiting.split_off(waiting.len().saturating_sub(plan.batch));
            let mut left = batch.len();
            for some in batch.chunks(AT_ONCE) {
                let known = &search.found;
                let of_task = |task: &T| work(known, task);
                let size = some.iter().map(plan.size).fold(0, usize::saturating_add);
                let outcomes = worked(some, size, plan.worth_threads, of_task);
                left -= some.len();
                search.cells += some.len() as u64;
                for outcome in outcomes {
                    search.found.extend(outcome.found);
                    search.undecided.extend(outcome.undecided);
                    search.tests += outcome.tests;
                    search.proofs += outcome.proofs;
                    waiting.extend(outcome.next);
                }
                watch(Progress {
                    done: search.cells,
                    waiting: (left + waiting.len()) as u64,
                    proved: search.found.len() as u64,
                    undecided: search.undecided.len() as u64,
                });
            }
            search.batches += 1;
        }
        search
    }
}

/// The first coordinate of the largest width, and that.
pub(crate) fn widest(at: &[Interval]) -> (usize, f64) {
    at.iter().enumerate().fold((0, 0.0), |(best, width), (k, part)| {
        if part.width() > width { (k, part.width()) } else { (best, width) }
    })
}

/// Whether a box holds all of another one.
pub(crate) fn encloses(all: &[Interval], part: &[Interval]) -> bool {
    all.iter().zip(part).all(|(all, part)| all.encloses(*part))
}

/// The smallest box around two.
pub(crate) fn hull<const N: usize>(a: [Interval; N], b: [Interval; N]) -> [Interval; N] {
    std::array::from_fn(|k| a[k].hull(b[k]))
}

/// A box cut in two halves across one coordinate.
pub(crate) fn halves<const N: usize>(at: [Interval; N], across: usize) -> [[Interval; N]; 2] {
    let middle = at[across].mid();
    let parts = [Interval::new(at[across].lo(), middle), Interval::new(middle, at[across].hi())];
    parts.map(|part| {
        let mut half = at;
        half[across] = part;
        half
    })
}

/// What comes of each task, in order: by several threads where at least so many tests are expected
/// of all.
pub(crate) fn worked<T: Sync, R: Send>(
    tasks: &[T],
    tests: usize,
    worth_threads: usize,
    work: impl Fn(&T) -> R + Sync,
) -> Vec<R> {
    if tests < worth_threads {
        tasks.iter().map(work).collect()
    } else {
        in_parallel(tasks.len(), 1, |k| work(&tasks[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers below 64 that a task of a power of two covers: multiples of 7 are found one by one,
    /// 13 cannot be decided.
    fn numbers(budget: u64, batch: usize, worth_threads: usize) -> Search<u32, (u32, u32)> {
        let plan = Plan { budget, batch, worth_threads, size: |_| 1 };
        let work = |_: &[u32], &(from, count): &(u32, u32)| {
            let mut outcome = Outcome { tests: 1, ..Outcome::default() };
            match count {
                1 if from == 13 => outcome.undecided.push((from, count)),
                1 if from % 7 == 0 => outcome.found.push(from),
                1 => {}
                _ => outcome.next.extend([(from, count / 2), (from + count / 2, count / 2)]),
            }
            outcome
        };
        Search::run(vec![(0, 64)], &plan, work, &|_| {})
    }

    #[test]
    fn all_is_found_in_the_same_order_whatever_the_threads() {
        for batch in [1, 3, usize::MAX] {
            let search = numbers(u64::MAX, batch, usize::MAX);
            let mut found = search.found.clone();
            found.sort_unstable();
            assert_eq!(found, (0..10).map(|k| 7 * k).collect::<Vec<_>>());
            assert_eq!((search.cells, search.tests, search.exhausted), (127, 127, false));
            assert_eq!(search.undecided, [(13, 1)]);
            assert_eq!(numbers(u64::MAX, batch, 0).found, search.found);
        }
    }

    #[test]
    fn what_waits_when_the_budget_is_spent_is_undecided() {
        let search = numbers(3, usize::MAX, 0);
        assert!(search.exhausted && search.found.is_empty());
        assert_eq!(search.undecided, [(0, 16), (16, 16), (32, 16), (48, 16)]);
    }

    #[test]
    fn the_first_of_the_widest_is_cut() {
        let of = |widths: &[f64]| {
            let parts: Vec<Interval> = widths.iter().map(|x| Interval::new(0.0, *x)).collect();
            widest(&parts)
        };
        assert_eq!([of(&[1.0, 4.0, 2.0, 4.0]).0, of(&[0.0; 3]).0], [1, 0]);
        assert!((of(&[1.0, 4.0, 2.0, 4.0]).1 - 4.0).abs() < 1e-14);
    }

    /// 64 tasks of three expected tests each.
    #[test]
    fn few_expected_tests_wake_no_thread() {
        let in_pool = |worth_threads| {
            let plan =
                Plan { budget: u64::MAX, batch: usize::MAX, worth_threads, size: |_: &u32| 3 };
            let work = |_: &[bool], _: &u32| Outcome {
                found: vec![rayon::current_thread_index().is_some()],
                ..Outcome::default()
            };
            Search::run((0..64).collect(), &plan, work, &|_| {}).found
        };
        assert_eq!(in_pool(3 * 64 + 1), [false; 64]);
        assert_eq!(in_pool(3 * 64), [true; 64]);
    }
}
