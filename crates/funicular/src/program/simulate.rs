//! `funicular simulate`: a system in motion.

mod columns;
mod ensemble;

use std::io;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use ::columns::Format;
use clap::Args;
use funicular::text::motion::Summary;
use funicular::{Animation, Error, ForceTable, Frames, Order, Problem, Start};
use model::Vector;
use model::system::System;
use motion::MotionError;

use crate::exit::{Exit, Failure, Result};
use crate::foreign_input;
use crate::input::{Drawn, Input, places};
use crate::interrupt::on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::tables::short;

/// `funicular simulate`.
#[derive(Debug, Args)]
#[command(after_long_help = ensemble::HELP)]
pub struct Simulate {
    #[command(flatten)]
    pub input: Drawn,
    /// Where it begins, at rest: `rest` (the stable equilibrium), `equilibrium:2` (as `modes` and
    /// `census` number them), `angles=0,60,-60` (of the members from the descending vertical,
    /// degrees, in the plane of the supports), `seed:7` (at random), or a file with the places of
    /// the joints, as for --near; what these lack to meet the lengths is corrected if it is little
    #[arg(long, value_name = "START", default_value = "rest", allow_hyphen_values = true,
          value_parser = from)]
    pub from: From,
    /// How long, s; with --seeds the longest time until rest
    #[arg(long, value_name = "S", default_value_t = 10.0, allow_negative_numbers = true)]
    pub time: f64,
    /// Length of a step, s; taken in parts where elastic members need shorter ones
    #[arg(long, value_name = "S", default_value_t = 1e-3, allow_negative_numbers = true)]
    pub step: f64,
    /// Time between stored times, s; a thousandth of the whole if not given
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub store: Option<f64>,
    /// Order in the step: 2, or 4 for five times and 8 for seventeen times the work
    #[arg(long, value_name = "P", default_value = "2", value_parser = order)]
    pub order: Order,
    /// Drag of a medium, 1/s: momentum falls at this rate
    #[arg(long, value_name = "C", default_value_t = 0.0, allow_negative_numbers = true)]
    pub damping: f64,
    /// Friction in the joints, N m s: a bar turns on the pin of a joint against K times the rate; the
    /// pin of an anchor is at rest, another turns with its bars, two of which so turn against each
    /// other with K/2
    #[arg(long, value_name = "K", default_value_t = 0.0, allow_negative_numbers = true)]
    pub friction: f64,
    /// Push a joint at the beginning: JOINT=X,Y,Z with the impulse in N s; joints of a chain are
    /// called 0, 1, 2 ... May be given several times
    #[arg(long, value_name = "PUSH", value_parser = push, allow_hyphen_values = true)]
    pub push: Vec<(String, Vector)>,
    /// Forces at joints over time, from a CSV file with the columns time_s, joint, x_n, y_n, z_n;
    /// linear between its times, zero before and after them
    #[arg(long, value_name = "FILE")]
    pub forces: Option<PathBuf>,
    /// Write the stored times as columns with units: `.csv` or `.parquet`; or for ParaView: `x.pvd`,
    /// with a grid of each time in the folder `x` beside it, new or empty; with --seeds the folder
    /// of the rows, new or empty, or with --resume one that holds them
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write the page of the system, as `page` does, with this motion
    #[arg(long, value_name = "FILE", value_parser = output::page_file)]
    pub html: Option<PathBuf>,
    #[command(flatten)]
    pub ensemble: ensemble::Arguments,
}

/// Where a motion begins.
#[derive(Debug, Clone)]
pub enum From {
    Named(Start),
    /// At the places in a file.
    File(PathBuf),
}

fn from(text: &str) -> Result<From, String> {
    let path = Path::new(text);
    let is = |extension: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    match text.parse() {
        Ok(start) => Ok(From::Named(start)),
        Err(_) if path.is_file() || ["csv", "json", "vtu"].into_iter().any(is) => {
            Ok(From::File(path.to_owned()))
        }
        Err(error) => Err(format!("{error}, or a file with the places of the joints")),
    }
}

/// 2, 4 or 8.
fn order(text: &str) -> Result<Order, String> {
    match text {
        "2" => Ok(Order::Second),
        "4" => Ok(Order::Fourth),
        "8" => Ok(Order::Eighth),
        _ => Err("2, 4 or 8 is required".to_owned()),
    }
}

/// `JOINT=X,Y,Z`.
fn push(text: &str) -> Result<(String, Vector), String> {
    let form = "JOINT=X,Y,Z is required, such as 1=0,0.5,0";
    let (joint, impulse) = text.rsplit_once('=').ok_or(form)?;
    let parts: Vec<f64> = impulse
        .split(',')
        .filter_map(|x| x.trim().parse().ok())
        .filter(|x: &f64| x.is_finite())
        .collect();
    let impulse: Vector = parts.try_into().map_err(|_| form)?;
    if impulse.len() != text.matches(',').count() + 1 - joint.matches(',').count() {
        return Err(form.to_owned());
    }
    Ok((joint.to_owned(), impulse))
}

/// What the stored times are written to.
enum Rows<'a> {
    Table(columns::Rows),
    Frames(Frames<'a>),
}

