//! Answers for a chain judged: compared, certified, and looked up in a census.

use census::Census;
use model::{Equilibrium, NoAnswer, Problem, SolverName};

use crate::compare::{Agreement, compare, judge_alone, judge_without};
use crate::completeness::certify_by_census;
use crate::tolerances::Tolerances;

/// Judge answers for a chain: compared with each other, certified, and looked up in a census. For
/// positions that nobody asks for, such as a saddle where a solver was started.
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
    let agreement = judge_without_census(problem, equilibria, missing);
    for answer in equilibria {
        certify_by_census(problem, census, answer);
    }
    agreement
}

/// Answers are compared; a single one is only judged by Newton's laws.
fn judge_without_census(
    problem: &Problem,
    equilibria: &mut [Equilibrium],
    missing: Option<(SolverName, NoAnswer)>,
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
        several => Some(compare(problem, several, &Tolerances::project())),
    }
}

#[cfg(test)]
mod tests;
