//! `funicular page`: a system to look at.

use std::path::PathBuf;

use clap::Args;
use funicular::Page;

use crate::exit::{Exit, Failure};
use crate::input::{Drawn, Input};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::solve;
use crate::threads::Threads;

/// What the page has.
const HELP: &str = "\
The page shows the equilibrium that both solvers find, all others where a census is complete, each
load case and the lowest modes: turned by dragging or the arrow keys, with the forces in the members,
the part of their strength that they use, and how far each shape is proved. With --vary a slider
moves along the load path. It needs nothing but itself.";

/// `funicular page`.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct Arguments {
    #[command(flatten)]
    pub input: Drawn,
    /// Write the page to this HTML file
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Follow the load path over a range of a number of the file, as in `trace`: loads=0.5..1.2,
    /// joints.P.mass_kg=1..5; given several times, all but the last have one value
    #[arg(long, value_name = "PARAMETER=RANGE", allow_hyphen_values = true)]
    pub vary: Vec<String>,
    #[command(flatten)]
    pub threads: Threads,
}

/// Run the command.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    end_on_interrupt()?;
    arguments.threads.install()?;
    let Input { problem, files } = arguments.input.read()?;
    output::check([arguments.out.as_path()], &files)?;
    let page = arguments.vary.iter().try_fold(Page::new(), |page, text| page.vary(text))?;
    let progress = Progress::start();
    progress.say("equilibria, modes and load paths");
    let found = page.run(&problem)?;
    drop(progress);
    output::write_whole(&arguments.out, found.html())?;
    let agreed = found.answer().agreement().map(|agreement| format!("; {}", agreement.verdict));
    let line = format!(
        "{}: {}{}\n",
        arguments.out.display(),
        found.contents(),
        agreed.unwrap_or_default()
    );
    output::print(&line)?;
    Ok(solve::verdict(found.answer()))
}
