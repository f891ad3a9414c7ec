//! `funicular solve --without each` and `--load-case each`: the loss of each member in turn, and all load cases.

use funicular::Problem;
use validate::UseCensus;

use crate::exit::{Exit, Result};
use crate::progress::Progress;

/// Lose each member of a system in turn.
pub fn loss(arguments: &super::Solve, problem: &Problem, progress: Progress) -> Result<Exit> {
    let members = problem.system().members().len();
    let solve = arguments.question(UseCensus::Never);
    let found = solve.without_each_watched(problem, &progress.counter(members, "losses"))?;
    drop(progress);
    arguments.printed.print(&found)?;
    let failed = found.check_failed() || (arguments.check && !found.survives());
    Ok(Exit::of(failed, found.is_decided()))
}

/// Take each load case.
pub fn load_case(arguments: &super::Solve, problem: &Problem, progress: Progress) -> Result<Exit> {
    let solve = arguments.question(UseCensus::Never);
    let cases = problem.load_cases().len();
    let found = solve.load_cases_watched(problem, &progress.counter(cases, "load cases"))?;
    drop(progress);
    arguments.printed.print(&found)?;
    let failed = found.check_failed() || (arguments.check && found.is_strong() == Some(false));
    Ok(Exit::of(failed, found.is_decided()))
}
