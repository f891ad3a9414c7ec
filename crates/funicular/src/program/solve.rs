//! `funicular solve`: a system or many, both solvers, a verdict on each.

mod batch;
mod each;
mod lines;
mod object;
mod several;
mod tolerances;

use std::path::{Path, PathBuf};

use clap::Args;
use formats::answer::Answer;
use funicular::picture::{self, Seen};
use funicular::{Distribution, Error, Lists, Problem, SolveAnswer, text};
use validate::{Equations, Solvers, UseCensus};

use crate::case_name::CaseName;
use crate::exit::{Exit, Failure, Result};
use crate::input::{self, Input, Shape, next_to};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printed::Printed;
use crate::progress::Progress;
use crate::threads::Threads;

/// `funicular solve`.
#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
#[derive(Debug, Args)]
pub struct Solve {
    /// The system file (TOML or JSON, - for standard input), or several, which are answered in
    /// their order; see `funicular cases three-equal-bars` for one
    #[arg(value_name = "FILE", required_unless_present_any = ["case", "batch"])]
    pub files: Vec<PathBuf>,
    /// Solve a named case instead of a file
    #[arg(long, value_name = "NAME", value_parser = CaseName, hide_possible_values = true, conflicts_with = "files")]
    pub case: Option<String>,
    /// Solve every line of this file (- for standard input): each is a system as one JSON object,
    /// and is answered by one line of JSON, in the same order
    ///
    /// An answer is the object of --json with the number of its line under `line`. A line that has
    /// none is answered by an object with `line`, `error` and, where they are known, `key`,
    /// `column` and `help`; the others go on.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["files", "case", "csv", "bars_csv", "svg", "format", "units"])]
    pub batch: Option<PathBuf>,
    /// Whether short chains are looked up in their census: up to 8 bars by themselves (auto), up to
    /// 16 (always)
    ///
    /// A census takes far longer than a solution. Without this option none is taken with --batch,
    /// and elsewhere auto holds; --census alone is --census=auto.
    #[arg(long, value_name = "WHEN", value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "auto")]
    pub census: Option<UseCensus>,
    #[command(flatten)]
    pub threads: Threads,
    #[command(flatten)]
    pub shape: Shape,
    /// Which solver; one alone gets no comparison
    #[arg(long, value_enum, default_value_t)]
    pub solver: Solvers,
    /// Which equations lagrange solves for rigid bars in a row between two anchors; `full` refuses
    /// any other system
    #[arg(long, alias = "system", value_enum, default_value_t)]
    pub equations: Equations,
    #[command(flatten)]
    pub printed: Printed,
    /// Leave out joints, and in JSON bars and forces of the ground too
    #[arg(long)]
    pub summary: bool,
    /// How far the answer is proved, in full
    #[arg(long)]
    pub evidence: bool,
    /// In JSON, an array over joints or bars for each quantity, in the order of the file, in the
    /// place of an object for each: for long chains and large nets
    #[arg(long, requires = "json", conflicts_with = "summary")]
    pub columns: bool,
    /// Write joints, a line per joint, to this CSV file
    ///
    /// Columns: `solver`; `joint`, its name (of a chain its number, from 0); `x_m`, `y_m`, `z_m`,
    /// its place; `reaction_x_n`, `reaction_y_n`, `reaction_z_n`, the force of the ground on it. With
    /// --tolerances the ends of each: `x_least_m`, `x_most_m` and the like.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write bars, a line per bar, to this CSV file
    ///
    /// Columns: `solver`; `bar`, its number from 1; `from`, `to`, its joints; `axial_n`, its axial
    /// force, tension positive, with its weight lumped to its joints: the value in the middle of a
    /// homogeneous bar; `axial_from_n`, `axial_to_n`, the same at both ends; `axial_max_n`, where it
    /// is largest; `start_x_n` to `end_z_n`, the forces on it at both; `utilisation`, the part of its strength
    /// that it uses, where bars have strengths; `via`, the joints that a rope runs over, where there are ropes. With --tolerances the ends of the axial force, `least_n` and
    /// `most_n`, what of it is reached, and the number on which it depends most.
    #[arg(long, value_name = "FILE")]
    pub bars_csv: Option<PathBuf>,
    /// End with exit code 1 where a bar is weaker than wanted: its largest force times its `safety` more
    /// than its `strength_n` or `compression_n`
    #[arg(long, conflicts_with = "batch")]
    pub check: bool,
    /// Take each bar away in turn: what hangs then, with which forces, and which loss brings a part down
    ///
    /// With --check the exit code is 1 where a part falls, or a bar is weaker than wanted.
    #[arg(long, value_name = "WHICH", value_parser = ["each"], conflicts_with_all = ["batch", "csv", "bars_csv", "svg", "columns", "summary", "evidence", "census", "equations", "near"])]
    pub without: Option<String>,
    /// Under the loads of this load case, of the [[cases]] of the file; `each` shows all cases, with the
    /// envelope of the forces over them
    ///
    /// With --check the exit code is 1 where a bar is weaker than wanted in any of them.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["batch", "without"])]
    pub load_case: Option<String>,
    /// Bound all places, forces and the sag over the tolerances of the file (`length_tolerance_m` and the
    /// like): guaranteed ranges, in interval arithmetic
    ///
    /// The exit code is 3 where there is no proof for all values, with --check 1 where a bar may be weaker
    /// than wanted. The guide has an example, `funicular guide systems`.
    #[arg(long, conflicts_with_all = ["batch", "without", "svg", "columns", "summary", "evidence"])]
    pub tolerances: bool,
    /// Also solve this many random systems within the tolerances, for standard deviations
    #[arg(long, value_name = "N", requires = "tolerances", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub monte_carlo: Option<u32>,
    /// From which number the random values follow
    #[arg(long, value_name = "SEED", requires = "monte_carlo", default_value_t = 1)]
    pub seed: u64,
    /// How the random values are distributed
    #[arg(long, value_enum, value_name = "WHICH", requires = "monte_carlo", default_value_t)]
    pub distribution: Distribution,
    /// Draw the system to scale with loads, reactions and axial forces into this file: .svg, .png,
    /// .pdf or .dxf
    #[arg(long, visible_alias = "picture", value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// From where the picture is seen
    #[arg(long, value_enum, value_name = "VIEW", default_value_t, requires = "svg")]
    pub view: Seen,
}

