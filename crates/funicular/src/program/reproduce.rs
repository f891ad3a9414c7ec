//! `funicular reproduce`: the paper, judged.

use std::path::PathBuf;

use clap::Args;
use validate::table::csv;

use crate::exit::{Exit, Failure, Result};
use crate::interrupt::end_on_interrupt;
use crate::output;
use crate::progress::Progress;
use crate::threads;

const FILES: [&str; 4] = ["report.html", "report.md", "results.json", "comparison.csv"];

/// `funicular reproduce`.
#[derive(Debug, Args)]
pub struct Reproduce {
    /// Write report.html, report.md, results.json and comparison.csv into this folder (made if it
    /// is not there)
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print the results as one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}

/// Run the command.
pub fn run(arguments: &Reproduce) -> Result<Exit> {
    end_on_interrupt()?;
    threads::install(0)?;
    if let Some(folder) = &arguments.out {
        // Before the work, not after it.
        output::make_folder(folder)?;
        let files = FILES.map(|name| folder.join(name));
        output::check(&files, &[])?;
    }
    let progress = Progress::start();
    let report = funicular::Reproduce::new().run_watched(|what| progress.say(what))?;
    drop(progress);
    let reproduction = report.reproduction();
    let json = || report.json().map_err(Failure::undecided);
    if let Some(folder) = &arguments.out {
        let texts = [report.html(), report.markdown(), json()?, csv(&reproduction.cases)];
        for (name, text) in FILES.into_iter().zip(&texts) {
            output::write_whole(&folder.join(name), text)?;
        }
    }
    if arguments.json {
        output::print(&json()?)?;
    } else {
        output::print(&report.to_string())?;
        if let Some(folder) = &arguments.out {
            output::print(&format!("Written to {}: {}\n", folder.display(), FILES.join(", ")))?;
        }
    }
    Ok(if reproduction.all_as_expected { Exit::Done } else { Exit::CheckFailed })
}
