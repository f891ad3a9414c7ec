//! One question to both solvers: their answers compared, judged, certified, and looked up in the
//! census.
//!
//! Whoever wants the hanging equilibrium of a chain with all its evidence asks here; what each part
//! proves is said in [`compare`](mod@crate::compare), [`statics`](crate::statics),
//! [`certificate`](crate::certificate) and [`completeness`](crate::completeness).
//!
//! ```
//! use validate::answer::{Question, ask};
//! let answer = ask(&model::cases::paper(), &Question::default(), &|_| {});
//! assert!(answer.agreement.is_some_and(|agreement| agreement.agrees()));
//! assert!(answer.equilibria.iter().all(|e| e.evidence.rung() == Some(model::Rung::Optimal)));
//! ```

use census::{Census, Topology, TopologyError};
use model::{Equilibrium, NoAnswer, Problem, SolverName};
use serde::Serialize;

use crate::compare::{Agreement, compare, judge_alone, judge_without};
use crate::completeness::{certify_by_census, without_census};
pub use crate::question::{Equations, Question, Solvers, UseCensus};
use crate::tolerances::Tolerances;

/// Tests per pattern for that: several times what generic chains need, and a second or so at most.
/// A degenerate chain is left undecided; a census that is asked for takes its time.
const CENSUS_TESTS: u64 = 2_000;

/// The same where the lengths fit into a straight line, so that the census cannot be complete: what
/// generic chains need for each of their equilibria.
const CENSUS_TESTS_STRAIGHT: u64 = 400;

/// Both answers with what is known of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// One for each solver that has an answer, with its evidence: `lagrange` first.
    pub equilibria: Vec<Equilibrium>,
    /// Why the other solvers that were asked have none.
    pub failures: Vec<SolverFailure>,
    /// The comparison, if there are two to compare.
    pub agreement: Option<Agreement>,
}

/// Why a solver has no answer.
#[derive(Debug, Clone, PartialEq, Serialize, thiserror::Error)]
#[serde(untagged)]
#[non_exhaustive]
pub enum SolverFailure {
    /// Occurs when `lagrange` does not converge on the full system.
    #[error("lagrange: {0}")]
    Full(#[from] lagrange::SolveError),
    /// Occurs when `lagrange` does not converge on the condensed system.
    #[error("lagrange: {0}")]
    Condensed(#[from] lagrange::condensed::CondensedError),
    /// Occurs when `energy` does not converge.
    #[error("energy: {0}")]
    Energy(#[from] energy::Error),
}

impl SolverFailure {
    /// The solver that has no answer.
    #[must_use]
    pub fn solver(&self) -> SolverName {
        match self {
            Self::Full(_) | Self::Condensed(_) => SolverName::LAGRANGE,
            Self::Energy(_) => SolverName::ENERGY,
        }
    }
}

impl Answer {
    /// The answer of one solver, if it has one.
    #[must_use]
    pub fn by(&self, solver: &SolverName) -> Option<&Equilibrium> {
        self.equilibria.iter().find(|equilibrium| equilibrium.solver == *solver)
    }

    /// Whether both solvers answered and agree, the judge finds both in balance, and no census
    /// refutes them.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.agreement.as_ref().is_some_and(Agreement::agrees) && !self.check_failed()
    }

    /// Whether a check has failed: the answers disagree, the judge refuses one, or a complete
    /// census refutes one.
    #[must_use]
    pub fn check_failed(&self) -> bool {
        self.equilibria.iter().any(|answer| answer.evidence.ladder.failed())
    }

    /// Whether every solver that was asked has an answer, and each has converged or is proved to be
    /// an equilibrium.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        let known = |answer: &Equilibrium| {
            let ladder = &answer.evidence.ladder;
            // A box around the answer proves more than a residual.
            ladder.converged.is_reached() || ladder.verified.is_reached()
        };
        self.failures.is_empty() && self.equilibria.iter().all(known)
    }
}

/// Ask. `watch` is told what is being done.
///
/// A solver that has no answer does not take the other's away: see [`Answer::failures`].
#[must_use]
pub fn ask(problem: &Problem, question: &Question, watch: &dyn Fn(&str)) -> Answer {
    ask_within(problem, question, &Tolerances::project(), watch)
}

