//! The command line of `funicular sweep`.

use std::path::PathBuf;

use ::sweep::{MOST_SEEDS, Shard};
use clap::Args;
use funicular::{Format, Spread};
use validate::Solvers;

use crate::exit::Result;
use crate::input::Source;
use crate::interrupt::{Interrupt, on_interrupt};
use crate::threads;

/// How `sweep` ends, for its help.
const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a check failed: a seed converged to what the complete list of equilibria does not have, or the
       solvers contradict each other (the seeds are listed)
  2    bad input or usage; a folder that holds something else
  3    not finished: the disk is full or fails, or another process is writing the folder;
       it may pass: what is done stays, --resume goes on
  130  interrupted (Ctrl-C or SIGTERM): what is done stays, --resume goes on";

const EXAMPLES: &str = "\
Examples:
  funicular sweep --case three-equal-bars --seeds 1e6 --out paper   the chain of the paper, a million starts
  funicular sweep chain.toml --seeds 1e8 --resume --out big   start it, or go on after an interruption
  funicular sweep chain.toml --seeds 1e8 --shard 2/7 --out s2 the second of seven parts, on this machine
  funicular merge s1 s2 s3 s4 s5 s6 s7 --out big              all of them, proved complete

The folder holds manifest.json, part-000000.parquet and so on, and at the end summary.json. It is the same to
the last byte for any number of threads and shards, interrupted or not.

Where no census proves that there are no other equilibria: of a row of rigid bars the list grows with the seeds, and those that
are reached stand under `discovered` of summary.json, by energy, the lowest 1000 if there are more; of any other system the
list, in manifest.json, is what 256 other starts reach.

Columns: seed; theta_1_rad, ... (with --angles); and of each solver outcome (a number in `equilibria` of the
manifest and, behind these, of `discovered`, or -1 iteration limit, -2 stalled, -3 a number overflowed, -4 in no
list), iterations, residual and energy_j, as in lagrange_outcome. Parquet holds unit and description of each. The table of all files and columns is
the documentation of the crate sweep: crates/sweep/src/lib.rs, or `cargo doc --open -p sweep`.";

/// `funicular sweep`.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES, after_long_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
pub struct Sweep {
    #[command(flatten)]
    pub input: Source,
    /// How many starts: 1000000, 1_000_000 or 1e6
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub seeds: u64,
    /// How the starts are spread: over the angles of a chain's bars; of any other system its joints start
    /// at random in space (uniform)
    #[arg(long, alias = "source", value_enum, default_value_t)]
    pub spread: Spread,
    /// Which solver
    #[arg(long, value_enum, default_value_t)]
    pub solver: Solvers,
    #[command(flatten)]
    pub rows: Rows,
    /// Write the angles of the starts, too
    #[arg(long)]
    pub angles: bool,
    /// The folder to write: new or empty, or with --resume one that holds this sweep
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// What a command asks for that writes a folder of rows.
#[derive(Debug, Args)]
pub struct Rows {
    /// The number that all starts come from; another one gives others
    #[arg(long, value_name = "S", default_value_t = 1, requires = "seeds")]
    pub seed: u64,
    /// How many threads; 0 means one per processor. The result does not depend on it
    #[arg(long, value_name = "T", default_value_t = 0, value_parser = threads::parse,
          allow_negative_numbers = true, requires = "seeds")]
    pub threads: usize,
    /// Only the K-th of N parts, to be joined by `funicular merge`
    #[arg(long, value_name = "K/N", default_value_t = Shard::WHOLE, requires = "seeds")]
    pub shard: Shard,
    /// Go on with what is in the folder, if there is something
    #[arg(long, requires = "seeds")]
    pub resume: bool,
    /// The form of the rows
    #[arg(long, value_enum, default_value_t, requires = "seeds")]
    pub format: Format,
    /// Print one JSON object (schema_version 2) instead of tables
    #[arg(long, requires = "seeds")]
    pub json: bool,
}

impl Rows {
    /// Start the threads, of which this is the number, and watch for Ctrl-C.
    pub(crate) fn begin(&self) -> Result<(usize, Interrupt)> {
        let threads = threads::resolve(self.threads)?;
        threads::install(threads)?;
        Ok((threads, on_interrupt()?))
    }
}

/// A count as people write it: digits, with underscores between them, or with a power of ten.
pub(crate) fn count(text: &str) -> Result<u64, String> {
    let wanted = || format!("a whole number from 1 to {MOST_SEEDS} is required, as 1000000 or 1e6");
    let digits = |text: &str| {
        let plain = text.starts_with(|c: char| c.is_ascii_digit())
            && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
        text.replace('_', "").parse::<u64>().ok().filter(|_| plain)
    };
    let count = match text.split_once(['e', 'E']) {
        None => digits(text),
        Some((number, power)) => digits(number).and_then(|number| {
            let power = u32::try_from(digits(power)?).ok()?;
            number.checked_mul(10_u64.checked_pow(power)?)
        }),
    };
    count.filter(|count| (1..=MOST_SEEDS).contains(count)).ok_or_else(wanted)
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn counts_are_read_as_people_write_them() {
        for (text, wanted) in [
            ("1", 1),
            ("1_000", 1000),
            ("1e6", 1_000_000),
            ("25E1", 250),
            ("1e12", 1_000_000_000_000),
        ] {
            assert_eq!(count(text), Ok(wanted));
        }
        for text in ["", "0", "-1", "+1", "1.5", "1e", "e6", "_1", "3e12", "1e99", "2e19", "ten"] {
            assert!(count(text).is_err(), "{text}");
        }
    }
}
