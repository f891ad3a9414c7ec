//! Shards joined, with the proof that nothing is missing and nothing double.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use crate::identify::Member;
use crate::reached::{Discovered, Renumbering};
use crate::store::description::{SUMMARY, read_json, write_json};
use crate::store::digests::Digests;
use crate::store::error::{NAMED, Result, StoreError, regular};
use crate::store::finished::{PartRecord, StoreSummary};
use crate::store::lock::Lock;
use crate::store::manifest::Manifest;
use crate::store::part;
use crate::store::run::for_each_part;
use crate::store::shard::Shard;
use crate::summary::Summary;

/// A folder to be joined.
struct Input {
    folder: PathBuf,
    manifest: Manifest,
    summary: StoreSummary,
}

/// Join the shards of one sweep into a folder that is, byte for byte, the one that a single run
/// would have written.
///
/// Proved before any part is copied: the manifests differ in nothing but the shard; every shard is
/// there once, and has the seeds that it should have; the digest of every part is the one that its
/// shard's summary says; every part, decoded, holds its seeds each once and in order, and the
/// outcomes that the summary counts. All parts are therefore read twice. An interrupted merge is
/// completed by the same merge again.
///
/// # Errors
///
/// [`StoreError`] with the folder or file that is not as it should be.
pub fn merge(
    folders: &[PathBuf],
    out: &Path,
    threads: usize,
    stop: &AtomicBool,
    done: &(dyn Fn(u64) + Sync),
) -> Result<Option<StoreSummary>> {
    merge_shard(folders, out, Shard::WHOLE, threads, stop, done)
}

/// The same for neighbouring shards, which become one shard of fewer: shards 4, 5 and 6 of 12 are
/// shard 2 of 4. So each of many machines joins some, and the last joins what they made.
///
/// # Errors
///
/// As [`merge`], and [`StoreError::Uneven`] where the number of shards is no multiple.
pub fn merge_shard(
    folders: &[PathBuf],
    out: &Path,
    shard: Shard,
    threads: usize,
    stop: &AtomicBool,
    done: &(dyn Fn(u64) + Sync),
) -> Result<Option<StoreSummary>> {
    let inputs = complete(folders.iter().map(|folder| Input::read(folder)), shard)?;
    let Some(first) = inputs.values().next() else { return Err(StoreError::Nothing) };
    let whole = first.manifest.clone().with_shard(shard);
    let parts = shard.parts(whole.parts());
    let count = parts.end - parts.start;
    for input in inputs.values() {
        if is_same(&input.folder, out) {
            return Err(StoreError::SameFolder { path: out.to_owned() });
        }
    }
    let _lock = Lock::take(out, &whole, true)?;
    let each = |work: &(dyn Fn(u64, &Input) -> Proved + Sync)| {
        for_each_part(parts.clone(), threads, stop, &|part| {
            // Every part is in a shard, and every shard is there.
            let input = inputs.values().find(|input| input.parts().contains(&part));
            input.map(|input| work(part, input)).transpose()
        })
    };
    let proved = each(&|part, input| {
        let result = input.prove(part)?;
        let seeds = whole.seeds_of(part);
        done(seeds.end - seeds.start);
        Ok(result)
    })?;
    if proved.len() as u64 != count {
        return Ok(None);
    }
    for input in inputs.values() {
        let parts = proved.range(input.parts()).map(|(_, result)| result.clone());
        if StoreSummary::of(&whole, input.summary.discovered.clone(), parts) != input.summary {
            let reason = "the outcomes counted are not those of the parts".to_owned();
            return Err(StoreError::Description { path: input.folder.join(SUMMARY), reason });
        }
    }
    let joined = join(&whole, &inputs)?;
    let results = each(&|part, input| {
        let file = whole.file_of(part);
        let (from, to) = (input.folder.join(&file), out.join(&file));
        let (record, summary) = &proved[&part];
        let renumbering =
            joined.as_ref().and_then(|(_, ways)| ways.get(&input.manifest.shard.number));
        match renumbering {
            Some(renumbering) if !renumbering.is_identity() => {
                part::renumber(&from, &to, &whole, renumbering)?;
                let read = part::record(&from, file, record.seeds.clone())?;
                if read.sha256 != record.sha256 {
                    // What was written is not what was proved.
                    let _ = fs::remove_file(&to);
                    return Err(StoreError::part(&from, CHANGED));
                }
                let list = joined.as_ref().map_or(&[][..], |(list, _)| &list.equilibria);
                part::read(out, &whole, list, part)
            }
            _ => {
                copy(&from, &to, &record.sha256)?;
                Ok((record.clone(), summary.clone()))
            }
        }
    })?;
    if results.len() as u64 != count {
        return Ok(None);
    }
    let discovered = joined.map(|(discovered, _)| discovered);
    let summary = StoreSummary::of(&whole, discovered, results.into_values());
    write_json(&out.join(SUMMARY), &summary)?;
    Digests::close(out);
    Ok(Some(summary))
}

/// A part as it is there, and what it counts.
type Proved = Result<(PartRecord, Summary)>;

/// What was discovered, and the way to its numbers from those of every shard.
type Joined = (Discovered, BTreeMap<u64, Renumbering>);

