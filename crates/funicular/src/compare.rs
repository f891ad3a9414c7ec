//! Answers of any solvers, held against each other.

use model::system::SystemEquilibrium;
use validate::Tolerances;
use validate::systems::SystemAgreement;

use crate::error::Error;
use crate::problem::Problem;

/// Hold answers against each other, every two of them, and each against Newton's laws; what that
/// proves is written into their evidence. The budgets are those that our own two solvers are held
/// to.
///
/// # Errors
/// [`Error::NothingToCompare`] for fewer than two answers.
pub fn compare(
    problem: &Problem,
    answers: &mut [SystemEquilibrium],
) -> Result<SystemAgreement, Error> {
    if answers.len() < 2 {
        return Err(Error::NothingToCompare(answers.len()));
    }
    Ok(validate::systems::compare(&problem.system(), answers, &Tolerances::project()))
}
