//! Every equilibrium of a chain or a system, with proof.

mod answer;
mod csv;
mod large;
mod lines;
mod system;

pub use answer::{CensusAnswer, Check, Enclosure, Enclosures, Found, Merged, Open, Slack, Summary};
pub use large::{LargeCensusAnswer, Line, List};
pub use system::SystemCensusAnswer;

use census::network::SystemCensus;
use census::{CompactCensus, Progress, Settings};
use model::system::System;

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
    /// Chains of up to 16 bars, on all processors.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Refuse chains and bridles of more bars, with an estimate of what they would cost; at most
    /// [`Settings::MAX_BARS`].
    #[must_use]
    pub fn max_bars(mut self, max_bars: usize) -> Self {
        self.settings.max_bars = max_bars;
        self.settings.max_bridle_bars = max_bars;
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
        let problem = problem.as_chain().ok_or(Error::ChainsOnly { what: "a census" })?;
        threads::on(self.threads, || {
            let census = census::Census::take_watched(problem, &self.settings, watch)?;
            let verdict = census.check(problem);
            Ok(CensusAnswer::new(problem, census, verdict))
        })?
    }

    /// Take the census of a chain with more equilibria than are good to hold in memory: of each only
    /// its signs, its pull and its index are kept, and the rest is made when it is written. The
    /// first so many are made at once.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    ///
    /// ```
    /// use funicular::census::List;
    /// use funicular::prelude::*;
    /// let found = Census::new().run_large(&Problem::case("three-equal-bars")?, 1, &|_| {})?;
    /// assert_eq!((found.first.equilibria.len(), found.first.census.count), (2, 4));
    /// let mut lines = vec![];
    /// found.write_csv(List::Signs, &mut lines).expect("memory can be written");
    /// // The two circles, and the names of the columns.
    /// assert_eq!(lines.iter().filter(|byte| **byte == b'\n').count(), 3);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn run_large(
        &self,
        problem: &Problem,
        made: usize,
        watch: &(dyn Fn(Progress) + Sync),
    ) -> Result<LargeCensusAnswer, Error> {
        let problem = problem.as_chain().ok_or(Error::ChainsOnly { what: "a census" })?;
        threads::on(self.threads, || {
            let census = CompactCensus::take(problem, &self.settings, watch)?;
            let verdict = census.check(problem);
            Ok(LargeCensusAnswer::new(problem, census, verdict, made))
        })?
    }

    /// Take the census of a system of joints and members: trees, chains of bars between anchors
    /// with trees and weights at their joints, frames, nets of several closures whose joints move
    /// in few ways (one joint held by strands of one or two bars), three strands of any number of
    /// bars under upright loads, and any number of such parts.
    ///
    /// # Errors
    ///
    /// [`Error::SystemRefused`] when the system has no equilibrium, [`Error::SystemCensus`] when it
    /// has no census: nets that move in too many ways, level loads on a chain, elastic members.
    /// What cannot be decided is no error: it is listed, and the census is not complete.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// // A pendulum of two bars hangs, stands, and folds up twice.
    /// let joints = vec![
    ///     Joint::anchor("A", [0.0, 0.0, 0.0]),
    ///     Joint::free("P").with_mass(1.0),
    ///     Joint::free("Q").with_mass(1.0),
    /// ];
    /// let body = Bar::homogeneous(1.0, 0.0)?;
    /// let members = vec![Member::bar(0, 1, body), Member::bar(1, 2, body)];
    /// let system = System::new("double pendulum", 10.0, joints, members)?;
    /// let found = Census::new().run_system(&system)?;
    /// assert!(found.proven().complete);
    /// let energies: Vec<f64> = found.equilibria().iter().map(|e| e.energy_j.round()).collect();
    /// assert_eq!(energies, [-30.0, -10.0, 10.0, 30.0]);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn run_system(&self, system: &System) -> Result<SystemCensusAnswer, Error> {
        self.run_system_watched(system, &|_| {})
    }

    /// The same, with `watch` told how far the search of each part is.
    ///
    /// # Errors
    ///
    /// As [`run_system`](Self::run_system).
    pub fn run_system_watched(
        &self,
        system: &System,
        watch: &(dyn Fn(Progress) + Sync),
    ) -> Result<SystemCensusAnswer, Error> {
        system.refusal()?;
        threads::on(self.threads, || {
            let census = SystemCensus::take_watched(system, &self.settings, watch)
                .map_err(Error::SystemCensus)?;
            Ok(SystemCensusAnswer::new(system, census))
        })?
    }
}