impl Solve {
    /// What is asked, with `census` where the arguments say nothing about it.
    fn question(&self, census: UseCensus) -> funicular::Solve {
        funicular::Solve::new()
            .solvers(self.solver)
            .equations(self.equations)
            .census(self.census.unwrap_or(census))
    }

    /// How JSON has joints and bars.
    fn lists(&self) -> Lists {
        match (self.summary, self.columns) {
            (true, _) => Lists::None,
            (false, true) => Lists::Columns,
            (false, false) => Lists::Objects,
        }
    }

    /// The shape next to which the equilibrium is required, if one was given.
    fn shape(&self) -> Result<Option<Answer>> {
        input::read_once(self.files.iter().chain(&self.batch).chain(&self.shape.near))?;
        self.shape.read()
    }

    /// Whether all load cases are asked for.
    fn each_case(&self) -> bool {
        self.load_case.as_deref() == Some("each")
    }

    /// A system in the load case that is asked for.
    fn in_case(&self, problem: Problem) -> Result<Problem, Error> {
        input::in_case(problem, self.load_case.as_deref().filter(|_| !self.each_case()))
    }

    /// An option that has no place where several systems are answered, of one or of many files.
    fn of_one_answer(&self) -> Option<&'static str> {
        let given = [
            ("--columns", self.columns),
            ("--summary", self.summary),
            ("--evidence", self.evidence),
            ("--tolerances", self.tolerances),
        ];
        let given = given.into_iter().find(|(_, is_given)| *is_given).map(|(option, _)| option);
        self.file_for_one().or(given)
    }

    /// How the answer to one system ends.
    fn exit(&self, answer: &SolveAnswer) -> Exit {
        let is_weak = self.check && answer.is_strong() == Some(false);
        verdict(answer).worse(if is_weak { Exit::CheckFailed } else { Exit::Done })
    }

    /// An option that names a file for the answer to one system.
    fn file_for_one(&self) -> Option<&'static str> {
        let files = [("--csv", &self.csv), ("--bars-csv", &self.bars_csv), ("--svg", &self.svg)];
        files.into_iter().find(|(_, file)| file.is_some()).map(|(option, _)| option)
    }
}

