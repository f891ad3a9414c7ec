//! Files that are whole or not there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Bytes collected before they go to the system.
const BUFFER: usize = 1 << 18;

/// A file that appears under its name when it is complete: until then it grows beside it, and when it is
/// dropped before it goes away. A process that is killed leaves `.NAME.PROCESS.part` behind, which
/// [`remove_unfinished`] clears.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    part: PathBuf,
    file: Option<BufWriter<File>>,
}

impl AtomicFile {
    /// Begin a file.
    ///
    /// # Errors
    ///
    /// Those of the file system.
    pub fn create(path: &Path) -> io::Result<Self> {
        if path.is_dir() {
            return Err(io::Error::from(io::ErrorKind::IsADirectory));
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let part = path.with_file_name(format!(".{name}.{}{UNFINISHED}", std::process::id()));
        let file = Some(BufWriter::with_capacity(BUFFER, File::create(&part)?));
        Ok(Self { path: path.to_owned(), part, file })
    }

    /// Give the file its name; what was there under it is replaced. The bytes are on the disk before.
    ///
    /// # Errors
    ///
    /// Those of the file system.
    pub fn commit(mut self) -> io::Result<()> {
        if let Some(writer) = self.file.take() {
            let file = writer.into_inner().map_err(io::IntoInnerError::into_error);
            // Taken out of `self`: the part must go by hand if this fails.
            let named = file
                .and_then(|file| file.sync_data())
                .and_then(|()| fs::rename(&self.part, &self.path));
            if named.is_err() {
                let _ = fs::remove_file(&self.part);
            }
            return named;
        }
        Ok(())
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.as_mut().map_or(Ok(0), |file| file.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_mut().map_or(Ok(()), BufWriter::flush)
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if self.file.take().is_some() {
            // Best effort: there is nobody to tell.
            let _ = fs::remove_file(&self.part);
        }
    }
}

/// What the name of an unfinished file ends in.
const UNFINISHED: &str = ".part";

/// Remove what killed processes left unfinished in a folder. Nobody else may be writing there.
///
/// # Errors
///
/// Those of the file system.
pub fn remove_unfinished(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with('.') && name.ends_with(UNFINISHED) {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

/// Write a whole file, so that an interruption leaves the old one or the new one.
///
/// # Errors
///
/// Those of the file system.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = AtomicFile::create(path)?;
    file.write_all(bytes)?;
    file.commit()
}
