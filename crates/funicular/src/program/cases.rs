//! `funicular cases`: the registry of named cases.

use clap::Args;

use crate::case_name::CaseName;
use crate::exit::{Exit, Failure};
use crate::output;
use crate::tables;

/// `funicular cases`.
#[derive(Debug, Args)]
pub struct Cases {
    /// Print the system file of this case
    #[arg(value_name = "NAME", value_parser = CaseName, hide_possible_values = true)]
    pub name: Option<String>,
}

/// Run the command.
pub fn run(arguments: &Cases) -> Result<Exit, Failure> {
    match &arguments.name {
        Some(name) => output::print(funicular::case_text(name)?)?,
        None => output::print(&tables::cases())?,
    }
    Ok(Exit::Done)
}
