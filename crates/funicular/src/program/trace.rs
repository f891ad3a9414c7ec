//! `funicular trace`: all equilibria of a chain over a parameter, and load paths of any system.

use std::path::PathBuf;

use branches::{Abscissa, ContinuationError};
use census::CensusError;
use clap::Args;
use clap::builder::RangedU64ValueParser;
use funicular::{Error, Problem, Trace, TraceAnswer};

use crate::cost::tell_time;
use crate::diagnostics::Diagnostic;
use crate::exit::{Exit, Failure, Result};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printed::Printed;
use crate::progress::Progress;
use crate::threads;
use crate::varied::Varied;

/// What `--csv` writes, in `--help`; the head of the file is tested against it.
const CSV: &str = "\
Write all points of all branches or load paths, a line each, to this CSV file

Columns of a load path:
  path, point                numbers of the path, from 1, and of the point along it, from 0
  one for each parameter     its value, in the unit of the system file
  index                      directions in which the energy falls: 0 is stable; in an event of the part before it
  event                      number of the event that happens here (--json has them all); else empty
  energy_j                   energy, as `solve` has it
  one for each --of          its value
  NAME_x_m, ...              place of each joint
  axial_1_n, ...             force along each bar, tension positive

Columns of all equilibria of a chain:
  path, branch               numbers of the path and of the branch, from 1
  position                   on the path: 0 at its first point, 1 at its last
  one for each parameter     its value, in the unit of the system file
  span_m                     distance of the anchors
  grid                       number of the point among the values asked for, from 1; empty in between
  proved                     true: from a census; false: from the curve
  event                      number of the event that happens here (--json has them all); else empty
  pull_horizontal_n, pull_vertical_n
                             pull of the chain on the first anchor, along the plane's horizontal direction \
and along Z; empty where it is infinite
  energy_j                   energy above the first joint
  index_in_plane, index_in_space
                             directions in which the energy falls: 0 is stable
  angle_1_rad, axial_1_n, ...
                             for each bar its angle from the descending vertical, and the force along it, \
tension positive; empty where it is infinite";

const EXAMPLES: &str = "\
How far a system can be loaded: over a range alone, or of what is no row of rigid bars, one path is followed, from
the equilibrium next to the drawing (near_m of the file, --near; else the hanging one) at the first value on,
through limit points and branch points, stable or not, until it leaves the range of the values:
  --vary loads=0..1.2        all forces and weights times a factor
  --vary loads=0..1.2:200    in steps of at most a 199th of the range (a 24th without a number)
  --vary loads=0,1.2,-1      from 0 towards 1.2, until the path leaves the range from -1 to 1.2
  --vary lengths=1..1.001    all bars times a factor, as when they are heated
  --vary joints.P.force_n.z=0..-50          --vary bars.3.length_m=1..0.9
Located are limit points (the load turns), branch points, cables and struts that become slack or taut, joints
that meet the floor; with --branches the paths that branch off are followed. --of names what is shown, as in `funicular study`: joints.P.z, bars.3.axial_n

All equilibria of a chain (a row of rigid bars between two anchors, under upright loads), over values (any number
of the system file that keeps it a chain, a list or a range with points):
  --vary anchors.end_m.z=-2.9..-0.1:500     --vary bars.2.mass_kg=0.1,1,10
  --vary gravity_m_s2=1.62,9.80665          --vary 'bars.*.length_m=0.5..2:31'
  --vary joints.lamp.mass_kg=1..5:9         --vary loads=0.5,1
Bars are counted from 1 in the order of the file; in the columns, and in the angles of --json, along the row from
the support that comes first in the file. A number that varies itself is no part of loads or lengths. Between values the parameter runs straight. Branches are followed
along the last parameter; each combination of the others is a path of its own (or all go in step: --zip).

Examples:
  funicular trace --case star-dome --vary loads=0..20 --svg dome.svg --html dome.html
  funicular trace --case three-equal-bars --vary anchors.end_m.z=-3.1..-0.1:500 --over-span --svg paper.svg
  funicular trace chain.toml --vary bars.2.mass_kg=0.1..10:200 --csv branches.csv --json | jq .traces[0].events

Exit codes:
  0  done; all points of a load path are confirmed by `energy`, the censuses of a chain by its branches
  1  a check failed: a point is not confirmed, a census differs from the branches
  2  bad input or usage, or no point describes a chain
  3  undecided: no equilibrium at the start of a load path, a path that is lost, or that ends before its range
     where forces have no bound, many shapes are at rest, a bar has no length or a rope jams; of a chain: a branch could not be followed, a
     branch point lacks its branches, or nothing is known between two points
130  interrupted; nothing is kept to go on from, and no file is half written

A load path says nothing of other equilibria. Of a chain a pair of branches that begins and ends between two
censuses, meeting no other, is not seen: take more points.";

