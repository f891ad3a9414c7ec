//! A sweep on disk whose list of equilibria grows.
//!
//! Every part numbers what it reaches in the order of coming, into files of its own: rows, and the
//! list that they are numbered by. When all are there, their lists are joined in the order of the
//! parts, and the rows get their last numbers. So what the folder holds in the end depends on no
//! thread and no interruption, and no part waits for another.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use crate::reached::{Discovered, Reached};
use crate::store::compute::Compute;
use crate::store::description::{SCHEMA_VERSION, SUMMARY, read_json, write_json};
use crate::store::digests::Digests;
use crate::store::error::{Result, StoreError, regular};
use crate::store::finished::StoreSummary;
use crate::store::manifest::Manifest;
use crate::store::part::{self, Watch};
use crate::store::run::{Run, RunSettings, Whole, for_each_part};

/// What the names of the files of such parts begin with, until the sweep is finished.
pub(crate) const BEFORE: &str = "reached-";

/// The files of a part: its rows, and the list that they are numbered by.
pub(crate) fn files_of(manifest: &Manifest, part: u64) -> [String; 2] {
    [manifest.format.as_str(), "json"].map(|form| format!("{BEFORE}{part:06}.{form}"))
}

#[derive(Serialize, Deserialize)]
struct PartList {
    schema_version: u32,
    /// How many numbers were given.
    given: usize,
    /// Those of the entries that are left.
    numbers: Vec<usize>,
    discovered: Discovered,
}

impl PartList {
    fn of(mut reached: Reached) -> Self {
        let (discovered, _) = reached.finish();
        let (given, numbers) = (reached.given(), reached.numbers().to_vec());
        Self { schema_version: SCHEMA_VERSION, given, numbers, discovered }
    }
}

/// Run such a sweep, or go on with it. The folder is locked.
pub(crate) fn run(
    folder: &Path,
    manifest: &Manifest,
    compute: &impl Compute,
    settings: &RunSettings<'_>,
    digests: &Digests,
    nothing: &Reached,
) -> Result<Run> {
    let before: Option<StoreSummary> = match folder.join(SUMMARY) {
        path if path.exists() => Some(read_json(&path)?),
        _ => None,
    };
    let finished = before.and_then(|summary| summary.discovered);
    let finished = finished.filter(|list| list.fits(nothing.bars()));
    let parts = Parts { folder, manifest, digests, nothing, finished };
    let whole = parts.compute(compute, settings)?;
    let all = manifest.shard.parts(manifest.parts());
    let mut run = Run::of(manifest, whole.iter().map(|(part, whole)| (*part, whole)));
    if whole.len() as u64 == all.end - all.start {
        run.summary = parts.finish(&whole, settings)?;
    }
    Ok(run)
}

struct Parts<'a> {
    folder: &'a Path,
    manifest: &'a Manifest,
    digests: &'a Digests,
    nothing: &'a Reached,
    /// The list of the whole, where the sweep was finished before.
    finished: Option<Discovered>,
}

