//! A sweep on disk: computed part after part, in bounded memory, whole at every moment.
//!
//! What a folder holds stands in the documentation of the crate.
//!
//! A part appears under its name when it is complete and not before, so a process may be killed at
//! any time: a second run computes what is missing. Until the summary is there, the digest of every
//! whole part stands in `.digests`; a part that does not have the digest that was written down, or
//! none, is computed again. Nothing in the folder depends on the number of threads, on the time, on
//! the shard that computed it, or on how often it was interrupted: the final bytes are the same.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::store::compute::Compute;
use crate::store::description::{SUMMARY, write_json};
use crate::store::digests::Digests;
use crate::store::error::{StoreError, regular};
use crate::store::finished::{PartRecord, StoreSummary};
use crate::store::lock::Lock;
use crate::store::manifest::Manifest;
use crate::store::open;
use crate::store::part::{self, Watch};
use crate::store::shard::MOST_PARTS;
use crate::summary::Summary;

/// How a sweep is run; nothing of it changes the result.
#[derive(Clone, Copy)]
pub struct RunSettings<'a> {
    /// Threads; 0 means one per processor.
    pub threads: usize,
    /// Go on with what is in the folder, if there is something.
    pub resume: bool,
    /// Set to stop soon; the parts under way are dropped, at most one per thread.
    pub stop: &'a AtomicBool,
    /// Told of every few thousand seeds that are done.
    pub done: &'a (dyn Fn(u64) + Sync),
    /// Told how many equilibria have been discovered by then, where the list is not complete.
    pub found: &'a (dyn Fn(usize) + Sync),
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The summary; `None` if it was stopped.
    pub summary: Option<StoreSummary>,
    /// Seeds that are in whole parts now.
    pub seeds: u64,
    /// Seeds of them that were there before.
    pub seeds_before: u64,
    /// Parts that were there, could not be trusted, and were computed again: file and reason.
    pub repaired: Vec<(String, String)>,
}

/// Run a sweep, or go on with it.
///
/// # Errors
///
/// [`StoreError`]; the folder is left as it was if it holds something else.
pub fn run(
    folder: &Path,
    manifest: &Manifest,
    compute: &impl Compute,
    settings: &RunSettings<'_>,
) -> Result<Run, StoreError> {
    if manifest.seeds == 0 {
        return Err(StoreError::NoSeeds);
    }
    if manifest.parts() > MOST_PARTS {
        let (seeds, parts) = (manifest.seeds, manifest.parts());
        return Err(StoreError::TooManySeeds { seeds, parts });
    }
    let _lock = Lock::take(folder, manifest, settings.resume)?;
    let digests = Digests::open(folder, manifest)?;
    if let Some(nothing) = manifest.nothing_reached()? {
        return open::run(folder, manifest, compute, settings, &digests, &nothing);
    }
    let parts = manifest.shard.parts(manifest.parts());
    let found = Mutex::new(Found::default());
    for_each_part(parts.clone(), settings.threads, settings.stop, &|part| {
        let path = folder.join(manifest.file_of(part));
        let seeds = manifest.seeds_of(part);
        let mut damage = None;
        let mut result = None;
        regular(&path)?;
        if path.exists() {
            let read = part::read(folder, manifest, &[], part);
            let read = read.and_then(|read| digests.check(folder, &read.0).map(|()| read));
            match read {
                Ok(read) => {
                    result = Some(read);
                    (settings.done)(seeds.end - seeds.start);
                }
                Err(error) => damage = Some(error.to_string()),
            }
        }
        let before = result.is_some();
        if !before {
            let watch = Watch { stop: settings.stop, done: settings.done, grown: &|_, _| () };
            if let Some(summary) = part::write(&path, manifest, part, compute, None, &watch)? {
                let record = part::record(&path, manifest.file_of(part), seeds.clone())?;
                digests.add(&record)?;
                result = Some((record, summary));
            }
        }
        if let Ok(mut found) = found.lock() {
            if let Some(damage) = damage {
                found.repaired.push((manifest.file_of(part), damage));
            }
            if let Some(result) = result {
                found.seeds_before += if before { seeds.end - seeds.start } else { 0 };
                found.parts.insert(part, result);
            }
        }
        Ok(())
    })?;
    let found = found.into_inner().unwrap_or_default();
    let complete = found.parts.len() as u64 == parts.end - parts.start;
    let mut run = Run {
        summary: None,
        seeds: found.parts.values().map(|(_, summary)| summary.seeds()).sum(),
        seeds_before: found.seeds_before,
        repaired: found.repaired,
    };
    if complete {
        let summary = StoreSummary::of(manifest, None, found.parts.into_values());
        write_json(&folder.join(SUMMARY), &summary)?;
        Digests::close(folder);
        run.summary = Some(summary);
    }
    run.repaired.sort();
    Ok(run)
}

#[derive(Default)]
struct Found {
    parts: BTreeMap<u64, (PartRecord, Summary)>,
    seeds_before: u64,
    repaired: Vec<(String, String)>,
}

/// Do something for every part, the next free thread taking the next part; the first error ends it.
pub(crate) fn for_each_part(
    parts: Range<u64>,
    threads: usize,
    stop: &AtomicBool,
    work: &(dyn Fn(u64) -> Result<(), StoreError> + Sync),
) -> Result<(), StoreError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| StoreError::Threads { reason: error.to_string() })?;
    let next = AtomicU64::new(parts.start);
    let failed = AtomicBool::new(false);
    let results = pool.broadcast(|_| {
        while !stop.load(Ordering::Relaxed) && !failed.load(Ordering::Relaxed) {
            let part = next.fetch_add(1, Ordering::Relaxed);
            if part >= parts.end {
                break;
            }
            if let Err(error) = work(part) {
                failed.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
        Ok(())
    });
    results.into_iter().collect()
}
