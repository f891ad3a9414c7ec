//! `funicular solve`: one system, both solvers, one verdict.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use funicular::{SolveAnswer, SystemSolution, picture};
use miette::miette;
use validate::answer::{Equations, Solvers};

use crate::answer;
use crate::exit::{Exit, Failure};
use crate::input::{self, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::system;
use crate::threads;
use crate::which::Which;

/// `funicular solve`.
#[derive(Debug, Args)]
pub struct Solve {
    /// The system file (TOML or JSON, - for standard input); see `funicular cases three-equal-bars`
    /// for one
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
    /// Write joints and forces, a line per joint, to this CSV file: solver, joint, place in m, and
    /// for a chain the force on the bar before the joint and the axial force of that bar in N, for
    /// another system the force of the ground on the joint in N
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write the bars of a system of bars, a line per bar, to this CSV file: solver, bar, its
    /// joints, axial force and the forces on it at both joints in N
    #[arg(long, value_name = "FILE")]
    pub bars_csv: Option<PathBuf>,
    /// Draw the system to scale with loads, reactions and axial forces into this SVG file
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
}

/// Which of the systems of equations `lagrange` solves.
///
/// They have the same solutions; a test compares them. The angles of the full one lose digits where
/// strands hang side by side or a chain is nearly straight, and its cost grows faster than the
/// number of bars.
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
    let outputs = [&arguments.csv, &arguments.bars_csv, &arguments.svg];
    output::check(outputs.into_iter().flatten().map(PathBuf::as_path), &files)?;
    let solve =
        funicular::Solve::new().solvers(arguments.solver.into()).equations(arguments.system.into());
    if let Some(system) = problem.as_system() {
        let answer = solve.run_system_watched(system, &|what| progress.say(what))?;
        return system_answer(arguments, &answer, progress);
    }
    let answer = solve.run_watched(&problem, &|what| progress.say(what))?;
    chain_answer(arguments, &problem, &answer, progress)
}

fn chain_answer(
    arguments: &Solve,
    problem: &funicular::Problem,
    answer: &SolveAnswer,
    progress: Progress,
) -> Result<Exit, Failure> {
    if arguments.bars_csv.is_some() {
        return Err(Failure::bad_input(miette!(
            "--bars-csv is for systems of bars by name; --csv has the bars of a chain"
        )));
    }
    if let Some(path) = &arguments.csv {
        progress.say(&format!("writing {}", path.display()));
        output::write_stream(path, |file| answer.write_csv(file))?;
    }
    if let (Some(path), Some(chain), [first, ..]) =
        (&arguments.svg, problem.as_chain(), answer.equilibria())
    {
        let drawn = picture::of_chain(chain.chain(), first);
        output::write_whole(path, &drawn.map_err(|error| Failure::undecided(miette!("{error}")))?)?;
    }
    drop(progress);
    if arguments.json && arguments.summary {
        output::print_json(&answer.summary().map_err(|error| output::no_json(&error))?)?;
    } else if arguments.json {
        output::print_json(answer)?;
    } else {
        output::print(&answer::answer(answer, arguments.summary))?;
    }
    Ok(verdict(answer.check_failed(), answer.is_decided()))
}

fn system_answer(
    arguments: &Solve,
    answer: &SystemSolution,
    progress: Progress,
) -> Result<Exit, Failure> {
    if let Some(path) = &arguments.csv {
        output::write_stream(path, |file| answer.write_joints_csv(file))?;
    }
    if let Some(path) = &arguments.bars_csv {
        output::write_stream(path, |file| answer.write_bars_csv(file))?;
    }
    if let (Some(path), [first, ..]) = (&arguments.svg, answer.equilibria()) {
        let drawn = picture::of_system(answer.system(), first);
        output::write_whole(path, &drawn.map_err(|error| Failure::undecided(miette!("{error}")))?)?;
    }
    drop(progress);
    if arguments.json && arguments.summary {
        output::print_json(&answer.summary())?;
    } else if arguments.json {
        output::print_json(answer)?;
    } else {
        output::print(&system::answer(answer, arguments.summary))?;
    }
    let disagree = answer.agreement().is_some_and(|agreement| !agreement.agrees());
    Ok(verdict(disagree, answer.failures().is_empty()))
}

/// A failed check is worse than an answer that is missing or has not converged.
fn verdict(check_failed: bool, decided: bool) -> Exit {
    if check_failed {
        Exit::CheckFailed
    } else if decided {
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
