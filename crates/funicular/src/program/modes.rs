//! `funicular modes`: small oscillations about equilibria.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use comfy_table::{CellAlignment, ColumnConstraint};
use funicular::{Enclosed, ModesAnswer, WithModes};
use model::system::System;

use crate::exit::{Exit, Failure};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printable::Printable;
use crate::printed::Printed;
use crate::progress::Progress;
use crate::tables::{Table, numbers_from, short, table, wrapped};
use crate::threads;

/// What is taken for granted of positions at rest.
const HELP: &str = "\
Inextensible cables that pull and struts that push are bars in small motions, slack ones hold
nothing; joints that the floor pushes slide in its level. What is neither is refused. Bars with
different moments of inertia across have their second axis level (along OY where they are upright),
as in `simulate`.";

/// `funicular modes`.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct Modes {
    #[command(flatten)]
    pub input: Drawn,
    #[command(flatten)]
    pub printed: Printed,
    /// All equilibria, by a census, of chains of up to N bars; the stable one of longer chains and
    /// of other systems
    #[arg(long, value_name = "N", default_value_t = census::Settings::UNASKED_BARS)]
    pub max_bars: usize,
    /// How many modes of each equilibrium, the lowest (negative omega^2 first); if not given, all
    /// of systems of up to 100 joints and 20 of larger ones
    #[arg(long = "modes", value_name = "K", value_parser = count, allow_negative_numbers = true)]
    pub lowest: Option<usize>,
    /// Draw the lowest modes of one equilibrium, up to 24, as one SVG file
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Which equilibrium --svg draws, as it is numbered here: `2`, or `2'`
    #[arg(long, value_name = "LABEL", default_value = "1", requires = "svg")]
    pub equilibrium: String,
    /// Write all modes, moving, in one HTML file
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// How many threads; 0 means one per processor. The answer does not depend on it
    #[arg(long, value_name = "T", default_value_t = 0, value_parser = threads::parse, allow_negative_numbers = true)]
    pub threads: usize,
}

/// A number of modes.
fn count(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|&k| k > 0).ok_or_else(|| "a number from 1 on is wanted".to_owned())
}

/// Run the command.
pub fn run(arguments: &Modes) -> Result<Exit, Failure> {
    arguments.printed.install();
    end_on_interrupt()?;
    threads::install(arguments.threads)?;
    let progress = Progress::start();
    progress.say("reading");
    let Input { problem, files } = arguments.input.read()?;
    let outputs = [&arguments.svg, &arguments.html];
    output::check(outputs.into_iter().flatten().map(PathBuf::as_path), &files)?;
    progress.say("equilibria and their modes");
    let mut modes = funicular::Modes::new().max_bars(arguments.max_bars);
    if let Some(count) = arguments.lowest {
        modes = modes.lowest(count);
    }
    let answer = modes.run(&problem)?;
    drop(progress);
    write_pictures(arguments, &funicular::system_of(&problem), &answer)?;
    if arguments.printed.is_json() {
        output::print_json(&answer)?;
    } else {
        output::print(&text(&answer))?;
    }
    Ok(if answer.indices_agree() { Exit::Done } else { Exit::CheckFailed })
}

/// The drawing and the page that are asked for.
fn write_pictures(arguments: &Modes, system: &System, answer: &ModesAnswer) -> Result<(), Failure> {
    if let Some(path) = &arguments.svg {
        let found = answer.equilibria.iter().find(|found| found.label == arguments.equilibrium);
        let Some(found) = found else {
            let labels: Vec<&str> = answer.equilibria.iter().map(|e| e.label.as_str()).collect();
            return Err(Failure::bad_input(format!(
                "there is no equilibrium {:?}; there are {}",
                arguments.equilibrium,
                labels.join(", ")
            )));
        };
        let svg = funicular::drawn_modes(system, found).map_err(Failure::undecided)?;
        output::write_whole(path, &svg)?;
    }
    if let Some(path) = &arguments.html {
        output::write_whole(path, &funicular::animated_modes(system, answer))?;
    }
    Ok(())
}

