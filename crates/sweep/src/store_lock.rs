//! One writer per folder, whatever ends it.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use crate::description::{MANIFEST, read_json};
use crate::manifest::Manifest;
use crate::store_error::StoreError;

const LOCK: &str = ".lock";

/// The right to write a folder, until it is dropped or the process ends, however it ends.
pub(crate) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Make the folder if need be, see that it is fit for this sweep, and clear what a killed process left.
    pub(crate) fn take(
        folder: &Path,
        manifest: &Manifest,
        resume: bool,
    ) -> Result<Self, StoreError> {
        let io = |error| StoreError::file(folder, error);
        fs::create_dir_all(folder).map_err(io)?;
        let held = folder.join(MANIFEST);
        let there = held.exists();
        if there && !resume {
            return Err(StoreError::Present { path: folder.to_owned() });
        }
        if !there && let Some(found) = foreign(folder)? {
            return Err(StoreError::NotEmpty { path: folder.to_owned(), found });
        }
        let path = folder.join(LOCK);
        let file = File::create(&path).map_err(|error| StoreError::file(&path, error))?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => StoreError::Busy { path: folder.to_owned() },
            TryLockError::Error(error) => StoreError::file(&path, error),
        })?;
        let lock = Self { path, _file: file };
        columns::remove_unfinished(folder).map_err(io)?;
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

    /// Give the folder free. After an error the file stays, without a lock on it, and does no harm.
    pub(crate) fn release(self) {
        // Best effort, as above.
        let _ = fs::remove_file(&self.path);
    }
}

/// Something in a folder that no unfinished sweep leaves there.
fn foreign(folder: &Path) -> Result<Option<String>, StoreError> {
    for entry in fs::read_dir(folder).map_err(|error| StoreError::file(folder, error))? {
        let name = entry.map_err(|error| StoreError::file(folder, error))?.file_name();
        let name = name.to_string_lossy();
        if name != LOCK && !(name.starts_with(&format!(".{MANIFEST}."))) {
            return Ok(Some(name.into_owned()));
        }
    }
    Ok(None)
}