impl Parts<'_> {
    /// Compute what is not there.
    fn compute(
        &self,
        compute: &impl Compute,
        settings: &RunSettings<'_>,
    ) -> Result<BTreeMap<u64, Whole>> {
        let Self { folder, manifest, digests, .. } = *self;
        // For those who watch; the list that counts is joined in the order of the parts.
        let so_far = Mutex::new(self.nothing.nothing());
        let tell = |add: &dyn Fn(&mut Reached)| {
            if let Ok(mut so_far) = so_far.lock() {
                add(&mut so_far);
                (settings.found)(so_far.len());
            }
        };
        let grown = |reached: &Reached, before: usize| {
            tell(&|so_far| {
                for member in reached.since(before) {
                    so_far.join_one(member);
                }
            });
        };
        let watch = Watch { stop: settings.stop, done: settings.done, grown: &grown };
        let parts = manifest.shard.parts(manifest.parts());
        for_each_part(parts, settings.threads, settings.stop, &|part| {
            let seeds = manifest.seeds_of(part);
            let count = seeds.end - seeds.start;
            let [rows, list] = files_of(manifest, part);
            let file = manifest.file_of(part);
            let mut damage = vec![];
            let mut holds = |file: &str| {
                Ok::<_, StoreError>(match digests.holds(folder, file)? {
                    None => false,
                    Some(Ok(())) => true,
                    Some(Err(error)) => {
                        damage.push((file.to_owned(), error.to_string()));
                        false
                    }
                })
            };
            let last = holds(&file)?;
            let listed = self.finished.is_some() || holds(&list)?;
            let there = listed && (last || (self.finished.is_none() && holds(&rows)?));
            if there {
                if self.finished.is_none() {
                    let list = self.list_of(part)?;
                    tell(&|so_far| {
                        so_far.join(&list.discovered);
                    });
                }
                (settings.done)(count);
            } else {
                let mut reached = self.nothing.nothing();
                let path = folder.join(&rows);
                let written =
                    part::write(&path, manifest, part, compute, Some(&mut reached), &watch)?;
                if written.is_none() {
                    return Ok(None);
                }
                write_json(&folder.join(&list), &PartList::of(reached))?;
                for file in [rows, list] {
                    let path = folder.join(&file);
                    digests.add(&part::record(&path, file, seeds.clone())?)?;
                }
            }
            Ok(Some(Whole { before: there, last: there && last, damage }))
        })
    }

    /// Join the lists, and give all rows their last numbers.
    fn finish(
        &self,
        whole: &BTreeMap<u64, Whole>,
        settings: &RunSettings<'_>,
    ) -> Result<Option<StoreSummary>> {
        let Self { folder, manifest, digests, .. } = *self;
        let mut all = self.nothing.nothing();
        if let Some(finished) = &self.finished {
            all.join(finished);
        } else {
            for part in whole.keys() {
                all.join(&self.list_of(*part)?.discovered);
            }
        }
        let (discovered, _) = all.finish();
        let parts = manifest.shard.parts(manifest.parts());
        let count = parts.end - parts.start;
        let results = for_each_part(parts.clone(), settings.threads, settings.stop, &|part| {
            let is_last = whole.get(&part).is_some_and(|whole| whole.last);
            if !is_last {
                let list = self.list_of(part)?;
                let entries = list.numbers.iter().copied().zip(&list.discovered.equilibria);
                let renumbering = all.renumbering(list.given, entries);
                let [rows, _] = files_of(manifest, part);
                let to = folder.join(manifest.file_of(part));
                regular(&to)?;
                part::renumber(&folder.join(&rows), &to, manifest, &renumbering)?;
            }
            let result = part::read(folder, manifest, &discovered.equilibria, part)?;
            if !is_last {
                digests.add(&result.0)?;
                let [rows, _] = files_of(manifest, part);
                // Best effort: it goes with the lists in the end.
                let _ = fs::remove_file(folder.join(rows));
            }
            Ok(Some(result))
        })?;
        if results.len() as u64 != count {
            return Ok(None);
        }
        let summary = StoreSummary::of(manifest, Some(discovered), results.into_values());
        write_json(&folder.join(SUMMARY), &summary)?;
        Digests::close(folder);
        let left: BTreeSet<String> = parts.flat_map(|part| files_of(manifest, part)).collect();
        for file in left {
            // Best effort: with a summary nobody reads them.
            let _ = fs::remove_file(folder.join(file));
        }
        Ok(Some(summary))
    }

    fn list_of(&self, part: u64) -> Result<PartList> {
        let [_, file] = files_of(self.manifest, part);
        let path = self.folder.join(file);
        let list: PartList = read_json(&path)?;
        if list.discovered.fits(self.nothing.bars())
            && list.numbers.len() == list.discovered.equilibria.len()
        {
            Ok(list)
        } else {
            let reason = "it is not a list of this chain".to_owned();
            Err(StoreError::Description { path, reason })
        }
    }
}
