//! `funicular solve A.toml B.toml ...`: every file answered, one after the other.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use formats::answer::Answer;
use funicular::{SolveAnswer, text};
use validate::UseCensus;

use super::object::{self, Origin, Unanswered};
use crate::exit::{Exit, Failure, Result};
use crate::in_order::in_order;
use crate::input::{self, next_to};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printable::Printable;

/// What is printed about a file.
struct Said {
    text: String,
    /// What goes to standard error.
    failure: Option<Failure>,
    exit: Exit,
}

/// Run the command for several files.
pub fn run(arguments: &super::Solve) -> Result<Exit> {
    let alone = [
        ("--without", arguments.without.is_some()),
        ("--tolerances", arguments.tolerances),
        ("--load-case each", arguments.each_case()),
    ];
    if let Some((option, _)) = alone.into_iter().find(|(_, given)| *given) {
        return Err(Failure::bad_input(format!("{option} takes one system at a time")));
    }
    if let Some(option) = arguments.file_for_one() {
        return Err(Failure::bad_input(format!("{option} writes one file, for one system")));
    }
    end_on_interrupt()?;
    arguments.threads.install()?;
    let mut worst = Exit::Done;
    let mut stopped = None;
    let write = |said: Said| {
        worst = worst.worse(said.exit);
        let printed = if arguments.printed.is_json() {
            output::print_objects(&said.text)
        } else {
            output::print(&said.text)
        };
        if let Some(failure) = said.failure {
            failure.report();
        }
        match printed {
            Ok(()) => ControlFlow::Continue(()),
            Err(failure) => {
                stopped = Some(failure);
                ControlFlow::Break(())
            }
        }
    };
    let shape = arguments.shape()?;
    let work = |path: &PathBuf| one(arguments, path, shape.as_ref());
    in_order(
        rayon::current_num_threads(),
        arguments.files.iter(),
        work,
        |said| said.text.len(),
        write,
    );
    stopped.map_or(Ok(worst), Err)
}

fn one(arguments: &super::Solve, path: &Path, shape: Option<&Answer>) -> Said {
    let name = path.display().to_string();
    let origin = Origin::File(&name);
    let solve = arguments.question(UseCensus::Auto);
    let read = input::problem(Some(path), None);
    let solved = read.and_then(|input| {
        let problem = arguments.in_case(input.problem)?;
        super::checkable(!arguments.check || problem.has_strengths())?;
        let problem = shape.map_or(Ok(problem.clone()), |shape| next_to(&problem, shape))?;
        Ok(solve.run_here(&problem)?)
    });
    let failure = match solved {
        Ok(answer) => return said(arguments, origin, &answer),
        Err(failure) => failure,
    };
    let exit = failure.exit();
    if arguments.printed.is_json() {
        // Words and no number: they have a place in JSON.
        let text = Unanswered::by(&failure).text(origin, true).unwrap_or_default();
        return Said { text, failure: None, exit };
    }
    Said { text: heading(&name), failure: Some(failure), exit }
}

fn said(arguments: &super::Solve, origin: Origin<'_>, answer: &SolveAnswer) -> Said {
    let exit = arguments.exit(answer);
    if arguments.printed.is_json() {
        return match object::answer(origin, answer, arguments.lists(), true) {
            Ok(text) => Said { text, failure: None, exit },
            Err(error) => {
                let failure = output::no_json(&error);
                Said { text: String::new(), exit: failure.exit(), failure: Some(failure) }
            }
        };
    }
    let name = if let Origin::File(name) = origin { heading(name) } else { String::new() };
    let text = text::answer(answer, arguments.summary, arguments.evidence);
    Said { text: name + &text + "\n", failure: None, exit }
}

/// What stands above the answer to a file.
fn heading(name: &str) -> String {
    format!("=== {} ===\n", Printable(name))
}
