//! `funicular derivatives`: how the equilibrium changes with the numbers of its system.

use std::path::PathBuf;

use clap::Args;
use funicular::text::derivatives::stiffness;
use funicular::{AnchorStiffness, DerivativesAnswer, Summary};
use serde::Serialize;

use crate::exit::{Exit, Result};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printable::Printable;
use crate::printed::Printed;

const EXAMPLES: &str = "\
Without --of and --by: the stiffness matrices of the anchors, dF/dD in N/m.
They hold as long as no slack member becomes taut and no taut one slack. The solver is `lagrange`.

Examples:
  funicular derivatives bridle.toml                           stiffness of its anchors
  funicular derivatives bridle.toml --of joints.P.at_m.z      of a height, by all parameters
  funicular derivatives bridle.toml --of bars.2.axial_n --csv gradient.csv
  funicular derivatives bridle.toml --by bars.1.length_m      of joints and forces, by one

A derivative by a length is that of the bar as it is solved, after a change of temperature, with its mass and its loads as they are, also where the file
gives them a metre; `funicular study --vary bars.1.length_m=...` has the lengths of the file, and what is given a metre follows.

Exit codes:
  0  done
  1  the solvers disagree
  2  bad input or usage
  3  the solver has no answer, it is not the neighbour of the shape given, or it has no derivatives";

/// `funicular derivatives`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Drawn,
    /// The derivatives of this number of the equilibrium by all parameters: `joints.P.at_m.z`,
    /// `bars.2.axial_n`
    #[arg(long, value_name = "NUMBER", conflicts_with = "by")]
    pub of: Option<String>,
    /// The derivatives of joints and forces by this parameter: `bars.1.length_m`,
    /// `joints.P.force_n.x`, `joints.A.at_m.z`
    #[arg(long, value_name = "PARAMETER")]
    pub by: Option<String>,
    /// Write the gradient to this CSV file: columns parameter, derivative, unit
    #[arg(long, value_name = "FILE", requires = "of")]
    pub csv: Option<PathBuf>,
    #[command(flatten)]
    pub printed: Printed,
}

#[derive(Serialize)]
struct Object<T> {
    schema_version: u32,
    system: Summary,
    #[serde(flatten)]
    found: T,
}

#[derive(Serialize)]
struct Anchors {
    anchors: Vec<AnchorStiffness>,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit> {
    arguments.printed.install();
    end_on_interrupt()?;
    let Input { problem, files } = arguments.input.read()?;
    output::check(&arguments.csv, &files)?;
    let derivatives = funicular::Derivatives::new().run(&problem)?;
    if let Some(of) = &arguments.of {
        let found = derivatives.gradient(of)?;
        output::write_asked(arguments.csv.as_ref(), |file| found.write_csv(file))?;
        return print(arguments, &derivatives, &found.to_string(), &found);
    }
    if let Some(by) = &arguments.by {
        let found = derivatives.change(by)?;
        return print(arguments, &derivatives, &found.to_string(), &found);
    }
    let anchors = Anchors { anchors: derivatives.anchor_stiffness()? };
    print(arguments, &derivatives, &stiffness(&anchors.anchors), &anchors)
}

fn print(
    arguments: &Arguments,
    of: &DerivativesAnswer,
    text: &str,
    found: &impl Serialize,
) -> Result<Exit> {
    let system = of.system();
    if arguments.printed.is_json() {
        let (schema_version, system) = (funicular::SCHEMA_VERSION, Summary::new(system));
        output::print_json(&Object { schema_version, system, found })?;
    } else {
        output::print(&format!("{}\n{text}", Printable(system.name())))?;
    }
    let what = match (of.is_neighbour(), of.equilibrium().stability.index_in_space) {
        (true, 0) => return Ok(Exit::Done),
        (true, _) => "unstable",
        (false, _) => "not the neighbour of the shape given",
    };
    eprintln!("warning: the equilibrium is {what}: see `funicular solve`");
    Ok(Exit::Undecided)
}
