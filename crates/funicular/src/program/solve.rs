//! `funicular solve`: one system, both solvers, one verdict.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use funicular::SolveAnswer;
use validate::answer::{Equations, Solvers};

use crate::answer;
use crate::exit::{Exit, Failure};
use crate::input::{self, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::threads;
use crate::which::Which;

/// `funicular solve`.
#[derive(Debug, Args)]
pub struct Solve {
    /// The system file (TOML); see `funicular cases three-equal-bars` for one
    #[arg(value_name = "FILE", required_unless_present = "case")]
    pub file: Option<PathBuf>,
    /// Solve a named case instead of a file
    #[arg(long, value_name = "NAME", conflicts_with = "file")]
    pub case: Option<String>,
    /// Which solver; one alone gets no comparison
    #[arg(long, value_enum, default_value_t = Which::Both)]
    pub solver: Which,
    /// Which equations lagrange solves
    #[arg(long, value_enum, default_value_t = System::Condensed)]
    pub system: System,
    /// Print one JSON object (schema_version 2) instead of tables
    #[arg(long)]
    pub json: bool,
    /// Leave out the arrays over joints and bars
    #[arg(long)]
    pub summary: bool,
    /// Write joints and forces, a line per joint, to this CSV file
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

/// Which of the systems of equations `lagrange` solves.
///
/// They have the same solutions; a test compares them. The angles of the full one lose digits where strands hang
/// side by side or a chain is nearly straight, and its cost grows faster than the number of bars.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum System {
    /// Three equations for the pull on the first anchor, whatever the number of bars
    Condensed,
    /// The paper's: all coordinates and all multipliers at once; for some 30 bars
    Full,
}

/// Run the command.
pub fn run(arguments: &Solve) -> Result<Exit, Failure> {
    end_on_interrupt()?;
    threads::install(0)?;
    let progress = Progress::start();
    progress.say("reading");
    let Input { problem, files } =
        input::problem(arguments.file.as_deref(), arguments.case.as_deref())?;
    output::check(arguments.csv.as_deref(), &files)?;
    let solve =
        funicular::Solve::new().solvers(arguments.solver.into()).equations(arguments.system.into());
    let answer = solve.run_watched(&problem, &|what| progress.say(what))?;
    if let Some(path) = &arguments.csv {
        progress.say(&format!("writing {}", path.display()));
        output::write_stream(path, |file| answer.write_csv(file))?;
    }
    drop(progress);
    if arguments.json && arguments.summary {
        output::print_json(&answer.summary().map_err(|error| output::no_json(&error))?)?;
    } else if arguments.json {
        output::print_json(&answer)?;
    } else {
        output::print(&answer::answer(&answer, arguments.summary))?;
    }
    Ok(verdict(&answer))
}

/// A solver that has no answer leaves the question undecided, whatever the other found.
fn verdict(answer: &SolveAnswer) -> Exit {
    if answer.agreement().is_some_and(|agreement| !agreement.agrees()) {
        Exit::CheckFailed
    } else if answer.failures().is_empty() {
        Exit::Done
    } else {
        Exit::Undecided
    }
}

impl From<System> for Equations {
    fn from(system: System) -> Self {
        match system {
            System::Condensed => Self::Condensed,
            System::Full => Self::Full,
        }
    }
}

impl From<Which> for Solvers {
    fn from(which: Which) -> Self {
        match which {
            Which::Lagrange => Self::Lagrange,
            Which::Energy => Self::Energy,
            Which::Both => Self::Both,
        }
    }
}
