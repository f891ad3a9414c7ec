//! `funicular modes`: small oscillations about equilibria.

use std::fmt::Write as _;

use clap::Args;
use funicular::ModesAnswer;

use crate::exit::{Exit, Failure};
use crate::input::{Input, Source};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printable::Printable;
use crate::progress::Progress;
use crate::tables::{numbers_from, short, table};
use crate::threads;

/// `funicular modes`.
#[derive(Debug, Args)]
pub struct Modes {
    #[command(flatten)]
    pub input: Source,
    /// Print one JSON object (schema_version 2) with the shapes instead of tables
    #[arg(long)]
    pub json: bool,
    /// All equilibria, by a census, of chains of up to N bars; the stable one of longer chains and
    /// of other systems
    #[arg(long, value_name = "N", default_value_t = census::Settings::UNASKED_BARS)]
    pub max_bars: usize,
    /// How many modes of each equilibrium, the lowest (negative omega^2 first); if not given, all of
    /// systems of up to 100 joints and 20 of larger ones
    #[arg(long = "modes", value_name = "K", value_parser = count, allow_negative_numbers = true)]
    pub lowest: Option<usize>,
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
    end_on_interrupt()?;
    threads::install(arguments.threads)?;
    let progress = Progress::start();
    progress.say("reading");
    let Input { problem, .. } = arguments.input.read()?;
    progress.say("equilibria and their modes");
    let mut modes = funicular::Modes::new().max_bars(arguments.max_bars);
    if let Some(count) = arguments.lowest {
        modes = modes.lowest(count);
    }
    let answer = modes.run(&problem)?;
    drop(progress);
    if arguments.json {
        output::print_json(&answer)?;
    } else {
        output::print(&text(&answer))?;
    }
    Ok(if answer.indices_agree() { Exit::Done } else { Exit::CheckFailed })
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
        let mut rows = table(["mode", "omega^2, 1/s^2", "frequency, Hz", "rate, 1/s", "what"]);
        for (k, mode) in found.modes.iter().enumerate() {
            let cell = |x: Option<f64>| x.map(short).unwrap_or_default();
            rows.add_row([
                (k + 1).to_string(),
                short(mode.omega2_s2),
                cell(mode.frequency_hz),
                cell(mode.rate_1_s),
                mode.what.clone(),
            ]);
        }
        numbers_from(&mut rows, 1);
        let _ = writeln!(out, "{rows}");
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
