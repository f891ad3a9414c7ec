//! Writing: standard output that may be a closed pipe, and files that are whole or not there.

use std::fmt::Display;
use std::fs;
use std::io::{self, BufWriter, ErrorKind, StdoutLock, Write};
use std::path::Path;

use columns::AtomicFile;
use miette::miette;

use crate::exit::Failure;

/// Version of the JSON objects; raised when a key that others rely on changes its meaning.
pub const SCHEMA_VERSION: u32 = 1;

/// Print to standard output. A reader that has gone away (`| head`) is no error.
pub fn print(text: &str) -> Result<(), Failure> {
    print_stream(|out| out.write_all(text.as_bytes()))
}

/// The same for what is too long to be held as one text.
pub fn print_stream(
    content: impl FnOnce(&mut BufWriter<StdoutLock<'_>>) -> io::Result<()>,
) -> Result<(), Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    match content(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::bad_input(miette!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

fn cannot_write(path: &Path, why: impl Display) -> Failure {
    Failure::bad_input(miette!("cannot write {}: {why}", path.display()))
}

/// Write a file, so that an interruption leaves the old file or the new one and never half of either.
pub fn write_whole(path: &Path, text: &str) -> Result<(), Failure> {
    write_stream(path, |file| file.write_all(text.as_bytes()))
}

/// The same for what is too long to be held as one text.
pub fn write_stream(
    path: &Path,
    content: impl FnOnce(&mut AtomicFile) -> io::Result<()>,
) -> Result<(), Failure> {
    let written = AtomicFile::create(path).and_then(|mut file| {
        content(&mut file)?;
        file.commit()
    });
    match written {
        // Of a pipe, as above.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(cannot_write(path, error)),
        _ => Ok(()),
    }
}

/// Make a folder with its parents.
pub fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        Failure::bad_input(miette!("cannot make the folder {}: {error}", path.display()))
    })
}
