//! `funicular new`: a system file to start from.

use crate::exit::{Exit, Failure};
use crate::output;

/// The file, with a comment for every key.
const TEMPLATE: &str = include_str!("new.toml");

/// Run the command.
pub fn run() -> Result<Exit, Failure> {
    output::print(TEMPLATE)?;
    Ok(Exit::Done)
}
