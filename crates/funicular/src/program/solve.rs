//! `funicular solve`: one system, both solvers, one verdict.

use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::path::PathBuf;

use census::{Census, Topology, TopologyError};
use clap::{Args, ValueEnum};
use miette::miette;
use model::{Equilibrium, Problem, SystemSummary};
use serde::Serialize;
use validate::completeness::{certify_by_census, without_census};
use validate::{Agreement, Tolerances, compare, compare::judge_alone};

use crate::answer;
use crate::exit::{Exit, Failure};
use crate::input::{self, Input};
use crate::interrupt::end_on_interrupt;
use crate::output::{self, SCHEMA_VERSION};
use crate::progress::Progress;
use crate::which::Which;

/// Chains up to this many bars are looked up in their census without being asked to.
const CENSUS_BARS: usize = 8;

/// Tests per pattern for that: several times what generic chains need, and a second or so at most. A degenerate chain
/// is left undecided; `funicular census` takes its time.
const CENSUS_TESTS: u64 = 2_000;

/// The same where the lengths fit into a straight line, so that the census cannot be complete: what generic chains need
/// for each of their equilibria.
const CENSUS_TESTS_STRAIGHT: u64 = 400;

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

/// What `solve --json` prints.
#[derive(Debug, Serialize)]
struct Answer {
    schema_version: u32,
    system: SystemSummary,
    equilibria: Vec<Equilibrium>,
    agreement: Option<Agreement>,
}

/// Run the command.
pub fn run(arguments: &Solve) -> Result<Exit, Failure> {
    end_on_interrupt()?;
    let progress = Progress::start();
    progress.say("reading");
    let Input { problem, files } =
        input::problem(arguments.file.as_deref(), arguments.case.as_deref())?;
    output::check(arguments.csv.as_deref(), &files)?;
    let bars = problem.chain().bars().len();
    let mut equilibria = Vec::new();
    if arguments.solver != Which::Energy {
        progress.say(&format!("lagrange: constraints and multipliers of {bars} bars"));
        equilibria.push(lagrange_answer(&problem, arguments.system)?);
    }
    if arguments.solver != Which::Lagrange {
        progress.say(&format!("energy: minimisation over the directions of {bars} bars"));
        let found = energy::minimise(&problem, &energy::Settings::default());
        equilibria.push(found.map_err(|e| Failure::undecided(miette!("energy: {e}")))?.equilibrium);
    }
    progress.say("the judges");
    let agreement = judge(&problem, &mut equilibria);
    if bars <= CENSUS_BARS {
        progress.say("the census");
        let straight = matches!(Topology::of(&problem), Err(TopologyError::Straight { .. }));
        let max_tests_per_pattern = if straight { CENSUS_TESTS_STRAIGHT } else { CENSUS_TESTS };
        let settings = census::Settings { max_tests_per_pattern, ..census::Settings::default() };
        let census = Census::take(&problem, &settings);
        for answer in &mut equilibria {
            match &census {
                Ok(census) => certify_by_census(&problem, census, answer),
                Err(error) => without_census(error, answer),
            }
        }
    }

    if let Some(path) = &arguments.csv {
        progress.say(&format!("writing {}", path.display()));
        output::write_stream(path, |file| write_joints(file, &equilibria))?;
    }
    drop(progress);
    let exit = match &agreement {
        Some(agreement) if !agreement.agrees() => Exit::CheckFailed,
        _ => Exit::Done,
    };
    let found = Answer {
        schema_version: SCHEMA_VERSION,
        system: problem.chain().summary(),
        equilibria,
        agreement,
    };
    if arguments.json && arguments.summary {
        output::print(&summary(found)?)?;
    } else if arguments.json {
        output::print_stream(|out| {
            serde_json::to_writer_pretty(&mut *out, &found)?;
            out.write_all(b"\n")
        })?;
    } else {
        output::print(&answer::answer(
            &found.system,
            &found.equilibria,
            found.agreement.as_ref(),
            arguments.summary,
        ))?;
    }
    Ok(exit)
}

/// The hanging equilibrium by `lagrange`, from the system of equations that was asked for.
fn lagrange_answer(problem: &Problem, system: System) -> Result<Equilibrium, Failure> {
    let found = match system {
        System::Full => lagrange::solve(problem, &lagrange::Settings::default())
            .map(|solution| solution.equilibrium)
            .map_err(|error| miette!("lagrange: {error}")),
        System::Condensed => {
            // The bits of the answer do not depend on how many share the work.
            let processors = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
            lagrange::condensed::Solver::with_processors(processors)
                .solve(problem, &lagrange::condensed::Settings::default())
                .map(|solution| solution.equilibrium)
                .map_err(|error| miette!("lagrange: {error}"))
        }
    };
    found.map_err(Failure::undecided)
}

/// Answers are compared; a single one is only judged by Newton's laws.
fn judge(problem: &Problem, equilibria: &mut [Equilibrium]) -> Option<Agreement> {
    if let [answer] = equilibria {
        judge_alone(problem, answer);
        return None;
    }
    Some(compare(problem, equilibria, &Tolerances::project()))
}

/// The answer as JSON without the arrays over joints and bars.
fn summary(mut answer: Answer) -> Result<String, Failure> {
    let broken =
        |error| Failure::undecided(miette!("the answer cannot be written as JSON: {error}"));
    for equilibrium in &mut answer.equilibria {
        // Before they are copied: a million entries each.
        equilibrium.joints_m.clear();
        equilibrium.multipliers_n.clear();
        equilibrium.axial_n.clear();
    }
    let mut value = serde_json::to_value(answer).map_err(broken)?;
    if let Some(equilibria) = value["equilibria"].as_array_mut() {
        for equilibrium in equilibria.iter_mut().filter_map(serde_json::Value::as_object_mut) {
            for key in ["joints_m", "multipliers_n", "axial_n"] {
                equilibrium.remove(key);
            }
        }
    }
    serde_json::to_string_pretty(&value).map(|text| text + "\n").map_err(broken)
}

/// A line per solver and joint: position, force of bar k+1 on bar k (at joint 0 of the ground on bar 1, at
/// joint n of the ground on bar n), and the axial force of the bar that ends there.
fn write_joints(to: &mut impl Write, equilibria: &[Equilibrium]) -> io::Result<()> {
    writeln!(to, "solver,joint,x_m,y_m,z_m,force_x_n,force_y_n,force_z_n,axial_n")?;
    for e in equilibria {
        for (k, ([x, y, z], [fx, fy, fz])) in e.joints_m.iter().zip(&e.multipliers_n).enumerate() {
            write!(to, "{},{k},{x:?},{y:?},{z:?},{fx:?},{fy:?},{fz:?},", e.solver)?;
            match k.checked_sub(1).and_then(|bar| e.axial_n.get(bar)) {
                Some(axial) => writeln!(to, "{axial:?}")?,
                None => writeln!(to)?,
            }
        }
    }
    Ok(())
}
