//! `funicular solve --without each`: the loss of each member in turn.

use std::sync::atomic::{AtomicUsize, Ordering};

use funicular::Problem;
use validate::UseCensus;

use crate::exit::{Exit, Failure};
use crate::output;
use crate::progress::Progress;

/// Run the command for a system.
pub fn run(
    arguments: &super::Solve,
    problem: &Problem,
    progress: Progress,
) -> Result<Exit, Failure> {
    let members = funicular::system_of(problem).members().len();
    let done = AtomicUsize::new(0);
    let solve = arguments.question(UseCensus::Never);
    let found = solve.without_each_watched(problem, &|| {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.say(&format!("{done} of {members} losses"));
    })?;
    drop(progress);
    if arguments.printed.is_json() {
        output::print_json(&found)?;
    } else {
        output::print(&found.to_string())?;
    }
    Ok(if found.check_failed() || (arguments.check && !found.survives()) {
        Exit::CheckFailed
    } else if found.is_decided() {
        Exit::Done
    } else {
        Exit::Undecided
    })
}
