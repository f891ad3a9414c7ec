//! `funicular page`: a system to look at.

use std::path::PathBuf;

use clap::Args;
use funicular::{Page, Simulate, Start};

use crate::exit::{Exit, Result};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::solve;
use crate::threads::Threads;

/// What the page has.
const HELP: &str = "\
The page shows the equilibrium that both solvers find, all others where a census is complete (of
chains of up to 8 bars, and where it takes a second), each load case and the lowest modes: turned by dragging or the arrow keys, with the forces in the members,
the part of their strength that they use, and how far each shape is proved. With --vary a slider
moves along the load path, with --motion through the motion that a release begins. Where no load
path can be followed, because one has no equilibrium at its start or is lost, over values of a chain
or over a count of bars, the slider moves over the shapes of a study, each solved by itself, at 41
values of a range; the page says which of the two it is. It needs nothing but itself, and stays below
1 MB for 100 members.";

/// `funicular page`.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Drawn,
    /// Write the page to this HTML file
    #[arg(long, value_name = "FILE", value_parser = output::page_file)]
    pub out: PathBuf,
    /// Show the shapes over a range or values of a number of the file, as in `trace` and `study`:
    /// loads=0.5..1.2, bars.A-P.length_m=4..6:21; may be given several times: each combination of
    /// all but the last has a slider of its own
    #[arg(long, value_name = "PARAMETER=VALUES", allow_hyphen_values = true)]
    pub vary: Vec<String>,
    /// Show the motion from here, at rest: `equilibrium:2`, `angles=0,60,-60`, `seed:7`, as --from of
    /// `simulate`
    #[arg(long, value_name = "START", allow_hyphen_values = true)]
    pub motion: Option<Start>,
    /// How long the motion is, s
    #[arg(long, value_name = "S", default_value_t = 10.0, requires = "motion")]
    pub time: f64,
    /// Drag of a medium, 1/s, as in `simulate`
    #[arg(long, value_name = "C", default_value_t = 0.0, requires = "motion")]
    pub damping: f64,
    #[command(flatten)]
    pub threads: Threads,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit> {
    end_on_interrupt()?;
    arguments.threads.install()?;
    let Input { problem, files } = arguments.input.read()?;
    output::check([&arguments.out], &files)?;
    let mut page = arguments.vary.iter().try_fold(Page::new(), |page, text| page.vary(text))?;
    if let Some(start) = &arguments.motion {
        let motion = Simulate::new().start(start.clone());
        page = page.simulate(motion.time_s(arguments.time).damping_1_s(arguments.damping));
    }
    let progress = Progress::start();
    progress.say("equilibria, modes and what moves");
    let found = page.run(&problem)?;
    drop(progress);
    output::write_whole(&arguments.out, found.html())?;
    let remarks = funicular::text::remarks(found.answer());
    output::print(&format!("{}: {}; {remarks}\n", arguments.out.display(), found.contents()))?;
    Ok(solve::verdict(found.answer()))
}
