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

/// Each change with the tests of its own crate that reach it, quickest first, until one fails or does not end.
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
        let own = |test: &&Test| test.program.krate == mutant.krate();
        let reach = tests.iter().filter(own).filter(|test| test.reaches.contains(&mutant.id));
        let noticed_by = noticed(mutant, reach.clone())?;
        let count = done.fetch_add(1, Relaxed) + 1;
        if count.is_multiple_of(50) {
            eprintln!("{count} of {} changes", mutants.len());
        }
        Ok(Verdict { mutant, reached_by: reach.count(), noticed_by })
    })
}

/// Those that survive, with the tests of other crates that reach them, too.
///
/// # Errors
///
/// Where a test cannot be run.
pub fn shown_to_others<'a>(
    verdicts: &mut [Verdict<'a>],
    tests: &'a [Test<'a>],
    options: &Options,
) -> Result<(), Failure> {
    let alive: Vec<&mut Verdict> = verdicts.iter_mut().filter(|v| v.noticed_by.is_none()).collect();
    let mutants: Vec<&Mutant> = alive.iter().map(|verdict| verdict.mutant).collect();
    let found = parallel(options.jobs, &mutants, |_, mutant| {
        let other = |test: &&Test| {
            test.program.krate != mutant.krate()
                && test.seconds <= options.also_limit
                && test.reaches.contains(&mutant.id)
        };
        let found = noticed(mutant, tests.iter().filter(other))?;
        let fate = found.map_or("open", |test| &test.name);
        eprintln!("{}: {fate}", mutant.name);
        Ok(found)
    })?;
    for (verdict, found) in alive.into_iter().zip(found) {
        verdict.noticed_by = found;
    }
    Ok(())
}

fn noticed<'a>(
    mutant: &Mutant,
    tests: impl Iterator<Item = &'a Test<'a>>,
) -> Result<Option<&'a Test<'a>>, Failure> {
    let id = mutant.id.to_string();
    for test in tests {
        let limit = PATIENCE.0 * test.seconds + PATIENCE.1;
        if run(test.program, &test.name, "MUTANT", id.as_ref(), limit)? != Outcome::Passed {
            return Ok(Some(test));
        }
    }
    Ok(None)
}
