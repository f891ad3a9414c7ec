//! `funicular judge`: an answer from elsewhere against a system.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use formats::answer::Answer;
use funicular::judge::{Finding, ForeignAnswer, Judged, fit};
use miette::miette;
use model::system::System;

use crate::exit::{Exit, Failure};
use crate::foreign_input::{self, Given};
use crate::interrupt::end_on_interrupt;
use crate::judged;
use crate::output;
use crate::progress::Progress;
use crate::threads;

/// `funicular judge`.
#[derive(Debug, Args)]
pub struct Judge {
    /// The system: a system file (TOML or JSON, - for standard input), a MoorDyn input file, COMPAS
    /// JSON, or the nodes of a net of force densities as CSV
    #[arg(value_name = "FILE", required_unless_present = "case")]
    pub file: Option<PathBuf>,
    /// Judge against a named case instead of a file
    #[arg(long, value_name = "NAME", conflicts_with = "file")]
    pub case: Option<String>,
    /// How FILE is written
    #[arg(long, value_enum, default_value_t = Format::Auto)]
    pub format: Format,
    /// The edges of a net of force densities (CSV: from, to, q_n_m)
    #[arg(long, value_name = "FILE")]
    pub edges: Option<PathBuf>,
    /// The answer: JSON of `solve --json`, CSV (joint,x_m,y_m,z_m) or VTU, - for standard input.
    /// Nets of force densities have one in their file
    #[arg(long, value_name = "FILE")]
    pub answer: Option<PathBuf>,
    /// Axial forces of the members (CSV: from,to,axial_n)
    #[arg(long, value_name = "FILE", requires = "answer")]
    pub members: Option<PathBuf>,
    /// How well the answer is taken to know its numbers: positions in units of the size of the
    /// system, forces of the largest one
    #[arg(long, value_name = "RELATIVE", default_value_t = validate::foreign::bounds::TOLERANCE)]
    pub tolerance: f64,
    /// Print one JSON object (schema_version 2) instead of tables
    #[arg(long)]
    pub json: bool,
    /// Write the judgement as a page that needs nothing else
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
}

/// How a system is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// By the name and the text: .dat and .txt are MoorDyn's, .csv a net, JSON with a `dtype`
    /// COMPAS's
    Auto,
    /// Our own system file
    Funicular,
    /// A MoorDyn input file, version 1 or 2
    Moordyn,
    /// COMPAS JSON with force densities
    Compas,
    /// Nodes as CSV; --edges has the edges
    ForceDensity,
}

/// One answer with how the system was read for it.
pub struct OneJudged {
    /// The judgement.
    pub judged: Judged,
    /// Sentences about the reading, and about what the judgement leaves out.
    pub notes: Vec<String>,
    /// A joint below a floor that is not part of the system.
    pub on_floor: Option<String>,
}

/// Run the command.
pub fn run(arguments: &Judge) -> Result<Exit, Failure> {
    end_on_interrupt()?;
    threads::install(0)?;
    let standard = |path: &Option<PathBuf>| path.as_deref() == Some(Path::new("-"));
    let readers = [&arguments.file, &arguments.answer, &arguments.members, &arguments.edges];
    if readers.into_iter().filter(|path| standard(path)).count() > 1 {
        return Err(Failure::bad_input(miette!(
            "the system and its answer cannot both come from standard input"
        )));
    }
    let progress = Progress::start();
    progress.say("reading");
    let (given, mut files) = foreign_input::system(arguments)?;
    let answers = answers(arguments, &given, &mut files)?;
    output::check(arguments.html.as_deref(), &files)?;
    let mut all = Vec::new();
    for answer in answers {
        all.push(one(arguments, &given, answer, &progress)?);
    }
    if let Some(path) = &arguments.html {
        write_pages(path, &all)?;
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
        let texts: Vec<_> = all.iter().map(judged::text).collect();
        output::print(&texts.join("\n"))?;
    }
    Ok(exit(&all))
}

