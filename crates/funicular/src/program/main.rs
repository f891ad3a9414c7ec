//! `funicular`: where does a chain of rigid bars come to rest, and how sure can we be?
//!
//! The program is thin: it reads, asks the solvers, has `validate` judge, and prints. Results go to
//! standard output, everything meant for people's patience (progress, errors) to standard error.

mod args;
mod basins;
mod case_name;
mod cases;
mod census;
mod convert;
mod cost;
mod derivatives;
mod diagnostics;
mod exit;
mod foreign_input;
mod guide;
mod help;
mod in_order;
mod input;
mod interrupt;
mod judge;
mod man;
mod memory;
mod merge;
mod modes;
mod new;
mod output;
mod page;
mod printed;
mod progress;
mod reproduce;
mod serve;
mod simulate;
mod solve;
mod study;
mod sweep;
mod threads;
mod trace;
mod varied;

use clap::CommandFactory;
use funicular::text::markdown::page;
use funicular::text::{printable, tables};
use model::budget::limit_work;
use model::system_file::limit_memory;

use crate::args::{Cli, Command};
use crate::exit::Exit;

fn main() -> std::process::ExitCode {
    let cli = match help::parse() {
        Ok(cli) => cli,
        Err(exit) => return exit.into(),
    };
    cli.max_memory.into_iter().for_each(limit_memory);
    cli.max_work.into_iter().for_each(limit_work);
    let exit = match cli.command {
        Command::Reproduce(arguments) => reproduce::run(&arguments),
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Census(arguments) => census::run(&arguments),
        Command::Judge(arguments) => judge::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Derivatives(arguments) => derivatives::run(&arguments),
        Command::Trace(arguments) => trace::run(&arguments),
        Command::Page(arguments) => page::run(&arguments),
        Command::Serve(arguments) => {
            serve::run(&arguments, [cli.max_work.is_some(), cli.max_memory.is_some()])
        }
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Basins(arguments) => basins::run(&arguments),
        Command::Modes(arguments) => modes::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::New(arguments) => new::run(&arguments),
        Command::Format => output::print(&page(model::system_file::FORMAT)).map(|()| Exit::Done),
        Command::Guide(arguments) => guide::run(&arguments),
        Command::Cases(arguments) => cases::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "funicular", &mut script);
            output::print(&String::from_utf8_lossy(&script)).map(|()| Exit::Done)
        }
    };
    match exit {
        Ok(exit) => exit.into(),
        Err(failure) => failure.report().into(),
    }
}
