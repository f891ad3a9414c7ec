//! One writer per folder, whatever ends it.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use crate::store::description::{DIGESTS, MANIFEST, SUMMARY, read_json};
use crate::store::error::{Result, StoreError, regular};
use crate::store::manifest::Manifest;
use crate::store::open;

const LOCK: &str = ".lock";

/// The right to write a folder, until it is dropped or the process ends, however it ends.
pub(crate) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Make the folder if need be, see that it is fit for this sweep, and clear what a killed
    /// process left.
    ///
    /// The lock comes first: what is seen before it may be gone or half written a moment later.
    pub(crate) fn take(folder: &Path, manifest: &Manifest, resume: bool) -> Result<Self> {
        let io = |error| StoreError::file(folder, error);
        fs::create_dir_all(folder).map_err(io)?;
        let lock = Self::hold(folder)?;
        let held = folder.join(MANIFEST);
        let there = held.exists();
        if there && !resume {
            return Err(StoreError::Present { path: folder.to_owned() });
        }
        if !there && let Some(found) = foreign(folder)? {
            return Err(StoreError::NotEmpty { path: folder.to_owned(), found });
        }
        remove_unfinished(folder, manifest)?;
        if there {
            let held: Manifest = read_json(&held)?;
            if let Some((key, wanted, found)) = manifest.difference(&held) {
                let path = folder.to_owned();
                return Err(StoreError::Differs { path, key, wanted, found });
            }
        } else {
            columns::write_whole(&held, manifest.json().as_bytes())
                .map_err(|error| StoreError::file(&held, error))?;
        }
        Ok(lock)
    }

    /// The lock alone.
    fn hold(folder: &Path) -> Result<Self> {
        let path = folder.join(LOCK);
        let io = |error| StoreError::file(&path, error);
        loop {
            regular(&path)?;
            // Not truncated: another process may hold it.
            let file = File::options().create(true).append(true).open(&path).map_err(io)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    return Err(StoreError::Busy { path: folder.to_owned() });
                }
                Err(TryLockError::Error(error)) => return Err(io(error)),
            }
            if is_at(&file, &path).map_err(io)? {
                return Ok(Self { path, _file: file });
            }
            // Its last holder removed it in between; the next one to come would not see this lock.
        }
    }
}

impl Drop for Lock {
    /// Remove the file while it is still locked: nobody else's can be there.
    fn drop(&mut self) {
        if REMOVED {
            // Best effort: a file without a lock on it does no harm.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether the file of a lock goes with it: where a file that was opened can be told from the one
/// that has its name by now.
const REMOVED: bool = cfg!(unix);

/// Whether an open file is the one that has this name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt as _;
    let ours = file.metadata()?;
    match fs::metadata(path) {
        Ok(named) => Ok((named.dev(), named.ino()) == (ours.dev(), ours.ino())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

/// Whether an open file is the one that has this name: nobody removes it here.
#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "it can fail elsewhere")]
fn is_at(_: &File, _: &Path) -> io::Result<bool> {
    Ok(true)
}

/// Remove what killed processes left unfinished of this sweep, and nothing else.
fn remove_unfinished(folder: &Path, manifest: &Manifest) -> Result<()> {
    for entry in fs::read_dir(folder).map_err(|error| StoreError::file(folder, error))? {
        let entry = entry.map_err(|error| StoreError::file(folder, error))?;
        let name = entry.file_name();
        let ours =
            columns::unfinished(&name.to_string_lossy()).is_some_and(|of| is_ours(of, manifest));
        let path = entry.path();
        if ours && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            fs::remove_file(&path).map_err(|error| StoreError::file(&path, error))?;
        }
    }
    Ok(())
}

/// Whether a file of this name belongs to the sweep.
fn is_ours(name: &str, manifest: &Manifest) -> bool {
    let numbered = |before: &str| name.strip_prefix(before)?.split('.').next()?.parse().ok();
    let part = || Some(name == manifest.file_of(numbered("part-")?));
    let open =
        || Some(open::files_of(manifest, numbered(open::BEFORE)?).contains(&name.to_owned()));
    [MANIFEST, SUMMARY, DIGESTS].contains(&name) || part() == Some(true) || open() == Some(true)
}

/// Something in a folder that no unfinished sweep leaves there.
fn foreign(folder: &Path) -> Result<Option<String>> {
    for entry in fs::read_dir(folder).map_err(|error| StoreError::file(folder, error))? {
        let name = entry.map_err(|error| StoreError::file(folder, error))?.file_name();
        let name = name.to_string_lossy();
        if name != LOCK && columns::unfinished(&name) != Some(MANIFEST) {
            return Ok(Some(name.into_owned()));
        }
    }
    Ok(None)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_lock_on_a_file_that_was_removed_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let first = Lock::hold(folder.path()).unwrap();
        assert!(matches!(Lock::hold(folder.path()), Err(StoreError::Busy { .. })));
        // Opened while the first one held it, and got when it was gone.
        let late = File::open(&first.path).unwrap();
        assert!(is_at(&late, &first.path).unwrap());
        drop(first);
        late.try_lock().unwrap();
        assert!(!is_at(&late, &folder.path().join(LOCK)).unwrap());
        // Somebody else has made a new one meanwhile.
        let second = Lock::hold(folder.path()).unwrap();
        assert!(!is_at(&late, &second.path).unwrap());
        drop(second);
        assert!(!folder.path().join(LOCK).exists());
    }
}
