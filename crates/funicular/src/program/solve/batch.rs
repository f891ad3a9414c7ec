//! `funicular solve --batch`: a system in every line, an answer in every line.

use std::fmt;
use std::io::{self, BufReader, ErrorKind, IsTerminal as _, Write as _};
use std::ops::ControlFlow;
use std::path::Path;

use formats::answer::Answer;
use funicular::{Lists, Problem, Solve};
use model::open_input;
use validate::UseCensus;

use super::lines::{Line, Lines};
use super::object::{self, Origin, Unanswered};
use crate::diagnostics::tell;
use crate::exit::{Exit, Failure, Result};
use crate::in_order::in_order;
use crate::input::next_to;
use crate::interrupt::{end_between_lines, whole_line};
use crate::output;
use crate::progress::Progress;

/// Run the batch: every line is answered, whatever becomes of the others.
pub fn run(arguments: &super::Solve, path: &Path) -> Result<Exit> {
    end_between_lines()?;
    arguments.threads.install()?;
    let lines = open(path)?;
    // A census takes far longer than a solution.
    let solve = arguments.question(UseCensus::Never);
    let shape = arguments.shape()?;
    let work = |line: Line| answer(&solve, &line, shape.as_ref(), arguments.lists());
    // What is written to a terminal is progress enough.
    let progress = (!io::stdout().is_terminal()).then(Progress::start);
    let mut tally = Tally::default();
    let mut failure = None;
    let write = |(text, exit): (String, Exit)| {
        tally.count(exit);
        if let Some(progress) = &progress {
            progress.say(&tally.to_string());
        }
        match print(&text) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                failure = Some(error);
                ControlFlow::Break(())
            }
        }
    };
    in_order(rayon::current_num_threads(), lines, work, |(text, _)| text.len(), write);
    drop(progress);
    match failure {
        Some(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(output::not_written("to standard output", &error))
        }
        _ => {
            tell(&tally);
            Ok(tally.worst)
        }
    }
}

fn open(path: &Path) -> Result<Lines> {
    if path == Path::new("-") {
        return Ok(Lines::of(BufReader::new(io::stdin())));
    }
    let file = open_input(path).map_err(|error| {
        Failure::bad_input(format!("cannot read the systems from {}: {error}", path.display()))
    })?;
    Ok(Lines::of(BufReader::new(file)))
}

/// The answer to a line as a line.
fn answer(solve: &Solve, line: &Line, shape: Option<&Answer>, lists: Lists) -> (String, Exit) {
    let drawn = |problem: Problem| match shape {
        Some(shape) => next_to(&problem, shape),
        None => Ok(problem),
    };
    let origin = Origin::Line(line.number);
    let (text, exit) = match &line.text {
        Err(reason) => (Unanswered::because(reason).text(origin, false), Exit::BadInput),
        Ok(text) => match Problem::parse(text, "line")
            .and_then(drawn)
            .and_then(|problem| solve.run_here(&problem))
        {
            Ok(answer) => {
                let exit = super::verdict(&answer);
                (object::answer(origin, &answer, lists, false), exit)
            }
            Err(error) => {
                let text = Unanswered::of(&error).text(origin, false);
                (text, Failure::from(error).exit())
            }
        },
    };
    // Numbers that are none have no place in JSON, and an answer has none.
    text.map_or_else(|_| (String::new(), Exit::Undecided), |text| (text, exit))
}

fn print(line: &str) -> io::Result<()> {
    whole_line(|| {
        let mut out = io::stdout().lock();
        out.write_all(line.as_bytes())?;
        out.flush()
    })
}

/// How the lines ended.
#[derive(Debug, Default)]
struct Tally {
    ends: [u64; 4],
    worst: Exit,
}

impl Tally {
    fn count(&mut self, exit: Exit) {
        if let Some(count) = self.ends.get_mut(usize::from(exit.code())) {
            *count += 1;
        }
        self.worst = self.worst.worse(exit);
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [done, failed, bad, undecided] = self.ends;
        write!(f, "{} systems: {done} done", done + failed + bad + undecided)?;
        for (count, what) in [
            (failed, "with a failed check"),
            (bad, "that cannot be used"),
            (undecided, "undecided"),
        ] {
            if count > 0 {
                write!(f, ", {count} {what}")?;
            }
        }
        Ok(())
    }
}
