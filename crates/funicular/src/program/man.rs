//! `funicular man`: manual pages.

use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_mangen::Man as Page;

use crate::args::Cli;
use crate::exit::{Exit, Result};
use crate::output;

/// `funicular man`.
#[derive(Debug, Args)]
pub struct Man {
    /// The folder to write to: `funicular.1` and a page for each command
    #[arg(long, value_name = "DIR", default_value = "man1")]
    pub out: PathBuf,
}

/// Run the command.
pub fn run(arguments: &Man) -> Result<Exit> {
    let mut program = crate::help::with_chapters(Cli::command()).disable_help_subcommand(true);
    program.build();
    output::make_folder(&arguments.out)?;
    let commands = program.get_subcommands().cloned().collect::<Vec<_>>();
    let pages = commands.len() + 1;
    for command in [program].into_iter().chain(commands) {
        // Once built, a command has the name of the program before its own.
        let name = command.get_display_name().unwrap_or(command.get_name());
        let file = arguments.out.join(format!("{name}.1"));
        // What the short help leaves out has its text here.
        let page = Page::new(command.mut_args(|argument| argument.hide_short_help(false)));
        output::write_stream(&file, |to| page.render(to))?;
    }
    output::print(&format!("{pages} pages in {}\n", arguments.out.display()))?;
    Ok(Exit::Done)
}
