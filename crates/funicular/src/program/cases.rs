//! `funicular cases`: the registry of named cases.

use clap::Args;
use miette::miette;
use model::cases;

use crate::exit::{Exit, Failure};
use crate::output;
use crate::tables;

/// `funicular cases`.
#[derive(Debug, Args)]
pub struct Cases {
    /// Print the system file of this case
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

/// Run the command.
pub fn run(arguments: &Cases) -> Result<Exit, Failure> {
    match &arguments.name {
        Some(name) => output::print(find(name)?.text)?,
        None => output::print(&tables::cases(cases::all()))?,
    }
    Ok(Exit::Done)
}

/// The case of this name, or an error that lists the names.
pub fn find(name: &str) -> Result<&'static cases::Case, Failure> {
    cases::get(name).ok_or_else(|| {
        let names: Vec<_> = cases::all().iter().map(|case| case.name).collect();
        Failure::bad_input(miette!(
            help = format!("the cases are: {}", names.join(", ")),
            "there is no case named `{name}`"
        ))
    })
}
