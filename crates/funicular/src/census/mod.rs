//! Every equilibrium of a chain, with proof.

mod answer;
mod csv;

pub use answer::{CensusAnswer, Check, Enclosure, Enclosures, Found, Open, Slack, Summary};

use census::{Progress, Settings};

use crate::error::Error;
use crate::problem::Problem;
use crate::threads;

/// Finds every equilibrium of a chain, stable or not, and proves that there is no other.
///
/// ```
/// use funicular::prelude::*;
/// let found = Census::new().run(&Problem::case("three-equal-bars")?)?;
/// assert!(found.census.complete && found.census.check.passed);
/// // E1, E2 and their mirror images, on two circles.
/// assert_eq!((found.equilibria.len(), found.census.circle_count), (4, Some(2)));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Census {
    settings: Settings,
    threads: usize,
}

impl Census {
    /// Chains of up to 12 bars, on all processors.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Refuse chains of more bars, with an estimate of what they would cost; at most
    /// [`Settings::MAX_BARS`].
    #[must_use]
    pub fn max_bars(mut self, max_bars: usize) -> Self {
        self.settings.max_bars = max_bars;
        self
    }

    /// All settings of the search.
    #[must_use]
    pub fn settings(self, settings: Settings) -> Self {
        Self { settings, ..self }
    }

    /// How many threads share the work, 0 (the default) for those of the pool that it is called
    /// from. The answer does not depend on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// Take the census, and check it.
    ///
    /// # Errors
    ///
    /// [`Error::Census`] when the chain is too long. What cannot be decided is no error: it is
    /// listed, and the census is not complete.
    pub fn run(&self, problem: &Problem) -> Result<CensusAnswer, Error> {
        self.run_watched(problem, &|_| {})
    }

    /// The same, with `watch` told how far it is.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(Progress) + Sync),
    ) -> Result<CensusAnswer, Error> {
        let problem = problem.chain_for("a census")?;
        threads::on(self.threads, || {
            let census = census::Census::take_watched(problem, &self.settings, watch)?;
            let verdict = census.check(problem);
            Ok(CensusAnswer::new(problem, census, verdict))
        })?
    }
}
