//! `funicular solve --tolerances`: ranges over the tolerances of the file.

use funicular::Problem;
use validate::UseCensus;

use crate::exit::{Exit, Failure, Result};
use crate::output;
use crate::progress::Progress;

/// Run the command for a system.
pub fn run(arguments: &super::Solve, problem: &Problem, progress: Progress) -> Result<Exit> {
    if problem.system().uncertain().is_empty() {
        return Err(Failure::bad_input(
            "--tolerances: no number of this system has a tolerance, such as length_tolerance_m",
        ));
    }
    progress.say("proving ranges");
    let solve = arguments.question(UseCensus::Never);
    let draws = arguments.monte_carlo.map_or(0, |count| count as usize);
    let found = solve.tolerances_drawn(problem, draws, arguments.seed, arguments.distribution);
    let found = found.or_else(|error| super::unsolved(arguments, error))?;
    output::write_asked(arguments.csv.as_ref(), |file| found.write_csv(file))?;
    output::write_asked(arguments.bars_csv.as_ref(), |file| found.write_bars_csv(file))?;
    drop(progress);
    arguments.printed.print(&found)?;
    let most = |k: usize| found.utilisation(k).map_or(0.0, |[_, most]| most);
    let members = found.answer().system().members().iter().enumerate();
    let mut strengths = members.filter_map(|(k, member)| Some((k, member.strength.as_deref()?)));
    let is_weak = arguments.check && strengths.any(|(k, strength)| !strength.suffices(most(k)));
    Ok(Exit::of(found.check_failed() || is_weak, found.is_decided()))
}
