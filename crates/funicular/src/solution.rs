//! The answer to a problem of either kind.

use std::num::NonZeroUsize;

use model::{Rung, Vector};
use rayon::prelude::*;
use serde::Serialize;

use crate::error::Error;
use crate::problem::Problem;
use crate::solve::{Solve, SolveAnswer};
use crate::system::SystemSolution;
use crate::threads;

/// What the solvers found for a [`Problem`]: for a chain between two anchors, or for another
/// system.
#[derive(Debug, Clone, PartialEq)]
pub enum Solution {
    /// Of a chain.
    Chain(SolveAnswer),
    /// Of any other system.
    System(SystemSolution),
}

impl Solution {
    /// The answer for a chain, if it is one.
    #[must_use]
    pub fn as_chain(&self) -> Option<&SolveAnswer> {
        match self {
            Self::Chain(answer) => Some(answer),
            Self::System(_) => None,
        }
    }

    /// The answer for a system of joints and members, if it is one.
    #[must_use]
    pub fn as_system(&self) -> Option<&SystemSolution> {
        match self {
            Self::Chain(_) => None,
            Self::System(answer) => Some(answer),
        }
    }

    /// Whether both solvers answered and agree, and no check has failed.
    #[must_use]
    pub fn agrees(&self) -> bool {
        match self {
            Self::Chain(answer) => answer.agrees(),
            Self::System(answer) => answer.agrees(),
        }
    }

    /// Whether a check has failed: the answers disagree, the judge refuses one, or a complete
    /// census refutes one.
    #[must_use]
    pub fn check_failed(&self) -> bool {
        match self {
            Self::Chain(answer) => answer.check_failed(),
            Self::System(answer) => answer.check_failed(),
        }
    }

    /// Whether every solver that was asked has an answer, and each has converged or is proved to be
    /// an equilibrium.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        match self {
            Self::Chain(answer) => answer.is_decided(),
            Self::System(answer) => answer.is_decided(),
        }
    }

    /// The highest rung that an answer has reached.
    #[must_use]
    pub fn rung(&self) -> Option<Rung> {
        match self {
            Self::Chain(answer) => answer.rung(),
            Self::System(answer) => answer.rung(),
        }
    }
}

/// As `funicular solve --json` prints it.
impl Serialize for Solution {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Chain(answer) => answer.serialize(serializer),
            Self::System(answer) => answer.serialize(serializer),
        }
    }
}

impl Solve {
    /// Solve a problem of either kind: [`run`](Self::run) for a chain,
    /// [`run_system`](Self::run_system) for another system.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// let text = r#"{
    ///     "joints": {"A": {"at_m": [-3, 0, 0]}, "B": {"at_m": [3, 0, 0]}, "P": {"mass_kg": 2}},
    ///     "gravity_m_s2": 10,
    ///     "bars": [{"from": "A", "to": "P", "length_m": 5, "mass_kg": 0},
    ///              {"from": "P", "to": "B", "length_m": 5, "mass_kg": 0}]
    /// }"#;
    /// let solution = Solve::new().run_any(&Problem::parse(text, "lamp.json")?)?;
    /// assert!(solution.agrees());
    /// // By the triangle 3, 4, 5.
    /// assert!((solution.as_system().unwrap().equilibria()[0].axial_n[0] - 12.5).abs() < 1e-9);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run) and [`run_system`](Self::run_system).
    pub fn run_any(&self, problem: &Problem) -> Result<Solution, Error> {
        self.run_any_watched(problem, &|_| {})
    }

    /// The same, with `watch` told what is being done.
    ///
    /// # Errors
    ///
    /// As [`run_any`](Self::run_any).
    pub fn run_any_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<Solution, Error> {
        match problem.as_system() {
            Some(system) => self.run_system_watched(system, watch).map(Solution::System),
            None => self.run_watched(problem, watch).map(Solution::Chain),
        }
    }

    /// Solve for the equilibrium next to a shape, a place for every joint, m, by both solvers: see
    /// [`Problem::near`]. [`SystemSolution::near`] says how the answer lies to the shape.
    ///
    /// # Errors
    ///
    /// As [`Problem::near`] and [`run_any`](Self::run_any).
    pub fn near(&self, problem: &Problem, joints_m: &[Vector]) -> Result<Solution, Error> {
        self.run_any(&problem.near(joints_m)?)
    }

    /// Solve many problems in parallel, each on one thread. The answers are in the order of the
    /// problems, and each is that of [`run_any`](Self::run_any) but for the times. A census is
    /// looked up for each short chain, which takes far longer than to solve it: say
    /// [`census(UseCensus::Never)`](Self::census) where many are solved.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// let problems = [Problem::case("two-bars")?, Problem::case("three-equal-bars")?];
    /// let solutions = Solve::new().census(UseCensus::Never).run_all(&problems)?;
    /// assert!(solutions.iter().all(|answer| answer.as_ref().is_ok_and(|answer| answer.agrees())));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::TooManyThreads`] and [`Error::Threads`]; what becomes of a problem stands in its
    /// place.
    pub fn run_all(&self, problems: &[Problem]) -> Result<Vec<Result<Solution, Error>>, Error> {
        threads::on(self.threads_asked(), || {
            problems.par_iter().map(|problem| self.run_here(problem)).collect()
        })
    }

    /// Solve a problem of either kind on the thread of the caller, for programs that share out many
    /// problems themselves. (A census, where one is asked for, uses the threads of the pool.)
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run) and [`run_system`](Self::run_system).
    pub fn run_here(&self, problem: &Problem) -> Result<Solution, Error> {
        match problem.as_system() {
            Some(system) => self.threads(0).run_system(system).map(Solution::System),
            None => self.one(problem, NonZeroUsize::MIN, &|_| {}).map(Solution::Chain),
        }
    }
}
