//! Answers of any solvers, held against each other.

use model::Equilibrium;
use validate::{Agreement, Tolerances};

use crate::error::Error;
use crate::problem::Problem;

/// Hold answers against each other, every two of them, and each against Newton's laws; what that
/// proves is written into their evidence. The budgets are those that our own two solvers are held
/// to.
///
/// # Errors
///
/// [`Error::NothingToCompare`] for fewer than two answers, [`Error::ChainsOnly`] for other systems.
pub fn compare(problem: &Problem, answers: &mut [Equilibrium]) -> Result<Agreement, Error> {
    let chain = problem.as_chain().ok_or(Error::ChainsOnly { what: "a comparison" })?;
    if answers.len() < 2 {
        return Err(Error::NothingToCompare { answers: answers.len() });
    }
    Ok(validate::compare(chain, answers, &Tolerances::project()))
}
