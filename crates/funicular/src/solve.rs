//! The hanging equilibrium, by both solvers.

use std::io::{self, Write};
use std::num::NonZeroUsize;

use model::{AxialForce, Equilibrium, Rung, SolverName, SystemSummary};
use serde::Serialize;
use serde_json::Value;
use validate::Agreement;
use validate::answer::{Answer, Equations, Question, SolverFailure, Solvers, UseCensus, ask};
use validate::systems::SystemFailure;

use crate::csv::Numbers;
use crate::error::Error;
use crate::problem::Problem;
use crate::threads;

/// Version of the JSON objects; raised when a key that others rely on changes its meaning.
pub const SCHEMA_VERSION: u32 = 2;

/// Finds the hanging equilibrium by both solvers, compares, judges and certifies their answers, and
/// looks short chains up in their census.
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
}

impl Solve {
    /// Both solvers, a census where that is quick, and all processors.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Which solvers to ask; one alone gets no comparison.
    #[must_use]
    pub fn solvers(self, solvers: Solvers) -> Self {
        Self { solvers, ..self }
    }

    /// Which equations `lagrange` solves.
    #[must_use]
    pub fn equations(self, equations: Equations) -> Self {
        Self { equations, ..self }
    }

    /// Whether to look the answers up in a census.
    #[must_use]
    pub fn census(self, census: UseCensus) -> Self {
        Self { census, ..self }
    }

    /// How many threads share the work, 0 (the default) for those of the pool that it is called
    /// from. No answer depends on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// Solve.
    ///
    /// # Errors
    ///
    /// [`Error::Unsolved`] when no solver has an answer; if one has, [`SolveAnswer::failures`] says
    /// why the other has none.
    pub fn run(&self, problem: &Problem) -> Result<SolveAnswer, Error> {
        self.run_watched(problem, &|_| {})
    }

    /// The same, with `watch` told what is being done.
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_watched(
        &self,
        problem: &Problem,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<SolveAnswer, Error> {
        threads::on(self.threads, || {
            let threads = NonZeroUsize::new(rayon::current_num_threads());
            self.one(problem, threads.unwrap_or(NonZeroUsize::MIN), watch)
        })?
    }

    pub(crate) fn threads_asked(&self) -> usize {
        self.threads
    }

    pub(crate) fn solvers_asked(&self) -> Solvers {
        self.solvers
    }

    pub(crate) fn census_asked(&self) -> UseCensus {
        self.census
    }

    pub(crate) fn one(
        &self,
        problem: &Problem,
        threads: NonZeroUsize,
        watch: &dyn Fn(&str),
    ) -> Result<SolveAnswer, Error> {
        let chain = problem.as_chain().ok_or(Error::ChainsOnly { what: "solving" })?;
        let Self { solvers, equations, census, .. } = *self;
        let answer = ask(chain, &Question { solvers, equations, census, threads }, watch);
        let answer = SolveAnswer { system: chain.chain().summary(), answer };
        if answer.equilibria().is_empty() {
            return Err(Error::Unsolved(Box::new(answer)));
        }
        Ok(answer)
    }
}

/// What the solvers found, and how far it is proved.
#[derive(Debug, Clone, PartialEq)]
pub struct SolveAnswer {
    system: SystemSummary,
    answer: Answer,
}

impl SolveAnswer {
    /// What was solved.
    #[must_use]
    pub fn system(&self) -> &SystemSummary {
        &self.system
    }

    /// One equilibrium for each solver that has an answer, with its evidence: `lagrange` first.
    #[must_use]
    pub fn equilibria(&self) -> &[Equilibrium] {
        &self.answer.equilibria
    }

    /// The same, given away: no array is copied.
    #[must_use]
    pub fn into_equilibria(self) -> Vec<Equilibrium> {
        self.answer.equilibria
    }

    /// The answer of one solver, if it has one.
    #[must_use]
    pub fn by(&self, solver: &SolverName) -> Option<&Equilibrium> {
        self.answer.by(solver)
    }

    /// Why solvers that were asked have no answer.
    #[must_use]
    pub fn failures(&self) -> &[SolverFailure] {
        &self.answer.failures
    }

    /// The comparison, and the judge's findings, if there are two answers.
    #[must_use]
    pub fn agreement(&self) -> Option<&Agreement> {
        self.answer.agreement.as_ref()
    }

    /// Whether both solvers answered and agree, the judge finds both in balance, and no census
    /// refutes them.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.answer.agrees()
    }

    /// Whether a check has failed: the answers disagree, the judge refuses one, or a complete
    /// census refutes one.
    #[must_use]
    pub fn check_failed(&self) -> bool {
        self.answer.check_failed()
    }

