//! Files as inputs.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::Path;

/// Open a file to be read, without waiting for anybody.
///
/// A pipe that has a name in a folder is refused: opening it would wait until somebody writes into it,
/// perhaps for ever. Pipes of a shell (`-`, `<(command)`) have their writer.
///
/// # Errors
/// Those of the file system; [`ErrorKind::IsADirectory`] for a folder, [`ErrorKind::Unsupported`] for a
/// pipe with a name.
pub fn open_input(path: &Path) -> io::Result<File> {
    let about = fs::metadata(path)?;
    if about.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    // What a shell opens has no place of its own that its path leads to.
    if is_pipe(&about) && fs::canonicalize(path).is_ok() {
        let reason =
            "it is a pipe with a name, which may never have a writer; give `-` for standard input";
        return Err(io::Error::new(ErrorKind::Unsupported, reason));
    }
    File::open(path)
}

#[cfg(unix)]
fn is_pipe(about: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    about.file_type().is_fifo()
}

#[cfg(not(unix))]
fn is_pipe(_: &fs::Metadata) -> bool {
    false
}
