//! `funicular census`: every equilibrium of a system, with proof.

mod list;

use std::path::{Path, PathBuf};

use census::net::LoadedRow;
use census::{CensusError, Settings, rough_time};
use clap::Args;
use funicular::census::List;
use funicular::picture::Seen;
use funicular::{CensusAnswer, Error};
use model::NoCensus;

use crate::cost::tell_time;
use crate::diagnostics::Diagnostic;
use crate::exit::{Exit, Failure, Result};
use crate::input::{Input, Source};
use crate::interrupt::end_on_interrupt;
use crate::memory;
use crate::output;
use crate::printed::Printed;
use crate::progress::Progress;
use crate::threads::Threads;

/// At most so many shapes in the figure: ten rows of seven fit a screen or a page. The help of
/// `--svg` says so.
const SHAPES: usize = 70;

/// `funicular census`.
#[derive(Debug, Args)]
pub struct Census {
    #[command(flatten)]
    pub input: Source,
    #[command(flatten)]
    pub printed: Printed,
    /// Refuse chains of more bars, with an estimate of what they would cost (at most 24)
    #[arg(long, value_name = "N", default_value_t = Settings::default().max_bars)]
    pub max_bars: usize,
    /// Refuse nets of several closures whose joints move in more independent ways than this (at
    /// most 6); joints between two bars that follow from their neighbours are not counted
    #[arg(long, value_name = "N", default_value_t = Settings::default().max_motions)]
    pub max_motions: usize,
    /// Draw the shapes into this file, .svg, .png, .pdf or .dxf: all up to 70, of more the first 70 by energy;
    /// those of one row of bars side by side, of another system, and with --view, each into a file of its own
    /// (FILE-1.svg, FILE-2.svg, ...)
    #[arg(long, visible_alias = "picture", value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// From where the shapes are seen; if not given, those of one row of bars are drawn in their own planes
    #[arg(long, value_enum, value_name = "VIEW", default_value_t, requires = "svg")]
    pub view: Seen,
    /// Write joints and forces, a line per equilibrium and joint, to this CSV file
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// What --json and --csv list of each equilibrium of a row of bars: its signs, pull, energy and indices
    /// in a line (all else follows from signs and pull), or everything. If not given, everything if
    /// that is at most 100 MB of JSON
    #[arg(long, value_name = "WHAT", value_enum)]
    pub list: Option<List>,
    /// Refuse, before the census of a chain of more than 12 bars, lists that would probably be larger
    #[arg(long, value_name = "SIZE", value_parser = memory::parse, default_value = "4GB")]
    pub max_output: u64,
    #[command(flatten)]
    pub threads: Threads,
}

/// Run the command.
pub fn run(arguments: &Census) -> Result<Exit> {
    arguments.printed.install();
    end_on_interrupt()?;
    let Census { max_bars, max_motions, .. } = *arguments;
    let settings = Settings { max_bars, max_motions, ..Settings::default() };
    settings.validate().map_err(Error::from)?;
    arguments.threads.install()?;
    let progress = Progress::start();
    progress.say("reading");
    let Input { problem, files } = arguments.input.read()?;
    let row = LoadedRow::of(&problem.system());
    let side_by_side = row.is_some() && arguments.view == Seen::Best;
    let most = match &arguments.svg {
        Some(path) if !side_by_side => output::numbered(path, SHAPES),
        _ => vec![],
    };
    let outputs = arguments.csv.iter().chain(&arguments.svg).chain(&most);
    output::check(outputs, &files)?;
    let takes_long = Settings::SOUGHT_BARS + 1..=settings.max_bars;
    let long = row.as_ref().filter(|row| takes_long.contains(&row.bars()));
    if let Some(row) = long {
        let estimate = row.estimate();
        list::refuse(arguments, row.bars(), estimate)?;
        tell_time("the census", estimate.seconds);
        progress.say(&cost(estimate));
    }
    if long.is_some() || (row.is_some() && arguments.list == Some(List::Signs)) {
        return list::of_many(arguments, settings, &problem, progress);
    }
    let answer = funicular::Census::new()
        .settings(settings)
        .run_watched(&problem, &|now| progress.say(&how_far(now)))
        .map_err(refuse)?;

    if let Some(path) = &arguments.svg {
        draw(path, &answer, arguments.view)?;
    }
    output::write_asked(arguments.csv.as_ref(), |file| answer.write_csv(file))?;
    drop(progress);
    arguments.printed.print(&answer)?;
    Ok(Exit::of(answer.census.check_failed(), answer.census.is_decided()))
}

/// The shapes of a row of bars side by side; of another system, and from somewhere, each into a file of its own.
fn draw(path: &Path, answer: &CensusAnswer, view: Seen) -> Result<()> {
    let system = answer.system();
    if let Some(row) = answer.row().filter(|_| view == Seen::Best) {
        return output::write_picture(path, &row.census.figure(system.name(), SHAPES));
    }
    let shown = &answer.equilibria[..answer.equilibria.len().min(SHAPES)];
    for (path, shape) in output::numbered(path, shown.len()).iter().zip(shown) {
        let drawn = funicular::picture::of_system(system, &shape.equilibrium, view)
            .map_err(|error| Failure::undecided(format!("no picture: {error}")))?;
        output::write_picture(path, &drawn)?;
    }
    Ok(())
}

fn cost(estimate: census::Estimate) -> String {
    format!(
        "some {:.0e} equilibria, in about {} of one processor",
        estimate.equilibria,
        rough_time(estimate.seconds)
    )
}

fn how_far(now: census::Progress) -> String {
    if now.waiting == 0 {
        return format!("{} zeros proved; their indices, and all of it again", now.proved);
    }
    format!(
        "{} cells done, {} waiting, {} undecided, {} zeros proved",
        now.done, now.waiting, now.undecided, now.proved
    )
}

/// Why there is no census, and how to go on.
fn refuse(error: Error) -> Failure {
    const MOST: usize = Settings::MAX_BARS;
    let help = match error {
        Error::SystemCensus(NoCensus::Motions { motions, .. }, _) if motions <= Settings::MAX_MOTIONS => format!(
            "--max-motions {motions} tries it all the same. A net of three motions takes seconds, each motion more \
             many times as long; what is undecided when the budget is spent is reported. `funicular solve` finds \
             equilibria of nets of any size"
        ),
        Error::SystemCensus(NoCensus::Motions { .. }, _) => {
            "`funicular solve` finds equilibria of nets of any size; nobody knows how many there are".to_owned()
        }
        Error::Census(CensusError::TooManyBars { bars, estimate_s, .. }) if bars <= MOST => format!(
            "--max-bars {bars} takes it all the same, in about {} of one processor (the search is good to a \
             factor of two, from a sample of the patterns; a busy machine takes several times that)",
            rough_time(estimate_s)
        ),
        Error::Census(CensusError::TooManyBars { estimate_s, .. }) => format!(
            "no census goes beyond {MOST} bars, --max-bars or not: the cost doubles with each bar, and this one would \
             take about {}. `funicular solve` finds the hanging equilibrium of a chain of any length",
            rough_time(estimate_s)
        ),
        _ => return error.into(),
    };
    Failure::bad_input(Diagnostic::from(error).with_help(help))
}
