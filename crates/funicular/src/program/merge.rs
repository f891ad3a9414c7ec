//! `funicular merge`: the shards of a sweep joined.

use std::path::PathBuf;

use ::sweep::Shard;
use clap::Args;
use funicular::Error;

use crate::diagnostics::tell;
use crate::exit::{Exit, Result};
use crate::interrupt::on_interrupt;
use crate::output;
use crate::sweep::{json_object, seeds_bar, verdict, written};
use crate::threads::Threads;

/// How it ends, for its help.
const EXIT_CODES: &str = "\
Exit codes:
  0    done: nothing is missing, nothing double, every digest as recorded
  1    a check failed in the sweep: see `funicular sweep --help`
  2    bad input or usage; a shard that is missing, damaged or of another sweep
  3    not finished: the disk is full or fails, or another process is writing the folder;
       it may pass, and the same command goes on
  130  interrupted (Ctrl-C or SIGTERM): the same command goes on";

/// `funicular merge`.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Merge {
    /// The folders of all shards, in any order
    #[arg(value_name = "DIR", required = true)]
    pub folders: Vec<PathBuf>,
    /// Join to the K-th of N shards instead of to the whole: for some of the folders on each of
    /// many machines, and then for what these made
    #[arg(long, value_name = "K/N", default_value_t = Shard::WHOLE)]
    pub shard: Shard,
    #[command(flatten)]
    pub threads: Threads,
    /// Print one JSON object (schema_version 2) instead of tables
    #[arg(long)]
    pub json: bool,
    /// The folder to write: new or empty, or what the same merge left when it was interrupted
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Run the command.
pub fn run(arguments: &Merge) -> Result<Exit> {
    let stop = on_interrupt()?.keep_what_is_done();
    let seeds = arguments.folders.first().and_then(|folder| ::sweep::Manifest::read(folder).ok());
    let bar = seeds_bar(seeds.map_or(0, |manifest| manifest.seeds));
    let done = |seeds| bar.inc(seeds);
    let threads = arguments.threads.resolve()?;
    let (folders, out) = (&arguments.folders, &arguments.out);
    let merged = ::sweep::merge_shard(folders, out, arguments.shard, threads, stop, &done);
    bar.finish_and_clear();
    let Some(summary) = merged.map_err(Error::from)? else {
        tell("Stopped. The same command goes on.");
        return Ok(Exit::Interrupted);
    };
    let manifest = ::sweep::Manifest::read(&arguments.out).map_err(Error::from)?;
    if arguments.json {
        output::print_json(&json_object(&manifest, &summary, &arguments.out))?;
    } else {
        let proof = format!(
            "{} part{} of {} shards: nothing is missing, nothing double, every digest as recorded.\n",
            summary.parts.len(),
            if summary.parts.len() == 1 { "" } else { "s" },
            arguments.folders.len()
        );
        let tables = funicular::text::sweep::summary(&manifest, &summary);
        output::print(&(tables + &proof + &written(&arguments.out)))?;
    }
    Ok(verdict(&manifest, &summary))
}
