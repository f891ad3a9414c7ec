//! `funicular new`: a system file to start from.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::exit::{Exit, Failure, Result};
use crate::output;

/// The file, with a comment for every key.
const TEMPLATE: &str = include_str!("new.toml");

/// The structures to start from.
const TRUSS: &str = "warren-truss";
const SYSTEM: &str = "bridle";

/// Joints along a side of a net: fewer have no joint inside.
const SIDE: std::ops::RangeInclusive<usize> = 3..=200;

/// `funicular new`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("what"))]
pub struct New {
    /// Write it to this file, which must not be there yet; if not given, print it
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// A truss as it is drawn, in the place of a hanging chain
    #[arg(long, group = "what")]
    pub truss: bool,
    /// A system of joints by name
    #[arg(long, group = "what")]
    pub system: bool,
    /// A net of cables of so many joints by so many, held at its edge
    #[arg(long, value_name = "5x5", value_parser = sides, group = "what")]
    pub net: Option<[usize; 2]>,
}

fn sides(text: &str) -> Result<[usize; 2], String> {
    let sides = text.split_once('x').and_then(|(a, b)| Some([a.parse().ok()?, b.parse().ok()?]));
    sides
        .filter(|sides| sides.iter().all(|side| SIDE.contains(side)))
        .ok_or_else(|| format!("two numbers from {} to {}, such as 5x5", SIDE.start(), SIDE.end()))
}

/// Run the command.
pub fn run(arguments: &New) -> Result<Exit> {
    let text = match arguments.net {
        Some(sides) => net(sides),
        None if arguments.truss => funicular::case_text(TRUSS)?.to_owned(),
        None if arguments.system => funicular::case_text(SYSTEM)?.to_owned(),
        None => TEMPLATE.to_owned(),
    };
    match &arguments.file {
        Some(path) => write_new(path, &text)?,
        None => output::print(&text)?,
    }
    Ok(Exit::Done)
}

/// Write a file that is not there yet.
fn write_new(path: &Path, text: &str) -> Result<()> {
    let name = path.display();
    // A link that leads nowhere is there too.
    if path.symlink_metadata().is_ok() {
        let report = format!("{name} exists already and is not overwritten");
        return Err(Failure::bad_input(report));
    }
    output::check([&path.to_path_buf()], &[])?;
    output::write_whole(path, text)?;
    output::print(&format!("{name} is written; `funicular solve {name}` solves it\n"))
}

/// A net over a level rectangle: cables longer by a twentieth than the distance of their joints.
fn net([rows, columns]: [usize; 2]) -> String {
    let edge = |i: usize, n: usize| i == 1 || i == n;
    let mut text = format!(
        "# A net of cables, held at its edge: joints N1_1 to N{rows}_{columns}, without the corners.\n\
         name = \"net of {rows} x {columns}\"\n\n[joints]\n"
    );
    // Writing to a String cannot fail.
    for (i, j) in pairs(rows, columns) {
        match [edge(i, rows), edge(j, columns)] {
            [true, true] => {}
            [false, false] => drop(writeln!(text, "N{i}_{j} = {{ mass_kg = 1 }}")),
            _ => drop(writeln!(text, "N{i}_{j} = {{ at_m = [{}, {}, 0] }}", j - 1, i - 1)),
        }
    }
    for (i, j) in pairs(rows, columns) {
        for [k, l] in [[i, j + 1], [i + 1, j]] {
            // Between two joints of the edge nothing hangs.
            let along_edge = (i == k && edge(i, rows)) || (j == l && edge(j, columns));
            if k <= rows && l <= columns && !along_edge {
                let _ = write!(
                    text,
                    "\n[[bars]]\nfrom = \"N{i}_{j}\"\nto = \"N{k}_{l}\"\nlength_m = 1.05\n\
                     mass_kg = 0.1\nkind = \"cable\"\n"
                );
            }
        }
    }
    text
}

fn pairs(rows: usize, columns: usize) -> impl Iterator<Item = (usize, usize)> {
    (1..=rows).flat_map(move |i| (1..=columns).map(move |j| (i, j)))
}
