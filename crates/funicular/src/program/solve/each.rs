//! `funicular solve --without each` and `--load-case each`: the loss of each member in turn, and all load cases.

use std::sync::atomic::{AtomicUsize, Ordering};

use funicular::Problem;
use validate::UseCensus;

use crate::exit::{Exit, Result};
use crate::progress::Progress;

/// Lose each member of a system in turn.
pub fn loss(arguments: &super::Solve, problem: &Problem, progress: Progress) -> Result<Exit> {
    let members = problem.system().members().len();
    let solve = arguments.question(UseCensus::Never);
    let watch = counter(&progress, members, "losses");
    let found = solve.without_each_watched(problem, &watch)?;
    drop(watch);
    drop(progress);
    arguments.printed.print(&found)?;
    let failed = found.check_failed() || (arguments.check && !found.survives());
    Ok(Exit::of(failed, found.is_decided()))
}

/// Take each load case.
pub fn load_case(arguments: &super::Solve, problem: &Problem, progress: Progress) -> Result<Exit> {
    let solve = arguments.question(UseCensus::Never);
    let watch = counter(&progress, problem.load_cases().len(), "load cases");
    let found = solve.load_cases_watched(problem, &watch)?;
    drop(watch);
    drop(progress);
    arguments.printed.print(&found)?;
    let failed = found.check_failed() || (arguments.check && found.is_strong() == Some(false));
    Ok(Exit::of(failed, found.is_decided()))
}

/// Says how many of all are done.
fn counter(progress: &Progress, all: usize, what: &'static str) -> impl Fn() + Sync {
    let done = AtomicUsize::new(0);
    move || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.say(&format!("{done} of {all} {what}"));
    }
}
