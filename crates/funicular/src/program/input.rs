//! Systems from files, standard input, and the registry of cases.

use std::path::{Path, PathBuf};

use clap::Args;
use formats::answer::{Answer, Forces};
use funicular::{Error, Problem, Reading};

use crate::case_name::CaseName;
use crate::diagnostics::{Diagnostic, tell};
use crate::exit::{Failure, Result};
use crate::foreign_input;
use crate::tables::wrapped;

/// Where a command that takes one system takes it from.
#[derive(Debug, Args)]
pub struct Source {
    /// The system file (TOML or JSON, - for standard input); see `funicular cases lamp` for one. Or a
    /// file of another program, by its ending: .dxf, .obj, .map, .tcl, .txt, .dat, .json
    #[arg(value_name = "FILE", required_unless_present = "case")]
    pub file: Option<PathBuf>,
    /// A named case instead of a file
    #[arg(long, value_name = "NAME", value_parser = CaseName, hide_possible_values = true, conflicts_with = "file")]
    pub case: Option<String>,
    /// Under the loads of this load case, of the [[cases]] of the file
    #[arg(long, value_name = "NAME")]
    pub load_case: Option<String>,
}

impl Source {
    /// The system, and the files that were read.
    pub fn read(&self) -> Result<Input> {
        let input = problem(self.file.as_deref(), self.case.as_deref())?;
        Ok(Input { problem: in_case(input.problem, self.load_case.as_deref())?, ..input })
    }
}

/// The same for a command that also takes a shape.
#[derive(Debug, Args)]
pub struct Drawn {
    #[command(flatten)]
    source: Source,
    #[command(flatten)]
    shape: Shape,
}

/// A shape next to which the equilibrium is required.
#[derive(Debug, Args)]
pub struct Shape {
    /// Find the equilibrium next to this shape, not the lowest: CSV (joint,x_m,y_m,z_m), JSON of
    /// `solve --json` (its first equilibrium) or VTU, - for standard input
    ///
    /// A system file whose joints have places near_m is solved next to these without it.
    #[arg(long, value_name = "FILE")]
    pub near: Option<PathBuf>,
}

impl Drawn {
    /// The system, drawn with the shape that was given, and the files that were read.
    pub fn read(&self) -> Result<Input> {
        read_once([&self.source.file, &self.shape.near].into_iter().flatten())?;
        let Input { problem, mut files } = self.source.read()?;
        files.extend(self.shape.near.clone());
        let problem = match self.shape.read()? {
            Some(shape) => next_to(&problem, &shape)?,
            None => problem,
        };
        Ok(Input { problem, files })
    }
}

impl Shape {
    /// The shape, if one was given.
    pub fn read(&self) -> Result<Option<Answer>> {
        self.near.as_deref().map_or(Ok(None), shape)
    }
}

/// Standard input can be read once.
pub fn read_once<'a>(files: impl IntoIterator<Item = &'a PathBuf>) -> Result<()> {
    if files.into_iter().filter(|file| file.as_path() == Path::new("-")).count() > 1 {
        return Err(Failure::bad_input("two files cannot both come from standard input"));
    }
    Ok(())
}

/// The first shape of a file.
fn shape(path: &Path) -> Result<Option<Answer>> {
    let (text, name) = foreign_input::text(path)?;
    let shapes = formats::answer::parse(&text, &name).map_err(Error::from)?;
    Ok(shapes.into_iter().next())
}

/// The places of the joints of a problem in a file, m.
pub fn places(problem: &Problem, path: &Path) -> Result<Vec<model::Vector>> {
    let none = || Failure::bad_input(format!("{} has no shape", path.display()));
    Ok(fitted(problem, shape(path)?.ok_or_else(none)?)?)
}

/// The problem with the question of the equilibrium next to a shape.
pub fn next_to(problem: &Problem, shape: &Answer) -> Result<Problem, Error> {
    problem.near(&fitted(problem, shape.clone())?)
}

/// The places of the joints of a problem in a shape, m.
fn fitted(problem: &Problem, shape: Answer) -> Result<Vec<model::Vector>, Error> {
    // The forces of an answer are no part of the question.
    let shape = Answer { forces: Forces::None, reactions_n: None, ..shape };
    Ok(funicular::judge::fit(&problem.system(), shape)?.joints_m)
}

/// A system and where it comes from.
pub struct Input {
    /// What is to be solved.
    pub problem: Problem,
    /// The files that were read; none of them may be written.
    pub files: Vec<PathBuf>,
}

/// The problem of a system file (`-` is standard input) or of a named case.
pub fn problem(file: Option<&Path>, case: Option<&str>) -> Result<Input> {
    let (problem, files) = match (file, case) {
        (Some(file), _) if file == Path::new("-") => {
            let (text, name) = foreign_input::text(file)?;
            (Problem::parse(&text, &name)?, vec![])
        }
        (Some(file), _) => {
            meant_as_case(file)?;
            meant_as_table(file)?;
            let Reading { problem, files, notes } = Reading::of(file)?;
            tell_notes(&notes);
            (problem, files)
        }
        (None, Some(name)) => (Problem::case(name)?, vec![]),
        // clap asks for one of them.
        (None, None) => return Err(Failure::bad_input("name a system file or a case")),
    };
    Ok(Input { problem, files })
}

/// The problem in the load case that is asked for.
pub fn in_case(problem: Problem, name: Option<&str>) -> Result<Problem, Error> {
    match name {
        Some(name) => problem.in_case(name),
        None => Ok(problem),
    }
}

/// Say how a file of another program was read.
fn tell_notes(notes: &[String]) {
    /// What is shown of the lines of a large mooring.
    const MOST: usize = 8;
    for note in notes.iter().take(MOST) {
        tell(wrapped(&format!("note: {note}"), 2));
    }
    if notes.len() > MOST {
        tell(format_args!("note: and {} more, which `funicular judge` shows", notes.len() - MOST));
    }
}

/// A table of bars or nodes is a part of a system.
fn meant_as_table(file: &Path) -> Result<()> {
    if !file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) {
        return Ok(());
    }
    let message = format!("{} is a table, not a system file", file.display());
    let help = "a system file names it, bars_file = \"...\" or joints_file = \"...\" (`funicular format`); \
                of a net of force densities `funicular judge NODES --edges EDGES` reads both tables";
    Err(Failure::bad_input(Diagnostic::from(message).with_help(help.to_owned())))
}

/// A file that does not exist and has the name of a case was meant as that.
fn meant_as_case(file: &Path) -> Result<()> {
    let name = file.to_str().filter(|name| Problem::case(name).is_ok());
    match name {
        Some(name) if !file.exists() => {
            let help = format!("there is a case of that name: `--case {name}`");
            let message = format!("there is no file {name}");
            Err(Failure::bad_input(Diagnostic::from(message).with_help(help)))
        }
        _ => Ok(()),
    }
}
