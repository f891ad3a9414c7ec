//! Sweeps in folders, whole or in shards.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use funicular::prelude::Sweep;
use funicular::{Error, Format};
use pyo3::prelude::*;
use serde_json::json;
use sweep::{Manifest, RunSettings, Shard, StoreSummary};

use crate::outcomes::outcomes;
use crate::problem::Problem;
use crate::raise::{bad_word, raise};
use crate::{words, work};

fn format(word: &str) -> PyResult<Format> {
    match word {
        "parquet" => Ok(Format::Parquet),
        "csv" => Ok(Format::Csv),
        _ => Err(bad_word("format", word, &["parquet", "csv"])),
    }
}

/// The same keys as those of a sweep in memory, and what the folder knows.
fn told(manifest: &Manifest, summary: &StoreSummary) -> String {
    let object = json!({
        "seeds": summary.outcomes.seeds(),
        "equilibria": summary.equilibria(manifest).collect::<Vec<_>>(),
        "complete": manifest.equilibria_complete,
        "listed_below_j": summary.listed_below_j(),
        "outcomes": outcomes(&summary.outcomes),
        "parts": summary.parts,
        "check_failed": summary.check_failed(manifest),
    });
    object.to_string()
}

/// Write the rows of a shard of a sweep into a folder, or go on with one. `None` if it was stopped.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one for each setting")]
pub fn sweep_write<'py>(
    py: Python<'py>,
    problem: &Problem,
    seeds: u64,
    number: u64,
    spread: &str,
    solver: &str,
    shard: (u64, u64),
    angles: bool,
    file_format: &str,
    folder: PathBuf,
    resume: bool,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Option<String>> {
    let sweep = Sweep::new(seeds)
        .number(number)
        .spread(words::spread(spread)?)
        .solvers(words::solvers(solver)?)
        .shard(Shard { number: shard.0, of: shard.1 })
        .angles(angles)
        .format(format(file_format)?);
    let of = Arc::clone(&problem.of);
    let found = work::run(py, threads, progress.as_ref(), move |watch| {
        let prepared = sweep.prepare(&of)?;
        let range = prepared.range();
        let so_far = AtomicU64::new(0);
        let done = |seeds: u64| {
            let now = so_far.fetch_add(seeds, Ordering::Relaxed) + seeds;
            // What is cancelled stops by itself between two parts: nothing is left half written.
            if !watch.stop().load(Ordering::Relaxed) {
                watch.tell("starts", now, range.end - range.start);
            }
        };
        let threads = rayon::current_num_threads();
        let stop = watch.stop();
        let settings = RunSettings { threads, resume, stop, done: &done, found: &|_| () };
        let run = prepared.write(&folder, &settings)?;
        Ok::<_, Error>(run.summary.map(|summary| told(prepared.manifest(), &summary)))
    })?;
    found.map_err(|error| raise(&error))
}

/// Join the folders of all shards. `None` if it was stopped.
#[pyfunction]
pub fn sweep_merge<'py>(
    py: Python<'py>,
    folders: Vec<PathBuf>,
    out: PathBuf,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Option<String>> {
    let found = work::run(py, threads, progress.as_ref(), move |watch| {
        let done = |_| {};
        let threads = rayon::current_num_threads();
        let merged = sweep::merge(&folders, &out, threads, watch.stop(), &done)?;
        let Some(summary) = merged else { return Ok(None) };
        Ok::<_, Error>(Some(told(&Manifest::read(&out)?, &summary)))
    })?;
    found.map_err(|error| raise(&error))
}
