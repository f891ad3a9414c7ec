//! The hanging equilibrium, by both solvers.

mod answer;
mod object;

pub use self::answer::SolveAnswer;
pub(crate) use self::object::Named;
pub use self::object::{Failure, Lists};

use std::num::{NonZeroU64, NonZeroUsize};

use model::Vector;
use rayon::prelude::*;
use validate::systems::ask_with;
use validate::{Equations, Question, Solvers, UseCensus};

use crate::error::Error;
use crate::problem::Problem;
use crate::threads;

/// What is refused of other systems.
const FULL: &str = "the lowest equilibrium by the paper's full equations";

/// Finds the hanging equilibrium by both solvers, compares, judges and certifies their answers, and
/// proves them in interval arithmetic: of any chain between two anchors, and of any network of
/// bars, cables and struts, rigid or elastic, under weights and constant forces.
///
/// ```
/// use funicular::prelude::*;
/// let problem = Problem::case("two-bars")?;
/// let answer = Solve::new().census(UseCensus::Never).run(&problem)?;
/// let [lagrange, energy] = answer.equilibria() else { panic!("both have an answer") };
/// assert!((lagrange.energy_j - energy.energy_j).abs() < 1e-12);
/// assert!(answer.agrees());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Solve {
    solvers: Solvers,
    equations: Equations,
    census: UseCensus,
    threads: usize,
    max_work: Option<NonZeroU64>,
}

impl Solve {
    /// Both solvers, a census where that is quick, and all processors.
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// Which solvers to ask; one alone gets no comparison.
        solvers: Solvers,
        /// Which equations `lagrange` solves for a row of rigid bars between two anchors.
        equations: Equations,
        /// Whether to prove the answers in interval arithmetic, and to look them up in a census.
        census: UseCensus,
        /// How many threads share the work, 0 (the default) for those of the pool that it is called
        /// from. No answer depends on it.
        threads: usize,
        /// The work that each solver may do, numbers in all factors of its matrices, or bars times passes
        /// over a row between two anchors: iterations times size, the same on every machine. What needs
        /// more has no answer, and says so. Without it 10^10, up to an hour or so.
        ///
        /// ```
        /// use funicular::prelude::*;
        /// let answer = Solve::new().max_work(std::num::NonZeroU64::MIN).run(&Problem::case("bridle")?);
        /// assert!(answer.unwrap_err().to_string().contains("max_work is 1"));
        /// # Ok::<(), Error>(())
        /// ```
        max_work: NonZeroU64 => Some(max_work),
    }

    /// Solve.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// // A lamp of 2 kg on two cables of 5 m between anchors 6 m apart: each pulls with 5/4 of
    /// // 10 N.
    /// let joints = vec![
    ///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
    ///     Joint::anchor("B", [3.0, 0.0, 0.0]),
    ///     Joint::free("lamp").with_mass(2.0),
    /// ];
    /// let body = Bar::homogeneous(5.0, 0.0)?;
    /// let members = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
    /// let system = System::new("a lamp", 10.0, joints, members)?;
    /// let answer = Solve::new().run(&system.into())?;
    /// assert!(answer.agrees());
    /// let hanging = &answer.equilibria()[0];
    /// assert!((hanging.axial_n[0] - 12.5).abs() < 1e-9);
    /// assert!((hanging.joints_m[2][2] + 4.0).abs() < 1e-9);
    /// assert_eq!(hanging.evidence.rung(), Some(Rung::Optimal));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Refused`] when the system has no equilibrium; [`Error::ChainsOnly`] when the
    /// full equations are asked for of another system or next to a drawing; [`Error::Unsolved`] when no
    /// solver has an answer; if one has, [`SolveAnswer::failures`] says why the other has none.
    pub fn run(&self, problem: &Problem) -> Result<SolveAnswer, Error> {
        self.run_watched(problem, &|_| {})
    }

    /// The same, with `watch` called with what is being done.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<SolveAnswer, Error> {
        threads::on(self.threads, || {
            let threads = NonZeroUsize::new(rayon::current_num_threads());
            self.on(problem, threads.unwrap_or(NonZeroUsize::MIN), watch)
        })?
    }

    /// Do what is shared out on the threads that are wanted.
    pub(crate) fn on_threads<T: Send>(&self, work: impl FnOnce() -> T + Send) -> Result<T, Error> {
        threads::on(self.threads, work)
    }

    /// Solve for the equilibrium next to a shape, a place for every joint, m, by both solvers: see
    /// [`Problem::near`]. [`SolveAnswer::near`] says how the answer lies to the shape.
    ///
    /// # Errors
    /// As [`Problem::near`] and [`run`](Self::run).
    pub fn near(&self, problem: &Problem, joints_m: &[Vector]) -> Result<SolveAnswer, Error> {
        self.run(&problem.near(joints_m)?)
    }

    /// Solve many problems in parallel, each on one thread. The answers are in the order of the
    /// problems, and each is that of [`run`](Self::run) but for the times. A census takes far longer
    /// than a solution: say [`census(UseCensus::Never)`](Self::census) where many are solved.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// let problems = [Problem::case("two-bars")?, Problem::case("three-equal-bars")?];
    /// let answers = Solve::new().census(UseCensus::Never).run_all(&problems)?;
    /// assert!(answers.iter().all(|answer| answer.as_ref().is_ok_and(|answer| answer.agrees())));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::TooManyThreads`] and [`Error::Threads`]; what becomes of a problem stands in its
    /// place.
    pub fn run_all(&self, problems: &[Problem]) -> Result<Vec<Result<SolveAnswer, Error>>, Error> {
        threads::on(self.threads, || {
            problems.par_iter().map(|problem| self.run_here(problem)).collect()
        })
    }

    /// Solve on the thread of the caller, for programs that share out many problems themselves. (A
    /// census, where one is asked for, uses the threads of the pool.)
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_here(&self, problem: &Problem) -> Result<SolveAnswer, Error> {
        self.on(problem, NonZeroUsize::MIN, &|_| {})
    }

    fn on(
        &self,
        problem: &Problem,
        threads: NonZeroUsize,
        watch: &dyn Fn(&str),
    ) -> Result<SolveAnswer, Error> {
        let system = problem.system();
        system.refusal()?;
        let Self { solvers, equations, census, max_work, .. } = *self;
        let is_row = || problem.row().is_some() && system.drawing().is_none();
        if equations == Equations::Full && !is_row() {
            return Err(Error::ChainsOnly(FULL));
        }
        let question = Question { solvers, equations, census, threads, max_work };
        let answer = ask_with(&system, &question, watch);
        let answer = SolveAnswer::new(system, answer);
        if answer.equilibria().is_empty() {
            return Err(Error::Unsolved(Box::new(answer)));
        }
        Ok(answer)
    }
}
