//! `funicular basins`: which start leads where, as pictures.

use std::path::PathBuf;

use clap::Args;
use funicular::picture::Format;
use funicular::{Basins, Field, Plane};
use model::SolverName;

use crate::cost::tell_time;
use crate::exit::{Exit, Failure, Result};
use crate::input::{Input, Source};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::threads;

const NOTES: &str = "\
Each pixel is a start. Of a chain between two anchors: the angles of two bars from the descending vertical, 0 to 360
degrees; all other bars start at --others. Of any other system: the place of --joint in --plane, through where it
hangs; all other joints start where they hang. Both solvers start there, whether or not the lengths fit. Files:
lagrange.svg and energy.svg (the equilibrium reached), lagrange-iterations.svg and energy-iterations.svg; or .png, .pdf, .dxf.

Examples:
  funicular basins --case three-equal-bars --size 400 --out pictures
  funicular basins --case four-bar-linkage --size 100 --out pictures

Exit codes:
  0  done
  2  bad input or usage
  3  a picture could not be drawn
130  interrupted; nothing is kept to go on from, and no picture is half written";

/// Largest picture: 16 million starts for each solver.
const LARGEST: u32 = 4096;

/// What is drawn, and what the name of the file ends in.
const FIELDS: [(Field, &str); 2] = [(Field::Outcome, ""), (Field::Iterations, "-iterations")];

/// `funicular basins`.
#[derive(Debug, Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Source,
    /// Starts along each side
    #[arg(long, value_name = "N", default_value_t = 300, value_parser = clap::value_parser!(u32).range(2..=i64::from(LARGEST)))]
    pub size: u32,
    /// The two bars of a chain whose angles are the axes [default: 1,2]
    #[arg(long, value_name = "I,J", num_args = 1, value_delimiter = ',')]
    pub bars: Vec<usize>,
    /// Starting angle of all other bars of a chain, degrees from the descending vertical [default: 0]
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    pub others: Option<f64>,
    /// The joint whose place is the start, of a system that is no chain [default: its first free joint]
    #[arg(long, value_name = "NAME")]
    pub joint: Option<String>,
    /// The plane in which its start varies [default: xz]
    #[arg(long, value_enum)]
    pub plane: Option<Plane>,
    /// Write the pictures into this folder (made if it is not there)
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// The form of the pictures
    #[arg(long, value_name = "ENDING", default_value = Format::ENDINGS[0], value_parser = Format::ENDINGS)]
    pub format: String,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit> {
    end_on_interrupt()?;
    threads::install(0)?;
    let Input { problem, files } = arguments.input.read()?;
    let is_chain = problem.row().is_some();
    if is_chain && (arguments.joint.is_some() || arguments.plane.is_some()) {
        let what = "--joint and --plane are for systems by name: of a chain the angles of two bars vary, --bars";
        return Err(Failure::bad_input(what));
    }
    if !is_chain && (arguments.others.is_some() || !arguments.bars.is_empty()) {
        let what = "--bars and --others are for chains between two anchors: of other systems the place of a joint \
                    varies, --joint and --plane";
        return Err(Failure::bad_input(what));
    }
    let [i, j] = match arguments.bars[..] {
        [] => [1, 2],
        [i, j] => [i, j],
        _ => return Err(Failure::bad_input("--bars wants two bars, as in --bars 1,2")),
    };
    let basins = Basins::new().size(arguments.size).bars([i, j]);
    let basins = basins.others_deg(arguments.others.unwrap_or_default());
    let basins = basins.plane(arguments.plane.unwrap_or_default());
    let basins = arguments.joint.iter().fold(basins, |basins, name| basins.joint(name));
    basins.check(&problem)?;
    output::make_folder(&arguments.out)?;
    let solvers = [SolverName::LAGRANGE, SolverName::ENERGY];
    let ending = &arguments.format;
    let picture = |solver: &SolverName, suffix: &str| {
        arguments.out.join(format!("{solver}{suffix}.{ending}"))
    };
    let pictures: Vec<_> = solvers
        .iter()
        .flat_map(|solver| FIELDS.iter().map(|(_, suffix)| picture(solver, suffix)))
        .collect();
    output::check(&pictures, &files)?;
    tell_time("these pictures", basins.expected_time_s(&problem)?);
    let progress = Progress::start();
    progress.say(&format!("{} starts", u64::from(arguments.size).pow(2)));
    let found = basins.run(&problem)?;
    let mut said = String::new();
    for solver in &solvers {
        for (field, suffix) in FIELDS {
            let path = picture(solver, suffix);
            output::write_picture(&path, &found.svg(solver, field)?)?;
            said += &path.display().to_string();
            said.push('\n');
        }
    }
    drop(progress);
    output::print(&(said + &found.to_string()))?;
    Ok(Exit::Done)
}