/// The same, judged by other tolerances.
pub(crate) fn ask_within(
    problem: &Problem,
    question: &Question,
    tolerances: &Tolerances,
    watch: &dyn Fn(&str),
) -> Answer {
    let bars = problem.chain().bars().len();
    let mut answers = vec![];
    if question.solvers != Solvers::Energy {
        watch(&format!("lagrange: constraints and multipliers of {bars} bars"));
        answers.push(by_lagrange(problem, question));
    }
    if question.solvers != Solvers::Lagrange {
        watch(&format!("energy: minimisation over the directions of {bars} bars"));
        let found = energy::minimise(problem, &energy::Settings::default());
        answers.push(found.map(|found| found.equilibrium).map_err(SolverFailure::from));
    }
    watch("the judges");
    let (mut equilibria, mut failures) = (vec![], vec![]);
    for answer in answers {
        match answer {
            Ok(equilibrium) => equilibria.push(equilibrium),
            Err(failure) => failures.push(failure),
        }
    }
    let missing = failures.first().map(|failure| (failure.solver(), NoAnswer::Refused));
    let agreement = judge_within(problem, &mut equilibria, missing, tolerances);
    if let Some(settings) = census_settings(problem, question.census)
        && !equilibria.is_empty()
    {
        watch("the census");
        look_up(problem, &settings, &mut equilibria);
    }
    Answer { equilibria, failures, agreement }
}

fn by_lagrange(problem: &Problem, question: &Question) -> Result<Equilibrium, SolverFailure> {
    match question.equations {
        Equations::Full => {
            let found = lagrange::solve(problem, &lagrange::Settings::default())?;
            Ok(found.equilibrium)
        }
        Equations::Condensed => {
            // The bits of the answer do not depend on how many share the work.
            let found = lagrange::condensed::Solver::with_processors(question.threads)
                .solve(problem, &lagrange::condensed::Settings::default())?;
            Ok(found.equilibrium)
        }
    }
}

/// Judge answers that are there already as [`ask`] judges its own: compared with each other,
/// certified, and looked up in a census. For positions that nobody asks for, such as a saddle where
/// a solver was started.
///
/// `missing` is a solver that was asked as well and has no answer, and why. The comparison is that
/// of two answers or more.
///
/// ```
/// use census::{Census, Settings};
/// let problem = model::cases::paper();
/// let census = Census::take(&problem, &Settings::default())?;
/// // The paper's chain upside down, an equilibrium that no minimiser finds.
/// let seed = lagrange::Seed::planar(&[1.2, -0.7, -0.3]);
/// let saddle = lagrange::solve_from(&problem, &seed, &lagrange::Settings::default())?.equilibrium;
/// let mut found = [saddle];
/// let missing = Some((model::SolverName::ENERGY, model::NoAnswer::MinimaOnly));
/// assert!(validate::answer::judge(&problem, &mut found, missing, &census).is_none());
/// assert!(found[0].evidence.ladder.complete.is_reached());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn judge(
    problem: &Problem,
    equilibria: &mut [Equilibrium],
    missing: Option<(SolverName, NoAnswer)>,
    census: &Census,
) -> Option<Agreement> {
    let agreement = judge_within(problem, equilibria, missing, &Tolerances::project());
    for answer in equilibria {
        certify_by_census(problem, census, answer);
    }
    agreement
}

/// Answers are compared; a single one is only judged by Newton's laws.
fn judge_within(
    problem: &Problem,
    equilibria: &mut [Equilibrium],
    missing: Option<(SolverName, NoAnswer)>,
    tolerances: &Tolerances,
) -> Option<Agreement> {
    match equilibria {
        [] => None,
        [answer] => {
            match missing {
                Some((solver, because)) => {
                    judge_without(problem, answer, solver, because);
                }
                None => {
                    judge_alone(problem, answer);
                }
            }
            None
        }
        several => Some(compare(problem, several, tolerances)),
    }
}

/// How far to go for a census, if at all.
fn census_settings(problem: &Problem, census: UseCensus) -> Option<census::Settings> {
    let bars = problem.chain().bars().len();
    match census {
        UseCensus::Auto if bars <= census::Settings::UNASKED_BARS => {
            let straight = matches!(Topology::of(problem), Err(TopologyError::Straight { .. }));
            let max_tests_per_pattern = if straight { CENSUS_TESTS_STRAIGHT } else { CENSUS_TESTS };
            Some(census::Settings { max_tests_per_pattern, ..census::Settings::default() })
        }
        UseCensus::Always => Some(census::Settings::default()),
        UseCensus::Never | UseCensus::Auto => None,
    }
}

fn look_up(problem: &Problem, settings: &census::Settings, equilibria: &mut [Equilibrium]) {
    let census = Census::take(problem, settings);
    for answer in equilibria {
        match &census {
            Ok(census) => certify_by_census(problem, census, answer),
            Err(error) => without_census(error, answer),
        }
    }
}

#[cfg(test)]
mod tests;