/// `funicular trace`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Drawn,
    #[command(flatten)]
    pub varied: Varied,
    /// Show a number along a load path: `joints.P.z`, `bars.3.axial_n` (repeatable)
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub of: Vec<String>,
    /// Follow also the paths that branch off a load path, and those that branch off from them to this
    /// depth, at most 64: --branches, --branches=2
    #[arg(long, value_name = "DEPTH", num_args = 0..=1, require_equals = true, default_missing_value = "1",
        default_value_t = 0, hide_default_value = true, value_parser = RangedU64ValueParser::<usize>::new().range(0..=64))]
    pub branches: usize,
    /// Estimate beside a load path where it buckles: the stiffness at its start, extrapolated
    #[arg(long)]
    pub linear_buckling: bool,
    #[command(flatten)]
    pub printed: Printed,
    /// Write all points of all branches or load paths, a line each, to this CSV file (columns: --help)
    #[arg(long, value_name = "FILE", long_help = CSV)]
    pub csv: Option<PathBuf>,
    /// Write the diagram to this file, .svg, .png, .pdf or .dxf: all branches, or load over displacement (with several paths: FILE-1.svg, FILE-2.svg,
    /// ...)
    #[arg(long, visible_alias = "picture", value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Write one HTML file in which the shape moves along its load paths
    #[arg(long, value_name = "FILE", value_parser = output::page_file)]
    pub html: Option<PathBuf>,
    /// Most points: of a load path (1000 if not given), or of all paths of a chain together (100000):
    /// all that is found is held in memory, some 4 kB for each equilibrium at each point
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_points: Option<usize>,
    /// Draw the diagram over the distance of the anchors instead of the parameter
    #[arg(long)]
    pub over_span: bool,
    /// Draw the angle of this bar, from 1
    #[arg(long, value_name = "BAR", default_value_t = 1)]
    pub bar: usize,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit> {
    arguments.printed.install();
    end_on_interrupt()?;
    threads::install(0)?;
    let Input { problem, files } = arguments.input.read()?;
    let trace = Trace::new().over(arguments.varied.parameters()?);
    let trace = arguments.of.iter().fold(trace, Trace::of);
    let trace = arguments.max_points.map_or(trace.clone(), |most| trace.max_points(most));
    let trace = trace.branches(arguments.branches);
    let trace = if arguments.linear_buckling { trace.linear_buckling() } else { trace };
    let load = trace.is_load_path(&problem);
    let paths = if load {
        trace.load_variation(&problem)?.paths().len()
    } else {
        all(arguments, &trace, &problem)?
    };
    let diagrams =
        arguments.svg.as_deref().map_or_else(Vec::new, |path| output::numbered(path, paths));
    if arguments.html.is_some() && !load {
        return Err(Failure::bad_input(
            "--html shows load paths: over a range alone, as --vary loads=0..1.2".to_owned(),
        ));
    }
    output::check(arguments.csv.iter().chain(&arguments.html).chain(&diagrams), &files)?;
    let progress = Progress::start();
    let watch = |path, branches::Progress { done, total }| {
        let which =
            if paths > 1 { format!("path {} of {paths}: ", path + 1) } else { String::new() };
        let what =
            if load { format!("{done} points") } else { format!("census {done} of {total}") };
        progress.say(&format!("{which}{what}"));
    };
    let found = trace.run_watched(&problem, &watch).map_err(refuse)?;
    drop(progress);
    // Results are replaced by results alone: a refusal comes before any file.
    let exit = verdict(&found)?;
    output::write_asked(arguments.csv.as_ref(), |file| found.write_csv(file))?;
    let abscissa = if arguments.over_span { Abscissa::Span } else { Abscissa::Parameter };
    for (path, file) in diagrams.iter().enumerate() {
        if let Some(drawn) = found.diagram(path, abscissa, arguments.bar) {
            output::write_picture(file, &drawn)?;
        }
    }
    if let (Some(file), Some(paths)) = (&arguments.html, found.load_paths()) {
        output::write_whole(file, &paths.page())?;
    }
    arguments.printed.print(&found)?;
    Ok(exit)
}

/// What all equilibria of a chain need: how many paths there are.
fn all(arguments: &Arguments, trace: &Trace, problem: &Problem) -> Result<usize> {
    let variation = trace.variation(problem)?;
    let bars = variation.base().members().len();
    if !(1..=bars).contains(&arguments.bar) {
        return Err(Failure::bad_input(format!(
            "there is no bar {}: the chain has {bars} bars, numbered from 1",
            arguments.bar
        )));
    }
    if bars <= census::Settings::default().max_bars {
        tell_time("this trace", trace.expected_time_s(problem)?);
    }
    Ok(variation.paths().len())
}

/// Why nothing is followed, and what can be.
fn refuse(error: Error) -> Failure {
    let too_long = |error: &Error| {
        let Error::Continuation(ContinuationError::Census(census)) = error else { return false };
        matches!(census, CensusError::TooManyBars { .. })
    };
    if !too_long(&error) {
        return error.into();
    }
    let help = "`funicular study FILE --vary ...` takes the same parameters and follows the hanging shape of a chain \
                of any length, `trace` over a range alone one path; to follow all equilibria, take bars together"
        .to_owned();
    Failure::bad_input(Diagnostic::from(error).with_help(help))
}

fn verdict(found: &TraceAnswer) -> Result<Exit> {
    if let Some(reason) = found.refused_everywhere() {
        return Err(Failure::bad_input(format!(
            "no value of the parameters describes a chain that can hang; the first: {reason}"
        )));
    }
    // A load path that is lost is not decided, however well its points are confirmed.
    let lost = found.load_paths().is_some() && !found.checks_decided();
    Ok(if found.checks_agree() && !lost {
        Exit::Done
    } else if found.checks_decided() || (lost && !found.checks_agree()) {
        Exit::CheckFailed
    } else {
        Exit::Undecided
    })
}