    /// Whether every solver that was asked has an answer, and each has converged or is proved to be
    /// an equilibrium.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.answer.is_decided()
    }

    /// The highest rung that an answer has reached.
    #[must_use]
    pub fn rung(&self) -> Option<Rung> {
        self.equilibria().iter().filter_map(|equilibrium| equilibrium.evidence.rung()).max()
    }

    /// The JSON object without the arrays over joints and bars.
    ///
    /// # Errors
    ///
    /// When a number is not finite, which no answer has.
    pub fn summary(&self) -> serde_json::Result<Value> {
        let bare = |e: &Equilibrium| Equilibrium {
            joints_m: vec![],
            multipliers_n: vec![],
            axial_n: vec![],
            reactions_n: e.reactions_n,
            solver: e.solver.clone(),
            energy_j: e.energy_j,
            stability: e.stability,
            evidence: e.evidence.clone(),
        };
        let equilibria: Vec<Equilibrium> = self.equilibria().iter().map(bare).collect();
        let mut value = serde_json::to_value(self.object(&equilibria))?;
        if let Some(equilibria) = value["equilibria"].as_array_mut() {
            for equilibrium in equilibria.iter_mut().filter_map(Value::as_object_mut) {
                for key in ["joints_m", "multipliers_n", "axial_n"] {
                    equilibrium.remove(key);
                }
            }
        }
        Ok(value)
    }

    /// Joints as CSV, a line per solver and joint: position, and force of bar k+1 on bar k (at
    /// joint 0 of the ground on bar 1, at joint n of the ground on bar n). What is zero but for
    /// rounding is written as 0.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        writeln!(to, "solver,joint,x_m,y_m,z_m,force_x_n,force_y_n,force_z_n")?;
        for e in self.equilibria() {
            let places = Numbers::of(e.joints_m.as_flattened());
            let forces = Numbers::of(e.multipliers_n.as_flattened());
            for (k, (at_m, force_n)) in e.joints_m.iter().zip(&e.multipliers_n).enumerate() {
                let (place, force) = (places.cells(*at_m), forces.cells(*force_n));
                writeln!(to, "{},{k},{place},{force}", e.solver)?;
            }
        }
        Ok(())
    }

    /// Bars as CSV, a line per solver and bar: its joints and its axial force, tension positive, with the
    /// weight at the joints, at both ends, and where it is largest.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_bars_csv(&self, mut to: impl Write) -> io::Result<()> {
        writeln!(to, "solver,bar,from,to,axial_n,axial_from_n,axial_to_n,axial_max_n")?;
        for e in self.equilibria() {
            let forces = Numbers::of(&e.axial_n);
            for (k, (axial_n, along)) in e.axial_n.iter().zip(e.axial_forces()).enumerate() {
                let bar = k + 1;
                let cells = [*axial_n, along.from_n, along.to_n, along.largest_n()]
                    .map(|force| forces.cell(force).to_string())
                    .join(",");
                writeln!(to, "{},{bar},{k},{bar},{cells}", e.solver)?;
            }
        }
        Ok(())
    }

    fn object<'a, E>(&'a self, equilibria: &'a [E]) -> Object<'a, E> {
        Object {
            schema_version: SCHEMA_VERSION,
            system: &self.system,
            equilibria,
            agreement: self.agreement(),
            failures: self.failures().iter().map(Failure::of).collect(),
        }
    }
}

/// As `funicular solve --json` prints it.
impl Serialize for SolveAnswer {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let equilibria: Vec<_> = self.equilibria().iter().map(WithEnds::of).collect();
        self.object(&equilibria).serialize(serializer)
    }
}

#[derive(Serialize)]
struct Object<'a, E> {
    schema_version: u32,
    system: &'a SystemSummary,
    equilibria: &'a [E],
    agreement: Option<&'a Agreement>,
    failures: Vec<Failure>,
}

/// An equilibrium with the axial forces of its bars at their ends.
#[derive(Serialize)]
struct WithEnds<'a> {
    #[serde(flatten)]
    equilibrium: &'a Equilibrium,
    axial_from_n: Vec<f64>,
    axial_to_n: Vec<f64>,
    axial_max_n: Vec<f64>,
}

impl<'a> WithEnds<'a> {
    fn of(equilibrium: &'a Equilibrium) -> Self {
        let axial = equilibrium.axial_forces();
        Self {
            equilibrium,
            axial_from_n: axial.iter().map(|along| along.from_n).collect(),
            axial_to_n: axial.iter().map(|along| along.to_n).collect(),
            axial_max_n: axial.iter().map(AxialForce::largest_n).collect(),
        }
    }
}

/// A solver without an answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// Its name.
    pub solver: SolverName,
    /// Why it has none, in words.
    pub reason: String,
    /// The same with its numbers: the object of the error, under `kind` its name.
    pub refusal: Value,
}

impl Failure {
    /// As JSON has it.
    #[must_use]
    pub fn of(failure: &SolverFailure) -> Self {
        Self::new(failure.solver(), failure)
    }

    /// The same for a system.
    #[must_use]
    pub fn of_system(failure: &SystemFailure) -> Self {
        Self::new(failure.solver(), failure)
    }

    fn new(solver: SolverName, failure: &(impl ToString + Serialize)) -> Self {
        // Errors are numbers and texts, which JSON has.
        let refusal = serde_json::to_value(failure).unwrap_or_default();
        Self { solver, reason: failure.to_string(), refusal }
    }
}
