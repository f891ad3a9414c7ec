//! Which changes are noticed, and by what.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use crate::options::Options;
use crate::tests::{Outcome, Test, parallel, run};
use crate::{Failure, Mutant};

/// A change of the clock's speed by the load, and the start of a program.
const PATIENCE: (f64, f64) = (5.0, 5.0);

/// What became of one change.
pub struct Verdict<'a> {
    pub mutant: &'a Mutant,
    /// Of the crate's own.
    pub reached_by: usize,
    pub noticed_by: Option<&'a Test<'a>>,
}

/// Each change with the tests that reach it, the crate's own first, quickest first, until one fails or does not end.
///
/// # Errors
///
/// Where a test cannot be run.
pub fn judged<'a>(
    mutants: &'a [Mutant],
    tests: &'a [Test<'a>],
    options: &Options,
) -> Result<Vec<Verdict<'a>>, Failure> {
    let done = AtomicUsize::new(0);
    parallel(options.jobs, mutants, |_, mutant| {
        let reach = |own: bool| {
            tests.iter().filter(move |test| {
                (test.program.krate == options.krate) == own && test.reaches.contains(&mutant.id)
            })
        };
        let mut noticed_by = None;
        for test in reach(true).chain(reach(false)) {
            let limit = PATIENCE.0 * test.seconds + PATIENCE.1;
            let id = mutant.id.to_string();
            if run(test.program, &test.name, "MUTANT", id.as_ref(), limit)? != Outcome::Passed {
                noticed_by = Some(test);
                break;
            }
        }
        let count = done.fetch_add(1, Relaxed) + 1;
        if count.is_multiple_of(50) {
            eprintln!("{count} of {} changes", mutants.len());
        }
        Ok(Verdict { mutant, reached_by: reach(true).count(), noticed_by })
    })
}
