//! The paper, judged.

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
    #[must_use]
    pub fn new() -> Self {
        Self
    }

    /// Reproduce.
    ///
    /// # Errors
    ///
    /// [`Error::Reproduction`] when a solver has no answer to the paper's example,
    /// [`Error::Report`] when it cannot be told.
    pub fn run(&self) -> Result<Report, Error> {
        self.run_watched(|_| {})
    }

    /// The same, with `watch` told what is being done.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_watched(&self, watch: impl FnMut(&str)) -> Result<Report, Error> {
        let reproduction = paper::reproduce(watch)?;
        Ok(Report::new(reproduction, Environment::here(std::env::args()))?)
    }
}
