//! `funicular new`: a system file to start from.

use clap::Args;

use crate::exit::{Exit, Failure};
use crate::output;

/// The file, with a comment for every key.
const TEMPLATE: &str = include_str!("new.toml");

/// The structure to start from.
const TRUSS: &str = "warren-truss";

/// `funicular new`.
#[derive(Debug, Args)]
pub struct New {
    /// A truss as it is drawn, in the place of a hanging chain
    #[arg(long)]
    pub truss: bool,
}

/// Run the command.
pub fn run(arguments: &New) -> Result<Exit, Failure> {
    output::print(if arguments.truss { funicular::case_text(TRUSS)? } else { TEMPLATE })?;
    Ok(Exit::Done)
}