/// The modes of an equilibrium as a table.
fn rows(found: &WithModes) -> Table {
    let head = ["mode", "omega^2, 1/s^2", "+-", "f, Hz", "rate, 1/s", "what"];
    let is_enclosed = matches!(found.enclosed, Enclosed::Reached { .. });
    let shown = |column: &usize| is_enclosed || *column != 2;
    let mut rows = table(head.into_iter().enumerate().filter(|(k, _)| shown(k)).map(|(_, h)| h));
    for (k, mode) in found.modes.iter().enumerate() {
        let cell = |x: Option<f64>| x.map(short).unwrap_or_default();
        let cells = [
            (k + 1).to_string(),
            short(mode.omega2_s2),
            mode.omega2_between_s2.map(|ends| within(mode.omega2_s2, ends)).unwrap_or_default(),
            cell(mode.frequency_hz),
            cell(mode.rate_1_s),
            mode.what.clone(),
        ];
        rows.add_row(cells.into_iter().enumerate().filter(|(k, _)| shown(k)).map(|(_, c)| c));
    }
    numbers_from(&mut rows, 1);
    // Numbers are whole, and words take what is left of the line.
    if let Some(number) = rows.column_mut(0) {
        number.set_constraint(ColumnConstraint::ContentWidth);
    }
    if let Some(what) = rows.column_iter_mut().last() {
        what.remove_constraint();
        what.set_cell_alignment(CellAlignment::Left);
    }
    rows
}

/// How far from a number the ends of its enclosure lie at most: one digit, rounded up.
fn within(x: f64, [low, high]: [f64; 2]) -> String {
    let most = (high - x).max(x - low);
    if most <= 0.0 {
        return "0".to_owned();
    }
    // A digit that is rounded down is the next one: at most 9 becomes 10.
    let rounded = format!("{most:.0e}");
    if rounded.parse().is_ok_and(|shown: f64| shown >= most) {
        return rounded;
    }
    let unit = 10.0_f64.powf(most.log10().floor());
    format!("{:.0e}", most + unit)
}

/// What is proved of the frequencies, in words.
fn proved(enclosed: &Enclosed) -> String {
    match enclosed {
        Enclosed::Reached { width_m, inertia: Some(inertia) } => format!(
            "every omega^2 is enclosed by interval arithmetic, about an equilibrium proved in a box {width_m:.1e} m wide; \
             proved: {} negative, {} zero, {} positive",
            inertia.negative, inertia.zero, inertia.positive
        ),
        Enclosed::Reached { width_m, inertia: None } => format!(
            "every omega^2 is enclosed by interval arithmetic, about an equilibrium proved in a box {width_m:.1e} m wide; \
             where the enclosure holds zero the sign is not proved"
        ),
        Enclosed::Open { because } => {
            format!("omega^2 are not enclosed by interval arithmetic: {because}")
        }
        _ => String::new(),
    }
}

fn text(answer: &ModesAnswer) -> String {
    let mut out = format!("{}\n", Printable(&answer.system.name));
    for found in &answer.equilibria {
        let (listed, all) = (found.modes.len(), found.modes_in_all);
        let _ = writeln!(
            out,
            "\nequilibrium {}, {} J, by {}: {all} modes, {} leave it",
            found.label,
            short(found.energy_j),
            found.solver,
            found.index_by_modes
        );
        if listed < all {
            let _ = writeln!(
                out,
                "the lowest {listed}; the inertia of the factorised stiffness counts no other below"
            );
        }
        let _ = writeln!(out, "{}", rows(found));
        let _ = writeln!(out, "{}", wrapped(&proved(&found.enclosed), 2));
        if found.index_in_space != found.index_by_modes {
            let _ = writeln!(
                out,
                "the solver has {} directions in which the energy falls",
                found.index_in_space
            );
        }
    }
    let all = if answer.complete {
        "These are all equilibria, by the census."
    } else {
        "Of the equilibria that the solvers find; there may be others."
    };
    let _ = writeln!(out, "\n{all}");
    out
}
