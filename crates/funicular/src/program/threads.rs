//! How many threads the program works on.

use clap::Args;
use funicular::MOST_THREADS;

use crate::exit::{Failure, Result};

/// The option of commands that say the same whatever it is.
#[derive(Debug, Clone, Copy, Args)]
pub struct Threads {
    /// How many threads; 0 means one per processor. The result does not depend on it
    #[arg(long, value_name = "T", default_value_t = 0, value_parser = parse, allow_negative_numbers = true)]
    threads: usize,
}

impl Threads {
    /// Start the threads of the program.
    pub fn install(self) -> Result<()> {
        install(self.threads)
    }

    /// Their number, never 0.
    pub fn resolve(self) -> Result<usize> {
        resolve(self.threads)
    }
}

/// What `--threads` takes: 0 for one per processor.
pub fn parse(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads) if threads <= MOST_THREADS => Ok(threads),
        _ => Err(format!("a whole number up to {MOST_THREADS} is required")),
    }
}

/// Start the threads of the program: as many as were asked for; for 0 as many as RAYON_NUM_THREADS
/// says, and one per processor if it says nothing.
pub fn install(threads: usize) -> Result<()> {
    let threads = resolve(threads)?;
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|error| Failure::bad_input(format!("no {threads} threads: {error}")))
}

/// The number of threads for what was asked, never 0.
pub fn resolve(threads: usize) -> Result<usize> {
    if threads > 0 {
        return Ok(threads);
    }
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    match std::env::var("RAYON_NUM_THREADS") {
        Err(_) => Ok(processors.min(MOST_THREADS)),
        Ok(text) => match parse(text.trim()) {
            Ok(0) => Ok(processors.min(MOST_THREADS)),
            Ok(threads) => Ok(threads),
            Err(wanted) => Err(Failure::bad_input(format!(
                "the variable RAYON_NUM_THREADS is `{text}`: {wanted}"
            ))),
        },
    }
}
