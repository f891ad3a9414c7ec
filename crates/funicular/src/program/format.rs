//! `funicular format`: the page of the file format.

use model::system_file::FORMAT;

use crate::exit::{Exit, Failure};
use crate::output;

/// Run the command.
pub fn run() -> Result<Exit, Failure> {
    output::print(FORMAT)?;
    Ok(Exit::Done)
}
