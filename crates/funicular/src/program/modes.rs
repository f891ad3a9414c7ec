//! `funicular modes`: small oscillations about equilibria.

use std::path::PathBuf;

use clap::Args;
use funicular::picture::Seen;
use funicular::{ModesAnswer, Page};
use model::system::System;

use crate::exit::{Exit, Failure, Result};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::printed::Printed;
use crate::progress::Progress;
use crate::threads::Threads;

/// What is taken for granted of positions at rest.
const HELP: &str = "\
Inextensible cables that pull and struts that push are bars in small motions, slack ones hold
nothing; joints that the floor pushes slide in its level. What is neither is refused. Bars with
different moments of inertia across have their second axis level (along OY where they are upright),
as in `simulate`. In a load case a factor of weights is one of masses, too.";

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
    #[arg(long, alias = "modes", value_name = "K", value_parser = count, allow_negative_numbers = true)]
    pub lowest: Option<usize>,
    /// Draw the lowest modes of one equilibrium, up to 24, as one file: .svg, .png, .pdf or .dxf
    #[arg(long, visible_alias = "picture", value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// From where the picture is seen
    #[arg(long, value_enum, value_name = "VIEW", default_value_t, requires = "svg")]
    pub view: Seen,
    /// Which equilibrium --svg draws, as it is numbered here: `2`, or `2'`
    #[arg(long, value_name = "LABEL", default_value = "1", requires = "svg")]
    pub equilibrium: String,
    /// Write the page of the system, as `page` does, with these modes moving
    #[arg(long, value_name = "FILE", value_parser = output::page_file)]
    pub html: Option<PathBuf>,
    #[command(flatten)]
    pub threads: Threads,
}

/// A number of modes.
fn count(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|&k| k > 0).ok_or_else(|| "a number from 1 on is required".to_owned())
}

/// Run the command.
pub fn run(arguments: &Modes) -> Result<Exit> {
    arguments.printed.install();
    end_on_interrupt()?;
    arguments.threads.install()?;
    let progress = Progress::start();
    progress.say("reading");
    let Input { problem, files } = arguments.input.read()?;
    let outputs = [&arguments.svg, &arguments.html];
    output::check(outputs.into_iter().flatten(), &files)?;
    progress.say("equilibria and their modes");
    let mut modes = funicular::Modes::new().max_bars(arguments.max_bars);
    if let Some(count) = arguments.lowest {
        modes = modes.lowest(count);
    }
    let answer = modes.run(&problem)?;
    write_drawing(arguments, &problem.system(), &answer)?;
    if let Some(path) = &arguments.html {
        output::write_whole(path, Page::new().modes(modes).run(&problem)?.html())?;
    }
    drop(progress);
    arguments.printed.print(&answer)?;
    Ok(match answer.indices_agree() {
        true if answer.is_neighbour => Exit::Done,
        true => Exit::Undecided,
        false => Exit::CheckFailed,
    })
}

/// The drawing, if it is asked for.
fn write_drawing(arguments: &Modes, system: &System, answer: &ModesAnswer) -> Result<()> {
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
        let svg =
            funicular::drawn_modes(system, found, arguments.view).map_err(Failure::undecided)?;
        output::write_picture(path, &svg)?;
    }
    Ok(())
}