impl<'a> Rows<'a> {
    /// By the ending of the file's name.
    fn create(path: &Path, system: &'a System) -> Result<Self> {
        let is = |ending: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
        if is("pvd") {
            let frames = Frames::create(path, system);
            return frames.map(Self::Frames).map_err(|error| unwritten(path, &error));
        }
        let formats = [Format::Csv, Format::Parquet];
        let format =
            formats.into_iter().find(|format| is(format.extension())).ok_or_else(|| {
                Failure::bad_input(format!(
                    "cannot write {}: its name has to end in .csv, .parquet or .pvd",
                    path.display()
                ))
            })?;
        let rows = columns::Rows::create(path, format, system);
        rows.map(Self::Table).map_err(Failure::undecided)
    }

    fn add(&mut self, now: &motion::Snapshot, path: &Path) -> Result<()> {
        match self {
            Self::Table(rows) => rows.add(now).map_err(Failure::undecided),
            Self::Frames(frames) => frames.add(now).map_err(|error| unwritten(path, &error)),
        }
    }

    fn finish(self, path: &Path) -> Result<()> {
        match self {
            Self::Table(rows) => rows.finish().map_err(Failure::undecided),
            Self::Frames(frames) => frames.finish().map_err(|error| unwritten(path, &error)),
        }
    }
}

/// What is kept of the motion while it runs.
struct Kept<'a> {
    rows: Option<(Rows<'a>, &'a Path)>,
    animation: Option<Animation>,
    failed: Option<Failure>,
    summary: Summary,
}

/// Run the command.
pub fn run(arguments: &Simulate) -> Result<Exit> {
    if let Some(seeds) = arguments.ensemble.seeds {
        return ensemble::run(arguments, seeds);
    }
    let interrupt = on_interrupt()?;
    let progress = Progress::start();
    progress.say("reading");
    let Input { problem, mut files } = arguments.input.read()?;
    let mut simulate = simulate(arguments);
    match &arguments.from {
        From::Named(start) => simulate = simulate.start(start.clone()),
        From::File(path) => {
            let joints_m = places(&problem, path)?;
            simulate = simulate.start(Start::Joints(joints_m));
            files.push(path.clone());
        }
    }
    if let Some(path) = &arguments.forces {
        let (text, name) = foreign_input::text(path)?;
        let forces = ForceTable::parse(&text, &name).map_err(Error::from)?;
        simulate = simulate.forces(forces);
        files.push(path.clone());
    }
    let outputs = [&arguments.out, &arguments.html];
    output::check(outputs.into_iter().flatten(), &files)?;
    let system = problem.system();
    let mut kept = Kept::begin(arguments, &problem, &system)?;
    let stop = interrupt.keep_what_is_done();
    let moved = simulate.run_watched(&problem, &mut |now| {
        kept.add(now);
        progress.say(&format!("{} of {} s", short(now.time_s), short(arguments.time)));
        if kept.failed.is_some() || stop.load(Ordering::SeqCst) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    drop(progress);
    let interrupted = stop.load(Ordering::SeqCst);
    // What is there is replaced by a result alone: a motion up to a step that fails is none, but one to where a ring runs to
    // the end of its span.
    let (parts, jam) = match moved {
        Ok(moved) => (moved.parts_of_step, None),
        Err(Error::Motion(MotionError::Jammed(jam))) if kept.summary.has_begun() => (1, Some(jam)),
        Err(error) => return Err(error.into()),
    };
    kept.finish(arguments)?;
    output::print(&kept.summary.text(&system, interrupted, parts))?;
    if let Some(jam) = jam {
        output::print(&format!("The motion ends before {} s: {jam}.\n", short(arguments.time)))?;
        return Ok(Exit::Undecided);
    }
    Ok(if interrupted { Exit::Interrupted } else { Exit::Done })
}

fn simulate(arguments: &Simulate) -> funicular::Simulate {
    let mut simulate = funicular::Simulate::new()
        .time_s(arguments.time)
        .step_s(arguments.step)
        .damping_1_s(arguments.damping)
        .friction_n_m_s(arguments.friction)
        .order(arguments.order);
    if let Some(store_s) = arguments.store {
        simulate = simulate.store_s(store_s);
    }
    for (joint, impulse) in &arguments.push {
        simulate = simulate.push(joint, *impulse);
    }
    simulate
}

impl<'a> Kept<'a> {
    fn begin(arguments: &'a Simulate, problem: &Problem, system: &'a System) -> Result<Self> {
        let rows = arguments.out.as_deref();
        let rows = rows.map(|path| Ok::<_, Failure>((Rows::create(path, system)?, path)));
        let animated = arguments.html.is_some();
        Ok(Self {
            rows: rows.transpose()?,
            animation: animated.then(|| Animation::new(system).with_equilibria(problem)),
            failed: None,
            summary: Summary::new(system),
        })
    }

    fn add(&mut self, now: &motion::Snapshot) {
        self.summary.add(now);
        if let Some((rows, path)) = &mut self.rows {
            self.failed = rows.add(now, path).err();
        }
        if let Some(animation) = &mut self.animation {
            animation.add(now);
        }
    }

    fn finish(&mut self, arguments: &Simulate) -> Result<()> {
        if let Some(error) = self.failed.take() {
            return Err(error);
        }
        if let Some((rows, path)) = self.rows.take() {
            rows.finish(path)?;
        }
        if let (Some(animation), Some(path)) = (&self.animation, &arguments.html) {
            output::write_whole(path, &animation.page())?;
        }
        Ok(())
    }
}

fn unwritten(path: &Path, error: &io::Error) -> Failure {
    output::not_written(&path.display().to_string(), error)
}
