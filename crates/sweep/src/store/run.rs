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
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::store::compute::Compute;
use crate::store::description::{SUMMARY, write_json};
use crate::store::digests::Digests;
use crate::store::error::{Result, StoreError, regular};
use crate::store::finished::StoreSummary;
use crate::store::lock::Lock;
use crate::store::manifest::Manifest;
use crate::store::open;
use crate::store::part::{self, Watch};
use crate::store::shard::MOST_PARTS;

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
) -> Result<Run> {
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
    let found = for_each_part(parts.clone(), settings.threads, settings.stop, &|part| {
        let (file, seeds) = (manifest.file_of(part), manifest.seeds_of(part));
        let path = folder.join(&file);
        regular(&path)?;
        let mut damage = vec![];
        if path.exists() {
            let read = part::read(folder, manifest, &[], part);
            match read.and_then(|read| digests.check(folder, &read.0).map(|()| read)) {
                Ok(read) => {
                    (settings.done)(seeds.end - seeds.start);
                    return Ok(Some((Whole { before: true, last: true, damage }, read)));
                }
                Err(error) => damage.push((file.clone(), error.to_string())),
            }
        }
        let watch = Watch { stop: settings.stop, done: settings.done, grown: &|_, _| () };
        let written = part::write(&path, manifest, part, compute, None, &watch)?;
        let Some(summary) = written else { return Ok(None) };
        let record = part::record(&path, file, seeds)?;
        digests.add(&record)?;
        Ok(Some((Whole { before: false, last: true, damage }, (record, summary))))
    })?;
    let mut run = Run::of(manifest, found.iter().map(|(part, (whole, _))| (*part, whole)));
    if found.len() as u64 == parts.end - parts.start {
        let results = found.into_values().map(|(_, result)| result);
        let summary = StoreSummary::of(manifest, None, results);
        write_json(&folder.join(SUMMARY), &summary)?;
        Digests::close(folder);
        run.summary = Some(summary);
    }
    Ok(run)
}

/// A part that is there.
pub(crate) struct Whole {
    /// Whether it was there before.
    pub before: bool,
    /// Whether its rows have their last numbers.
    pub last: bool,
    /// Files of it that could not be trusted, and why.
    pub damage: Vec<(String, String)>,
}

impl Run {
    /// Of parts by their numbers.
    pub(crate) fn of<'a>(
        manifest: &Manifest,
        parts: impl Iterator<Item = (u64, &'a Whole)>,
    ) -> Self {
        let mut run = Self { summary: None, seeds: 0, seeds_before: 0, repaired: vec![] };
        for (part, whole) in parts {
            let seeds = manifest.seeds_of(part);
            run.seeds += seeds.end - seeds.start;
            if whole.before {
                run.seeds_before += seeds.end - seeds.start;
            } else {
                run.repaired.extend_from_slice(&whole.damage);
            }
        }
        run.repaired.sort();
        run
    }
}

/// What comes of every part, by its number; the next free thread takes the next part, the first error
/// ends it.
pub(crate) fn for_each_part<T: Send>(
    parts: Range<u64>,
    threads: usize,
    stop: &AtomicBool,
    work: &(dyn Fn(u64) -> Result<Option<T>> + Sync),
) -> Result<BTreeMap<u64, T>> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| StoreError::Threads { reason: error.to_string() })?;
    let next = AtomicU64::new(parts.start);
    let failed = AtomicBool::new(false);
    let results = pool.broadcast(|_| {
        let mut results = vec![];
        while !stop.load(Ordering::Relaxed) && !failed.load(Ordering::Relaxed) {
            let part = next.fetch_add(1, Ordering::Relaxed);
            if part >= parts.end {
                break;
            }
            match work(part) {
                Ok(result) => results.extend(result.map(|result| (part, result))),
                Err(error) => {
                    failed.store(true, Ordering::Relaxed);
                    return Err(error);
                }
            }
        }
        Ok(results)
    });
    let results = results.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(results.into_iter().flatten().collect())
}