/// Refuse to check what has no strength.
pub fn checkable(is_checkable: bool) -> Result<()> {
    if is_checkable {
        return Ok(());
    }
    Err(Failure::bad_input(
        "--check: no bar of this system has a strength_n, compression_n or bending_n_m2",
    ))
}

/// Run the command.
pub fn run(arguments: &Solve) -> Result<Exit> {
    arguments.printed.install();
    match (&arguments.batch, arguments.files.as_slice()) {
        (Some(batch), _) => batch::run(arguments, batch),
        (None, [_, _, ..]) => several::run(arguments),
        (None, files) => one(arguments, files.first().map(PathBuf::as_path)),
    }
}

fn one(arguments: &Solve, file: Option<&Path>) -> Result<Exit> {
    end_on_interrupt()?;
    arguments.threads.install()?;
    let progress = Progress::start();
    progress.say("reading");
    let shape = arguments.shape()?;
    let Input { problem, mut files } = input::problem(file, arguments.case.as_deref())?;
    let mut problem = arguments.in_case(problem)?;
    if arguments.without.is_none() {
        checkable(!arguments.check || problem.has_strengths())?;
    }
    if let Some(shape) = shape {
        problem = next_to(&problem, &shape)?;
        files.extend(arguments.shape.near.clone());
    }
    if arguments.without.is_some() {
        return each::loss(arguments, &problem, progress);
    }
    if arguments.each_case() {
        return match arguments.of_one_answer() {
            Some(option) => Err(Failure::bad_input(format!("{option} is for one load case"))),
            None => each::load_case(arguments, &problem, progress),
        };
    }
    let outputs = [&arguments.csv, &arguments.bars_csv, &arguments.svg];
    output::check(outputs.into_iter().flatten(), &files)?;
    if arguments.tolerances {
        return tolerances::run(arguments, &problem, progress);
    }
    let solve = arguments.question(UseCensus::Auto);
    let answer = solve.run_watched(&problem, &|what| progress.say(what));
    let answer = answer.or_else(|error| unsolved(arguments, error))?;
    write_files(arguments, &answer, &progress)?;
    drop(progress);
    if arguments.printed.is_json() {
        output::print_json(&answer.json(arguments.lists()))?;
    } else {
        output::print(&text::answer(&answer, arguments.summary, arguments.evidence))?;
    }
    Ok(arguments.exit(&answer))
}

/// The files that are asked for besides what is printed.
fn write_files(arguments: &Solve, answer: &SolveAnswer, progress: &Progress) -> Result<()> {
    if let Some(path) = &arguments.csv {
        progress.say(&format!("writing {}", path.display()));
        output::write_stream(path, |file| answer.write_csv(file))?;
    }
    if let Some(path) = &arguments.bars_csv {
        progress.say(&format!("writing {}", path.display()));
        output::write_stream(path, |file| answer.write_bars_csv(file))?;
    }
    if let (Some(path), [first, ..]) = (&arguments.svg, answer.equilibria()) {
        let drawn = picture::of_system(answer.system(), first, arguments.view);
        output::write_picture(path, &drawn.map_err(Failure::undecided)?)?;
    }
    Ok(())
}

/// Where no solver has an answer, JSON is an object all the same: without equilibria, and with the
/// refusals.
fn unsolved<T>(arguments: &Solve, error: Error) -> Result<T> {
    match &error {
        Error::Unsolved(answer) if arguments.printed.is_json() => output::print_json(answer)?,
        _ => {}
    }
    Err(error.into())
}

/// A failed check is worse than an answer that is missing or has not converged.
pub fn verdict(answer: &SolveAnswer) -> Exit {
    Exit::of(answer.check_failed(), answer.is_decided())
}