/// A refutation is worse than what is not decided.
fn exit(all: &[OneJudged]) -> Exit {
    let refuted = |one: &OneJudged| one.judged.judgement().is_refuted() && one.on_floor.is_none();
    let confirmed =
        |one: &OneJudged| one.judged.judgement().is_confirmed() && one.on_floor.is_none();
    if all.iter().any(refuted) {
        Exit::CheckFailed
    } else if all.iter().all(confirmed) {
        Exit::Done
    } else {
        Exit::Undecided
    }
}

/// The answers that are to be judged: those of the file, or the places of a net.
fn answers(
    arguments: &Judge,
    given: &Given,
    files: &mut Vec<PathBuf>,
) -> Result<Vec<Answer>, Failure> {
    let Some(path) = &arguments.answer else {
        return given
            .own_answer()
            .map(|answer| vec![answer])
            .ok_or_else(|| Failure::bad_input(miette!("an answer is needed: --answer FILE")));
    };
    let (text, name) = foreign_input::text(path)?;
    let mut answers = formats::answer::parse(&text, &name).map_err(funicular::Error::from)?;
    files.push(path.clone());
    if let Some(path) = &arguments.members {
        let (text, name) = foreign_input::text(path)?;
        let lists =
            formats::answer::parse_member_forces(&text, &name).map_err(funicular::Error::from)?;
        foreign_input::attach(&mut answers, &lists, &name)?;
        files.push(path.clone());
    }
    Ok(answers)
}

fn one(
    arguments: &Judge,
    given: &Given,
    answer: Answer,
    progress: &Progress,
) -> Result<OneJudged, Failure> {
    let fitted = |system: &System, answer| fit(system, answer).map_err(funicular::Error::from);
    let (system, answer): (System, ForeignAnswer) = match given {
        Given::System { system, .. } => (system.clone(), fitted(system, answer)?),
        Given::Net(net, file) => {
            let own = net.system_at(&net.places_m(), file).map_err(funicular::Error::from)?;
            let answer = fitted(&own, answer)?;
            let there = net.system_at(&answer.joints_m, file).map_err(funicular::Error::from)?;
            (there, answer)
        }
    };
    let judge = funicular::Judge::new().tolerance(arguments.tolerance);
    let judged = judge.run_watched(&system, &answer, &|what| progress.say(what))?;
    let mut notes = given.notes();
    let on_floor = given.floor_m().and_then(|floor_m| below(&judged, floor_m));
    if let Some(joint) = &on_floor {
        notes.push(format!(
            "undecided: joint {joint} is on or below the floor, which is not part of the system"
        ));
    }
    Ok(OneJudged { judged, notes, on_floor })
}

/// A free joint of the answer, or of the nearest equilibrium, that is not above the floor.
fn below(judged: &Judged, floor_m: f64) -> Option<String> {
    let judgement = judged.judgement();
    let least_m = floor_m + judgement.bounds.position_m;
    let nearest = judgement.nearest().map(|one| &one.equilibrium.joints_m);
    let lists = std::iter::once(&judgement.joints_m).chain(nearest);
    lists
        .flat_map(|places| places.iter().zip(judged.system().joints()))
        .find(|(place, joint)| joint.support.at_m().is_none() && place[2] <= least_m)
        .map(|(_, joint)| joint.name.clone())
}

/// One page, or a page for each answer with its number before the ending.
fn write_pages(path: &Path, all: &[OneJudged]) -> Result<(), Failure> {
    for (k, one) in all.iter().enumerate() {
        let page = one.judged.html(&one.notes);
        if k == 0 {
            output::write_whole(path, &page)?;
            continue;
        }
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        let numbered = path.with_file_name(format!("{stem}-{}.{ending}", k + 1));
        output::check([numbered.as_path()], &[])?;
        output::write_whole(&numbered, &page)?;
    }
    Ok(())
}

/// The finding, with the floor's word on it.
pub fn finding(one: &OneJudged) -> String {
    match (&one.on_floor, one.judged.judgement().finding) {
        (Some(joint), Finding::Confirmed | Finding::Refuted) => {
            let joint = crate::printable::Printable(joint);
            format!(
                "undecided: joint {joint} is on or below the floor, which is not part of the system"
            )
        }
        (_, finding) => finding.to_string(),
    }
}
