//! `funicular study`: the hanging shape over a parameter.

use std::path::PathBuf;

use clap::Args;
use funicular::Study;

use crate::exit::{Exit, Failure, Result};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printed::Printed;
use crate::progress::Progress;
use crate::threads::Threads;
use crate::varied::Varied;

/// What `--csv` writes, in `--help`; the head of the file is tested against it.
const CSV: &str = "\
Write a line per point to this CSV file

Columns:
  path                       number of the path, from 1: each combination of all parameters but the last
  one for each parameter     its value, in the unit of the system file
  span_m                     of one row of rigid bars between two anchors: their distance
  agrees                     whether both solvers agree and the judge finds both in balance
  evidence                   the highest rung reached
  energy_j                   energy above the first support
  sag_m                      the largest depth of a joint below the line between the ends of its row of
                             members; where no row spans anything, below the lowest support
  lowest_joint, lowest_x_m, lowest_y_m, lowest_z_m
                             the lowest joint, by name or in a chain from 0, and where it is
  tension_n, tension_bar, compression_n, compression_bar
                             the largest axial forces and their bars, from 1; empty where there is none
  NAME_x_n, NAME_y_n, NAME_z_n
                             force of the ground at each support, by the name of the joint
  rise_1_deg, ...            how steeply each bar rises, from the level
  one for each --of          its value
  refused                    why there is no shape; else empty";

const EXAMPLES: &str = "\
A parameter is a number of the system file and its values, as in `funicular trace`; it means
what it means in the file:
  --vary anchors.end_m.x=0.5..2.6:50        --vary bars.2.mass_kg=0.1,1,10
A system with joints by name has besides
  --vary joints.P.force_n.x=0..50:51        --vary joints.B.at_m.x=1..3:21
  --vary 'bars.*.stiffness_n=1e4,1e6'       --vary floor_m=-3..-1:5
  --vary bars.1.prestress_n=0..200:21
  --vary bars.1.length_tolerance_m=1e-3
  --vary loads=1,1.35                       --vary lengths=1,1.001
are factors of all masses and forces, or lengths, but those that vary themselves: these are what they say.
Forces on bars and directions of supports do not vary. [[loads]] at a joint and the factors of a load case stay beside what
varies there. Lengths that a drawing gives stay when a support moves: it settles.
Bars are numbered from 1 as they are solved: a table with count = 3 is three bars, of which
  --vary bars.4-6.mass_kg=1,2
  --vary 'bars.A-P.*.length_m=0.5..0.6:5'
are a range and a row of a system, by the joints at its ends. A rider between two rows of one rope
moves along it by the share of the first side; both sides together keep their length, and each its
mass and loads per metre:
  --vary joints.rider.share=0.1..0.9:17
The bars of a row, of the length, mass
and loads that all of them have together, are more or fewer by
  --vary bars.1.count=2..10                 --vary bars.A-P.count=5,10,20
(the row of equal bars that bar 1 is in; numbers of bars and joints elsewhere stay those of the file).

--of shows, in the place of sag and forces,
  --of joints.rider       where a joint is (joints.rider.z: its height alone)
  --of sag.A-B            how deep the row of members from A to B hangs below the line between them
  --of bars.3.axial_max_n the axial force of a bar where it is largest, tension positive
                          (axial_from_n and axial_to_n: at its ends)
  --of utilisation        which part of its strength the weakest bar uses (bars.3.utilisation: one)
  --of height=-2.5        the height of the lowest joint over z = -2.5 m; `height` alone: over the floor

Examples:
  funicular study chain.toml --vary anchors.end_m.x=0.5..2.6:50 --svg sag.svg
  funicular study --case three-equal-bars --vary anchors.end_m.z=-2.9..-0.1:100 --csv study.csv
  funicular study --case lamp --vary joints.lamp.mass_kg=1..5:21

Exit codes: the worst that `solve` ends with at any point that can hang
  0  done; both solvers agree wherever the system can hang
  1  a check failed: the solvers disagree somewhere
  2  bad input or usage, or no point describes what can hang
  3  a solver has no answer somewhere, or one that is not decided
130  interrupted; no file is half written";

/// `funicular study`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Drawn,
    #[command(flatten)]
    pub varied: Varied,
    /// Show a number of each shape: `joints.rider`, `sag.A-B`, `bars.3.axial_max_n`, `utilisation`, `height=-2.5`
    /// (repeatable)
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub of: Vec<String>,
    #[command(flatten)]
    pub printed: Printed,
    /// Write a line per point to this CSV file (columns: --help)
    #[arg(long, value_name = "FILE", long_help = CSV)]
    pub csv: Option<PathBuf>,
    /// Draw sag, forces and angles over the last parameter to this file, .svg, .png, .pdf or .dxf (with several paths:
    /// FILE-1.svg, FILE-2.svg, ...)
    #[arg(long, visible_alias = "picture", value_name = "FILE")]
    pub svg: Option<PathBuf>,
    #[command(flatten)]
    pub threads: Threads,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit> {
    arguments.printed.install();
    end_on_interrupt()?;
    arguments.threads.install()?;
    let Input { problem, files } = arguments.input.read()?;
    let study = Study::new().over(arguments.varied.parameters()?);
    let study = arguments.of.iter().fold(study, Study::of);
    let lengths = study.points(&problem)?;
    let (paths, points) = (lengths.len(), lengths.iter().sum::<usize>());
    let figures =
        arguments.svg.as_deref().map_or_else(Vec::new, |path| output::numbered(path, paths));
    output::check(arguments.csv.iter().chain(&figures), &files)?;
    let progress = Progress::start();
    let found = study.run_watched(&problem, &progress.counter(points, "points"))?;
    drop(progress);
    // Results are replaced by results alone: a refusal comes before any file.
    if let Some(reason) = found.refused_everywhere() {
        return Err(Failure::bad_input(format!(
            "no value of the parameters describes what can hang; the first: {reason}"
        )));
    }
    output::write_asked(arguments.csv.as_ref(), |file| found.write_csv(file))?;
    for (path, file) in figures.iter().enumerate() {
        output::write_picture(file, &found.figure(path + 1))?;
    }
    arguments.printed.print(&found)?;
    Ok(Exit::of(found.check_failed(), found.is_decided()))
}
