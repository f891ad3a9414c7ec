//! Sweeps in folders, whole or in shards.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use funicular::prelude::Sweep;
use funicular::text;
use pyo3::prelude::*;
use serde_json::json;
use sweep::{Manifest, RunSettings, Shard, StoreSummary};

use crate::problem::Problem;
use crate::{words, work};

/// The same keys as those of a sweep in memory, and what the folder knows.
fn told(manifest: &Manifest, summary: &StoreSummary) -> String {
    let object = json!({
        "seeds": summary.outcomes.seeds(),
        "equilibria": summary.equilibria(manifest).collect::<Vec<_>>(),
        "complete": manifest.equilibria_complete,
        "listed_below_j": summary.listed_below_j(),
        "outcomes": text::sweep::object(manifest, &summary.outcomes),
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
        .format(words::format(file_format)?);
    let of = Arc::clone(&problem.of);
    work::answer(py, threads, progress, move |watch| {
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
        Ok(run.summary.map(|summary| told(prepared.manifest(), &summary)))
    })
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
    work::answer(py, threads, progress, move |watch| {
        let done = |_| {};
        let threads = rayon::current_num_threads();
        let merged = sweep::merge(&folders, &out, threads, watch.stop(), &done)?;
        let Some(summary) = merged else { return Ok(None) };
        Ok(Some(told(&Manifest::read(&out)?, &summary)))
    })
}
