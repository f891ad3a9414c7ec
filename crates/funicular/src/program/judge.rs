//! `funicular judge`: an answer from elsewhere against a system.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use formats::answer::Answer;
use funicular::judge::{Ruling, Subject};
use funicular::picture::Seen;

use crate::exit::{Exit, Failure, Result};
use crate::foreign_input;
use crate::input::{Source, read_once};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::solve;
use crate::threads;

/// The end of the help.
const EXIT_CODES: &str = "\
Exit codes:
  0  confirmed: an equilibrium is within the tolerance of every answer
  1  refuted: an answer breaks a law by more than the tolerance explains; or, with --check, too weak
  2  bad input or usage
  3  undecided: no law is broken, but no equilibrium was found within the tolerance; or not written (the disk is full)
130  interrupted; no file is half written";

/// `funicular judge`.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Judge {
    #[command(flatten)]
    pub input: Source,
    /// How FILE is written
    #[arg(long, value_enum, default_value_t = Format::Auto)]
    pub format: Format,
    /// The edges of a net of force densities (CSV: from, to, q_n_m)
    #[arg(long, value_name = "FILE")]
    pub edges: Option<PathBuf>,
    /// The answer: JSON of `solve --json`, CSV (joint,x_m,y_m,z_m; anchors may be left out) or VTU, -
    /// for standard input. Places, `axial_n` and (except in VTU) reactions are judged; what follows from them is not read.
    /// Nets of force densities have one in their file
    #[arg(long, value_name = "FILE")]
    pub answer: Option<PathBuf>,
    /// Axial forces of the members (CSV: from,to,axial_n)
    #[arg(long, value_name = "FILE", requires = "answer")]
    pub members: Option<PathBuf>,
    /// How well the answer is taken to know its numbers: positions in units of the size of the
    /// system, forces of the largest one. Forces printed to fewer digits count as such
    #[arg(long, value_name = "RELATIVE", default_value_t = validate::foreign::bounds::TOLERANCE)]
    pub tolerance: f64,
    /// End with exit code 1 where a bar is weaker than wanted under the forces judged, as `solve --check`
    #[arg(long)]
    pub check: bool,
    /// Print one JSON object (schema_version 3) instead of tables
    #[arg(long)]
    pub json: bool,
    /// Write the judgement as a page that needs nothing else (of several answers: FILE-1.html,
    /// FILE-2.html, ...)
    #[arg(long, value_name = "FILE", value_parser = output::page_file)]
    pub html: Option<PathBuf>,
    /// From where the picture of the page is seen
    #[arg(long, value_enum, value_name = "VIEW", default_value_t, requires = "html")]
    pub view: Seen,
}

/// How a system is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// By the name and the text: .dxf, .obj, .tcl is OpenSees's, .map MAP++'s, .dat and .txt MoorDyn's or MAP++'s,
    /// .csv a net, JSON with a `dtype` COMPAS's
    Auto,
    /// Our own system file
    Funicular,
    /// Lines of a drawing in ASCII
    Dxf,
    /// Lines of Wavefront OBJ
    Obj,
    /// A MoorDyn input file, version 1 or 2
    Moordyn,
    /// A MAP++ input file
    Map,
    /// A truss of OpenSees in Tcl
    Opensees,
    /// COMPAS JSON with force densities
    Compas,
    /// Nodes as CSV; --edges has the edges
    ForceDensity,
}

/// Run the command.
pub fn run(arguments: &Judge) -> Result<Exit> {
    end_on_interrupt()?;
    threads::install(0)?;
    let Judge { input, answer, members, edges, .. } = arguments;
    read_once([&input.file, answer, members, edges].into_iter().flatten())?;
    let progress = Progress::start();
    progress.say("reading");
    let (subject, mut files) = foreign_input::system(arguments)?;
    let answers = answers(arguments, &subject, &mut files)?;
    let pages = arguments
        .html
        .as_deref()
        .map_or_else(Vec::new, |path| output::numbered(path, answers.len()));
    output::check(&pages, &files)?;
    let judge = funicular::Judge::new().tolerance(arguments.tolerance);
    let one = |answer| subject.judge(&judge, answer, &|what| progress.say(what));
    let all = answers.into_iter().map(one).collect::<Result<Vec<_>, _>>()?;
    if arguments.check {
        solve::checkable(all.iter().all(|one| one.judged.is_strong().is_some()))?;
    }
    for (page, one) in pages.iter().zip(&all) {
        output::write_whole(page, &one.html(arguments.view))?;
    }
    drop(progress);
    if arguments.json {
        match &all[..] {
            [one] => output::print_json(&one.judged)?,
            several => {
                output::print_json(&several.iter().map(|one| &one.judged).collect::<Vec<_>>())?;
            }
        }
    } else {
        let texts: Vec<_> = all.iter().map(Ruling::to_string).collect();
        output::print(&texts.join("\n"))?;
    }
    Ok(exit(&all, arguments.check))
}

/// A refutation, or what is too weak where that is checked, is worse than what is not decided.
fn exit(all: &[Ruling], check: bool) -> Exit {
    let is_weak = |one: &Ruling| check && one.judged.is_strong() == Some(false);
    let failed = all.iter().any(|one| one.is_refuted() || is_weak(one));
    Exit::of(failed, all.iter().all(Ruling::is_confirmed))
}

/// The answers that are to be judged: those of the file, or the places of a net.
fn answers(arguments: &Judge, subject: &Subject, files: &mut Vec<PathBuf>) -> Result<Vec<Answer>> {
    let Some(path) = &arguments.answer else {
        return subject
            .own_answer()
            .map(|answer| vec![answer])
            .ok_or_else(|| Failure::bad_input("an answer is needed: --answer FILE"));
    };
    let (text, name) = foreign_input::text(path)?;
    let mut answers = formats::answer::parse(&text, &name).map_err(funicular::Error::from)?;
    files.push(path.clone());
    if let Some(path) = &arguments.members {
        let (text, name) = foreign_input::text(path)?;
        let lists =
            formats::answer::parse_member_forces(&text, &name).map_err(funicular::Error::from)?;
        formats::answer::attach_forces(&mut answers, &lists, &name)
            .map_err(funicular::Error::from)?;
        files.push(path.clone());
    }
    Ok(answers)
}
