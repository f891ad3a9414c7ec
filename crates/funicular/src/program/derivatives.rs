//! `funicular derivatives`: how the equilibrium changes with the numbers of its system.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use funicular::{AnchorStiffness, NumberGradient, ParameterChange};
use model::Vector;
use model::system::System;
use serde::Serialize;

use crate::exit::{Exit, Failure};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printable::Printable;
use crate::printed::Printed;
use crate::tables::{numbers_from, short, table};

/// Of a gradient the largest are printed; of more anchors each alone.
const PRINTED: usize = 24;
const MOST_ANCHORS: usize = 3;

const EXAMPLES: &str = "\
Without --of and --by: the stiffness matrices of the anchors, dF/dD in N/m.
They hold as long as no slack member becomes taut and no taut one slack. The solver is `lagrange`.

Examples:
  funicular derivatives bridle.toml                           stiffness of its anchors
  funicular derivatives bridle.toml --of joints.P.at_m.z      of a height, by all parameters
  funicular derivatives bridle.toml --of bars.2.axial_n --csv gradient.csv
  funicular derivatives bridle.toml --by bars.1.length_m      of joints and forces, by one

Exit codes:
  0  done
  2  bad input or usage
  3  the solver has no answer, or the equilibrium no derivatives";

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
struct Object<'a, T> {
    schema_version: u32,
    system: SystemName<'a>,
    #[serde(flatten)]
    found: T,
}

#[derive(Serialize)]
struct SystemName<'a> {
    name: &'a str,
    joints: usize,
    bars: usize,
}

#[derive(Serialize)]
struct Anchors {
    anchors: Vec<AnchorStiffness>,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    arguments.printed.install();
    end_on_interrupt()?;
    let Input { problem, files } = arguments.input.read()?;
    output::check(arguments.csv.iter().map(PathBuf::as_path), &files)?;
    let derivatives = funicular::Derivatives::of(&problem)?;
    let system = derivatives.system();
    if let Some(of) = &arguments.of {
        let found = derivatives.gradient(of)?;
        if let Some(path) = &arguments.csv {
            output::write_stream(path, |file| found.write_csv(file))?;
        }
        return print(arguments.printed.is_json(), system, &gradient(&found), &found);
    }
    if let Some(by) = &arguments.by {
        let found = derivatives.change(by)?;
        return print(arguments.printed.is_json(), system, &change(&found), &found);
    }
    let anchors = Anchors { anchors: derivatives.anchor_stiffness()? };
    print(arguments.printed.is_json(), system, &stiffness(&anchors.anchors), &anchors)
}

fn print(json: bool, system: &System, text: &str, found: &impl Serialize) -> Result<Exit, Failure> {
    let name = system.name();
    if json {
        let schema_version = funicular::SCHEMA_VERSION;
        let (joints, bars) = (system.joints().len(), system.members().len());
        let system = SystemName { name, joints, bars };
        output::print_json(&Object { schema_version, system, found })?;
    } else {
        output::print(&format!("{}\n{text}", Printable(name)))?;
    }
    Ok(Exit::Done)
}

fn stiffness(pairs: &[AnchorStiffness]) -> String {
    let mut text = String::new();
    let own = pairs.iter().filter(|pair| pair.of == pair.by).count();
    let shown = pairs.iter().filter(|pair| own <= MOST_ANCHORS || pair.of == pair.by);
    for pair in shown {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "\nforce of the ground at {} by a move of {}, N/m:",
            Printable(&pair.of),
            Printable(&pair.by)
        );
        let mut rows = table(["", "by x", "by y", "by z"]);
        for (axis, row) in ["Fx", "Fy", "Fz"].into_iter().zip(pair.stiffness_n_m) {
            let cells = row.map(|x| rounded(x, largest(pair)));
            rows.add_row([axis.to_owned()].into_iter().chain(cells));
        }
        numbers_from(&mut rows, 1);
        let _ = writeln!(text, "{rows}");
    }
    if own > MOST_ANCHORS {
        let _ = writeln!(text, "\n({own} anchors; --json has the matrices of all pairs)");
    }
    text
}

fn largest(pair: &AnchorStiffness) -> f64 {
    pair.stiffness_n_m.as_flattened().iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// A number for reading; what is a rounding of zero beside the largest is 0.
fn rounded(x: f64, largest: f64) -> String {
    const ROUNDING: f64 = 1e-12;
    short(if x.abs() <= ROUNDING * largest { 0.0 } else { x })
}

fn gradient(found: &NumberGradient) -> String {
    let mut order: Vec<_> = found.derivatives.iter().collect();
    order.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
    let mut text = format!("\n{} = {}\n", Printable(&found.of), short(found.value));
    let mut rows = table(["parameter", "derivative", "unit"]);
    for one in order.iter().take(PRINTED) {
        // What is a zero depends on the unit.
        let alike = found.derivatives.iter().filter(|other| other.unit == one.unit);
        let value = rounded(one.value, alike.fold(0.0, |most, other| other.value.abs().max(most)));
        rows.add_row([Printable(&one.parameter).to_string(), value, one.unit.clone()]);
    }
    numbers_from(&mut rows, 1);
    let _ = writeln!(text, "{rows}");
    if order.len() > PRINTED {
        let all = order.len();
        let _ = writeln!(text, "(the largest {PRINTED} of {all}; --csv and --json have all)");
    }
    text
}

fn change(found: &ParameterChange) -> String {
    let mut text = format!("\nper {} of {}\n", found.unit, Printable(&found.by));
    vectors(&mut text, ["joint", "x / m", "y / m", "z / m"], &found.joints_m);
    vectors(&mut text, ["support", "Fx / N", "Fy / N", "Fz / N"], &found.reactions_n);
    let mut rows = table(["bar", "axial / N"]);
    let most = found.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
    for (k, force) in found.axial_n.iter().enumerate().take(PRINTED) {
        rows.add_row([(k + 1).to_string(), rounded(*force, most)]);
    }
    numbers_from(&mut rows, 1);
    let _ = writeln!(text, "{rows}");
    more(&mut text, found.axial_n.len());
    text
}

fn vectors(text: &mut String, head: [&str; 4], list: &[(String, Vector)]) {
    let mut rows = table(head);
    let all = list.iter().flat_map(|(_, v)| v);
    let most = all.fold(0.0, |most: f64, x| most.max(x.abs()));
    for (name, v) in list.iter().take(PRINTED) {
        let cells = v.map(|x| rounded(x, most));
        rows.add_row([Printable(name).to_string()].into_iter().chain(cells));
    }
    numbers_from(&mut rows, 1);
    let _ = writeln!(text, "{rows}");
    more(text, list.len());
}

fn more(text: &mut String, all: usize) {
    if all > PRINTED {
        let _ = writeln!(text, "(the first {PRINTED} of {all}; --json has all)");
    }
}
