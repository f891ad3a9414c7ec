//! The paper, judged.

use std::ops::Deref;

use report::{Environment, Report};

use crate::error::Error;

/// Reproduces the paper: its claims, what both solvers find, and the verdicts.
///
/// ```no_run
/// use funicular::prelude::*;
/// let report = Reproduce::new().run()?;
/// assert!(report.reproduction().all_as_expected);
/// std::fs::write("report.html", report.html()).ok();
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Reproduce;

impl Reproduce {
    /// As the paper has it.
    pub fn new() -> Self {
        Self
    }

    /// Reproduce.
    ///
    /// # Errors
    /// [`Error::Reproduction`] when a solver has no answer to the paper's example,
    /// [`Error::Report`] when it cannot be told.
    pub fn run(&self) -> Result<ReproduceAnswer, Error> {
        self.run_watched(|_| {})
    }

    /// The same, with `watch` told what is being done.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_watched(&self, watch: impl FnMut(&str)) -> Result<ReproduceAnswer, Error> {
        let reproduction = paper::reproduce(watch)?;
        Ok(ReproduceAnswer(Report::new(reproduction, Environment::here(std::env::args()))?))
    }
}

/// The paper, judged: a report, which prints as a table.
#[derive(Debug)]
pub struct ReproduceAnswer(Report);

impl Deref for ReproduceAnswer {
    type Target = Report;

    fn deref(&self) -> &Report {
        &self.0
    }
}
