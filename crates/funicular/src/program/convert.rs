//! `funicular convert`: the equilibrium as a file for another program, or the system as a file of ours.

use std::path::PathBuf;

use clap::Args;
use funicular::Solve;
use funicular::export::Target;

use crate::diagnostics::Diagnostic;
use crate::exit::{Exit, Failure, Result};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::solve;
use crate::threads::Threads;

/// What is written.
const HELP: &str = "\
The ending of the file says what is written, of the equilibrium that both solvers find:
  .vtu         ParaView: lines with forces and utilisation, joints with reactions
  .dxf         CAD: lines in a layer for each kind of member, joints with names
  .obj .gltf   3D programs: members as prisms, coloured by tension and compression
  .xml         MuJoCo: masses at the joints, members as tendons
  .urdf        MuJoCo, Bullet: bars that hang like trees, as links on ball joints
  .txt .dat    MoorDyn: lines of one segment between points; elastic cables
  .json        COMPAS: a graph with force densities and loads
  .csv         a table of the joints with both answers, as `solve --csv` writes it
  .toml        the system itself, as a file of ours to be edited; nothing is solved
Members as a table are written by `solve --bars-csv`, pictures (.svg, .png, .pdf, flat .dxf) by
`solve --svg`, motions for ParaView (.pvd) by `simulate --out`. What is read may also be lines of
DXF or OBJ, or a file of MoorDyn, MAP++, OpenSees or COMPAS.";

/// Endings of our own system files, and of tables.
const OWN: &str = "toml";
const TABLE: &str = "csv";

/// `funicular convert`.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Drawn,
    /// Write this file; its ending says for which program (see --help)
    #[arg(long, value_name = "FILE")]
    pub to: PathBuf,
    #[command(flatten)]
    pub threads: Threads,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit> {
    end_on_interrupt()?;
    arguments.threads.install()?;
    let ending = arguments.to.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let is = |own: &str| ending.eq_ignore_ascii_case(own);
    let target = Target::of_ending(ending);
    if target.is_none() && !is(OWN) && !is(TABLE) {
        let message = format!("no format has the ending of {}", arguments.to.display());
        let help = format!("there are .{}, .{TABLE}, .{OWN}", Target::ENDINGS.join(", ."));
        return Err(Failure::bad_input(Diagnostic::from(message).with_help(help)));
    }
    let Input { problem, files } = arguments.input.read()?;
    output::check_files([&arguments.to], &files)?;
    if is(OWN) {
        output::write_whole(&arguments.to, &problem.to_toml())?;
        output::print(&format!("{}: a system file\n", arguments.to.display()))?;
        return Ok(Exit::Done);
    }
    let progress = Progress::start();
    progress.say("the equilibrium");
    let found = Solve::new().run(&problem)?;
    drop(progress);
    if found.equilibria().is_empty() {
        eprint!("{}", funicular::text::answer(&found, false, false));
        return Ok(solve::verdict(&found));
    }
    let what = if let Some(target) = target {
        output::write_whole(&arguments.to, &found.export(target)?.unwrap_or_default())?;
        target.describe()
    } else {
        output::write_stream(&arguments.to, |to| found.write_csv(to))?;
        "a table of joints"
    };
    let remarks = funicular::text::remarks(&found);
    output::print(&format!("{}: {what}; {remarks}\n", arguments.to.display()))?;
    Ok(solve::verdict(&found))
}
