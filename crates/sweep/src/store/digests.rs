//! The digests of parts that are whole: what is found in a folder is trusted only if it has its
//! own.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use crate::store::description::{DIGESTS, MANIFEST, SUMMARY, read_json};
use crate::store::error::{Result, StoreError, regular};
use crate::store::finished::{PartRecord, StoreSummary};
use crate::store::manifest::{Manifest, digest};
use crate::store::part;

/// Hexadecimal digits of a SHA-256.
const DIGITS: usize = 64;

/// Digests by file name: those of the summary where there is one, else those of the list.
pub(crate) struct Digests {
    known: BTreeMap<String, String>,
    path: PathBuf,
    /// The list that grows; none where the summary has them all.
    list: Option<Mutex<File>>,
}

impl Digests {
    /// Those of a folder that nobody else is writing.
    ///
    /// A summary that cannot be read is an error: without it all parts would be computed again,
    /// which is for the user to decide.
    pub(crate) fn open(folder: &Path, manifest: &Manifest) -> Result<Self> {
        let path = folder.join(DIGESTS);
        if folder.join(SUMMARY).exists() {
            let summary: StoreSummary = read_json(&folder.join(SUMMARY))?;
            let known = summary.parts.into_iter().map(|part| (part.file, part.sha256)).collect();
            return Ok(Self { known, path, list: None });
        }
        let io = |error| StoreError::file(&path, error);
        regular(&path)?;
        let text = match fs::read(&path) {
            Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
            Err(error) => return Err(io(error)),
        };
        let head = line(&digest(manifest.json().as_bytes()), MANIFEST);
        // The list of another sweep says nothing about this one.
        let known: BTreeMap<_, _> = text
            .strip_prefix(&head)
            .map(|rest| rest.lines().filter_map(entry).collect())
            .unwrap_or_default();
        // Written again: its last line may have been cut off.
        let lines = known.iter().map(|(file, sha256)| line(sha256, file));
        let text: String = std::iter::once(head).chain(lines).collect();
        columns::write_whole(&path, text.as_bytes()).map_err(io)?;
        let list = File::options().append(true).open(&path).map_err(io)?;
        Ok(Self { known, path, list: Some(Mutex::new(list)) })
    }

    /// See that a part that was there is the one that was written.
    pub(crate) fn check(&self, folder: &Path, found: &PartRecord) -> Result<()> {
        let reason = match self.known.get(&found.file) {
            Some(said) if *said == found.sha256 => return Ok(()),
            Some(said) => format!("its SHA-256 is {}, and was {said}", found.sha256),
            None => "its SHA-256 was not written down when it was made".to_owned(),
        };
        Err(StoreError::part(&folder.join(&found.file), reason))
    }

    /// Whether a file is the one that was written, and if not, why; `None` if nothing is there.
    pub(crate) fn holds(&self, folder: &Path, file: &str) -> Result<Option<Result<()>>> {
        let path = folder.join(file);
        regular(&path)?;
        if !path.exists() {
            return Ok(None);
        }
        let found = part::record(&path, file.to_owned(), 0..0)?;
        Ok(Some(self.check(folder, &found)))
    }

    /// Write down a part that is whole now.
    pub(crate) fn add(&self, made: &PartRecord) -> Result<()> {
        if let Some(Ok(mut list)) = self.list.as_ref().map(Mutex::lock) {
            list.write_all(line(&made.sha256, &made.file).as_bytes())
                .map_err(|error| StoreError::file(&self.path, error))?;
        }
        Ok(())
    }

    /// The summary of a folder has them all: the list goes.
    pub(crate) fn close(folder: &Path) {
        // Best effort: with a summary nobody reads it.
        let _ = fs::remove_file(folder.join(DIGESTS));
    }
}

fn line(sha256: &str, file: &str) -> String {
    format!("{sha256}  {file}\n")
}

/// File and digest of a line; none if it was cut off.
fn entry(line: &str) -> Option<(String, String)> {
    let (sha256, file) = line.split_once("  ")?;
    (sha256.len() == DIGITS).then(|| (file.to_owned(), sha256.to_owned()))
}
