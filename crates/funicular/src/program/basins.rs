//! `funicular basins`: which start leads where, as pictures.

use std::fmt::Write as _;
use std::path::PathBuf;

use ::sweep::{Axis, Basins, Field, Outcomes, Settings, Source, Sweep};
use clap::Args;
use miette::miette;
use rayon::prelude::*;

use crate::exit::{Exit, Failure};
use crate::input;
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::threads;

const NOTES: &str = "\
Each pixel is a start: the angles of two bars from the descending vertical, 0 to 360 degrees; all other bars start
at --others. Both solvers start there, whether or not the chain closes. Files: lagrange.svg and energy.svg (the
equilibrium reached), lagrange-iterations.svg and energy-iterations.svg.

Example:
  funicular basins --case three-equal-bars --size 400 --out pictures

Exit codes:
  0  done
  2  bad input or usage
  3  a picture could not be drawn
130  interrupted; nothing is kept to go on from, and no picture is half written";

/// Largest picture: 16 million starts for each solver.
const LARGEST: u32 = 4096;

const SOLVERS: [&str; 2] = ["lagrange", "energy"];

/// What is drawn, in words, and what the name of the file ends in.
const FIELDS: [(Field, &str, &str); 2] = [
    (Field::Outcome, "equilibrium reached", ""),
    (Field::Iterations, "iterations spent", "-iterations"),
];

/// `funicular basins`.
#[derive(Debug, Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// The system file (TOML); see `funicular cases three-equal-bars` for one
    #[arg(value_name = "FILE", required_unless_present = "case")]
    pub file: Option<PathBuf>,
    /// A named case instead of a file
    #[arg(long, value_name = "NAME", conflicts_with = "file")]
    pub case: Option<String>,
    /// Starts along each side
    #[arg(long, value_name = "N", default_value_t = 300, value_parser = clap::value_parser!(u32).range(2..=i64::from(LARGEST)))]
    pub size: u32,
    /// The two bars whose angles are the axes
    #[arg(long, value_name = "I,J", num_args = 1, value_delimiter = ',', default_value = "1,2")]
    pub bars: Vec<usize>,
    /// Starting angle of all other bars, degrees from the descending vertical
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true)]
    pub others: f64,
    /// Write the pictures into this folder (made if it is not there)
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    end_on_interrupt()?;
    threads::install(0)?;
    let input = input::problem(arguments.file.as_deref(), arguments.case.as_deref())?;
    let files = input.files.clone();
    let problem = input.into_chain("basins")?;
    let bars = problem.chain().bars().len();
    let [i, j] = axes(arguments, bars)?;
    output::make_folder(&arguments.out)?;
    let picture = |solver: &str, suffix: &str| arguments.out.join(format!("{solver}{suffix}.svg"));
    let pictures: Vec<_> = SOLVERS
        .iter()
        .flat_map(|solver| FIELDS.iter().map(|(_, _, suffix)| picture(solver, suffix)))
        .collect();
    output::check(pictures.iter().map(PathBuf::as_path), &files)?;
    let others = arguments.others.to_radians();
    let axis = |bar: usize| {
        if bar == i || bar == j {
            Axis::full(u64::from(arguments.size))
        } else {
            Axis::fixed(others)
        }
    };
    let settings =
        Settings { source: Source::Grid((1..=bars).map(axis).collect()), ..Settings::default() };
    let progress = Progress::start();
    progress.say("the list of equilibria");
    let solvers = funicular::starts::solvers(&problem)
        .map_err(|error| Failure::bad_input(miette!("{error}")))?;
    let sweep = Sweep::new(&problem, settings, solvers)
        .map_err(|error| Failure::bad_input(miette!("{error}")))?;
    let size = u64::from(arguments.size);
    progress.say(&format!("{} starts", size * size));
    let rows: Vec<_> = (0..size)
        .into_par_iter()
        .map(|row| sweep.run_chunk(row * size..(row + 1) * size))
        .collect();
    let names: Vec<String> = sweep.members().list().iter().enumerate().map(name).collect();
    let fixed = if bars > 2 {
        format!("; all other bars start at {}\u{b0}", arguments.others)
    } else {
        String::new()
    };
    let title = problem.chain().name();
    let labels = [i, j].map(|bar| format!("start of bar {bar} from the vertical / \u{b0}"));
    let mut said = String::new();
    for solver in SOLVERS {
        let mut all = Outcomes::default();
        for chunk in &rows {
            let Some(part) = chunk.of(solver) else { continue };
            all.outcome.extend(&part.outcome);
            all.iterations.extend(&part.iterations);
        }
        let note =
            |field: &str| format!("{field} by {solver} from {size} \u{d7} {size} starts{fixed}");
        for (field, what, suffix) in FIELDS {
            let note = note(what);
            let basins = Basins {
                size: arguments.size,
                outcomes: &all,
                names: &names,
                title,
                note: &note,
                labels: [&labels[0], &labels[1]],
            };
            let drawn = basins.svg(field).map_err(|e| Failure::undecided(miette!("{e}")))?;
            let path = picture(solver, suffix);
            output::write_whole(&path, &drawn)?;
            said += &path.display().to_string();
            said.push('\n');
        }
        let unlisted = ::sweep::Failure::Unlisted as i16;
        let others = all.outcome.iter().filter(|outcome| **outcome == unlisted).count();
        let failed = all.outcome.iter().filter(|outcome| **outcome < 0).count() - others;
        let starts = size * size;
        // Writing to a String cannot fail.
        let _ = writeln!(said, "{solver}: {failed} of {starts} starts reached no equilibrium");
        if others > 0 {
            let _ = writeln!(
                said,
                "{solver}: {others} of {starts} starts reached one that is in no list"
            );
        }
    }
    drop(progress);
    output::print(&said)?;
    Ok(Exit::Done)
}

/// The two bars of the axes, the lower first: the grid runs along it.
fn axes(arguments: &Arguments, bars: usize) -> Result<[usize; 2], Failure> {
    let [i, j] = arguments.bars[..] else {
        return Err(Failure::bad_input(miette!("--bars wants two bars, as in --bars 1,2")));
    };
    if i == j || ![i, j].iter().all(|bar| (1..=bars).contains(bar)) {
        return Err(Failure::bad_input(miette!(
            "--bars {i},{j}: two different bars are needed, and the chain has bars 1 to {bars}"
        )));
    }
    if !arguments.others.is_finite() {
        return Err(Failure::bad_input(miette!("--others must be a finite angle in degrees")));
    }
    Ok([i.min(j), i.max(j)])
}

/// An equilibrium in the legend: its number, energy and kind.
fn name((number, member): (usize, &::sweep::Member)) -> String {
    let kind = match member.index_in_plane {
        Some(0) => ", minimum",
        Some(_) => ", no minimum",
        None => "",
    };
    let mirrored = if member.mirrored { " (mirror image)" } else { "" };
    format!("{number}: {:.4} J{kind}{mirrored}", member.energy_j)
}
