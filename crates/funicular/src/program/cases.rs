//! `funicular cases`: the registry of named cases.

use clap::Args;
use model::cases;

use crate::case_name::CaseName;
use crate::exit::{Exit, Failure};
use crate::output;
use crate::tables::table;

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
        None => output::print(&registry())?,
    }
    Ok(Exit::Done)
}

/// The registry: chains and systems.
fn registry() -> String {
    let mut chains = table(["case", "what it is"]);
    for case in cases::all() {
        chains.add_row([case.name, case.about]);
    }
    let mut systems = table(["system of bars", "what it is"]);
    for exhibit in cases::exhibits() {
        systems.add_row([exhibit.name, exhibit.about]);
    }
    format!("{chains}\n\n{systems}\n")
}