/// Join what the shards discovered, in their order; nothing where lists are complete.
fn join(whole: &Manifest, inputs: &BTreeMap<u64, Input>) -> Result<Option<Joined>> {
    let Some(mut all) = whole.nothing_reached()? else { return Ok(None) };
    for input in inputs.values() {
        let list = input.summary.discovered.as_ref();
        let Some(list) = list.filter(|list| list.fits(all.bars())) else {
            let reason = "it has no list of this chain's equilibria".to_owned();
            return Err(StoreError::Description { path: input.folder.join(SUMMARY), reason });
        };
        all.join(list);
    }
    let (discovered, _) = all.finish();
    let way = |(number, input): (&u64, &Input)| {
        let list = input.discovered();
        (*number, all.renumbering(list.len(), list.iter().enumerate()))
    };
    Ok(Some((discovered, inputs.iter().map(way).collect())))
}

/// Every shard that makes `whole`, by its number.
fn complete(
    inputs: impl Iterator<Item = Result<Input>>,
    whole: Shard,
) -> Result<BTreeMap<u64, Input>> {
    let mut all: BTreeMap<u64, Input> = BTreeMap::new();
    for input in inputs {
        let input = input?;
        if let Some(first) = all.values().next() {
            input.belongs_to(first)?;
        }
        let shard = input.manifest.shard;
        let folder = input.folder.clone();
        if let Some(other) = all.insert(shard.number, input) {
            return Err(StoreError::Double { shard, first: other.folder, second: folder });
        }
    }
    if let Some(first) = all.values().next() {
        let of = first.manifest.shard.of;
        let times = of / whole.of.max(1);
        if times * whole.of != of {
            return Err(StoreError::Uneven { of, wanted: whole });
        }
        let wanted = (whole.number - 1) * times + 1..=whole.number * times;
        if let Some(other) =
            all.values().find(|input| !wanted.contains(&input.manifest.shard.number))
        {
            let (path, found) = (other.folder.clone(), other.manifest.shard);
            return Err(StoreError::Outside { path, found, wanted: whole });
        }
        let missing = wanted.filter(|number| !all.contains_key(number));
        // A manifest may say anything: one more than is shown is enough.
        let missing: Vec<_> = missing.take(NAMED + 1).collect();
        if !missing.is_empty() {
            return Err(StoreError::Missing { missing, of });
        }
    }
    Ok(all)
}

impl Input {
    fn read(folder: &Path) -> Result<Self> {
        let path = || folder.to_owned();
        let manifest = Manifest::read(folder)?;
        let as_it_should = manifest.clone().with_shard(manifest.shard);
        if let Some((key, wanted, found)) = as_it_should.difference(&manifest) {
            return Err(StoreError::Differs { path: path(), key, wanted, found });
        }
        if !folder.join(SUMMARY).exists() {
            return Err(StoreError::Unfinished { path: path() });
        }
        let summary = read_json(&folder.join(SUMMARY))?;
        Ok(Self { folder: path(), manifest, summary })
    }

    /// Whether it is a shard of the same sweep.
    fn belongs_to(&self, first: &Self) -> Result<()> {
        let (shard, of) = (self.manifest.shard, first.manifest.shard.of);
        let ours = self.manifest.clone().with_shard(Shard::WHOLE);
        let theirs = first.manifest.clone().with_shard(Shard::WHOLE);
        let path = self.folder.clone();
        if let Some((key, wanted, found)) = theirs.difference(&ours) {
            return Err(StoreError::Differs { path, key, wanted, found });
        }
        if shard.of != of {
            return Err(StoreError::OtherCut { path, found: shard, wanted: of });
        }
        Ok(())
    }

    /// What was discovered, behind the list of the manifest.
    fn discovered(&self) -> &[Member] {
        self.summary.discovered.as_ref().map_or(&[], |discovered| &discovered.equilibria)
    }

    fn parts(&self) -> std::ops::Range<u64> {
        self.manifest.shard.parts(self.manifest.parts())
    }

    /// Read a part, and see that it is the one that the summary speaks of.
    fn prove(&self, part: u64) -> Proved {
        let path = self.folder.join(self.manifest.file_of(part));
        if !path.exists() {
            return Err(StoreError::NoPart { path });
        }
        regular(&path)?;
        let result = part::read(&self.folder, &self.manifest, self.discovered(), part)?;
        let index = usize::try_from(part - self.parts().start).unwrap_or(usize::MAX);
        match self.summary.parts.get(index) {
            Some(said) if *said == result.0 => Ok(result),
            Some(said) => {
                let (said, found) = (&said.sha256, &result.0.sha256);
                let reason = format!("its SHA-256 is {found}, and the summary says {said}");
                Err(StoreError::part(&path, reason))
            }
            None => Err(StoreError::part(&path, "the summary does not know it")),
        }
    }
}

const CHANGED: &str = "it changed while it was being copied";

/// Whether two names lead to one folder.
fn is_same(a: &Path, b: &Path) -> bool {
    match (fs::canonicalize(a), fs::canonicalize(b)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// Copy a file, and see that it is still the one that was proved.
fn copy(from: &Path, to: &Path, wanted: &str) -> Result<()> {
    let io = |error| StoreError::file(to, error);
    let mut writer = columns::AtomicFile::create(to).map_err(io)?;
    if part::copied(from, &mut writer, io)?.1 != wanted {
        return Err(StoreError::part(from, CHANGED));
    }
    writer.commit().map_err(io)
}
