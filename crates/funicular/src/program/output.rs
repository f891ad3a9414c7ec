//! Writing: standard output that may be a closed pipe, and files that are whole or not there.

use std::fmt::Display;
use std::fs;
use std::io::{self, BufWriter, ErrorKind, StdoutLock, Write};
use std::path::{Path, PathBuf};

use columns::AtomicFile;
use funicular::picture::Format;
use funicular::text::printed::{self, in_ascii};
use serde::Serialize;

use crate::exit::{Failure, Result};
use crate::printable::filtered;
use crate::tables::finished;

/// Print to standard output. A reader that has gone away (`| head`) is no error.
pub fn print(text: &str) -> Result<()> {
    let text = filtered(&finished(text), false);
    let text = if printed::ascii() { in_ascii(&text) } else { text };
    print_stream(|out| out.write_all(text.as_bytes()))
}

/// The same for JSON, which escapes what would steer a terminal.
pub fn print_objects(text: &str) -> Result<()> {
    print_stream(|out| out.write_all(text.as_bytes()))
}

/// The same for what is too long to be held as one text.
pub fn print_stream(
    content: impl FnOnce(&mut BufWriter<StdoutLock<'_>>) -> io::Result<()>,
) -> Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    match content(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(not_written("to standard output", &error))
        }
        _ => Ok(()),
    }
}

/// Print a JSON object.
pub fn print_json(object: &impl Serialize) -> Result<()> {
    print_stream(|out| {
        serde_json::to_writer_pretty(&mut *out, object)?;
        out.write_all(b"\n")
    })
}

/// What cannot be said in JSON: a number that is not finite, which no answer has.
pub fn no_json(error: &serde_json::Error) -> Failure {
    Failure::undecided(format!("the answer cannot be written as JSON: {error}"))
}

/// Refuse, before the work, what cannot be written after it, and what would overwrite a file that
/// is read or another that is written. What ends as a picture does is one.
pub fn check<'a>(outputs: impl IntoIterator<Item = &'a PathBuf>, inputs: &[PathBuf]) -> Result<()> {
    let outputs: Vec<_> = outputs.into_iter().collect();
    outputs.iter().try_for_each(|path| check_picture(path))?;
    check_files(outputs, inputs)
}

/// The same of what is no picture, whatever its name ends in.
pub fn check_files<'a>(
    outputs: impl IntoIterator<Item = &'a PathBuf>,
    inputs: &[PathBuf],
) -> Result<()> {
    let inputs: Vec<_> = inputs.iter().map(|path| (path, place(path))).collect();
    let mut others: Vec<(&PathBuf, PathBuf)> = Vec::new();
    for path in outputs {
        check_one(path)?;
        let Some(place) = place(path) else { continue };
        if let Some((input, _)) = inputs.iter().find(|(_, other)| other.as_ref() == Some(&place)) {
            return Err(cannot_write(
                path,
                format_args!("it is {}, which is read", input.display()),
            ));
        }
        if let Some((other, _)) = others.iter().find(|(_, other)| *other == place) {
            return Err(cannot_write(
                path,
                format_args!("{} is written to the same file", other.display()),
            ));
        }
        others.push((path, place));
    }
    Ok(())
}

/// Endings of pictures that are not written.
const OTHER_PICTURES: [&str; 9] =
    ["jpg", "jpeg", "gif", "eps", "webp", "bmp", "tif", "tiff", "svgz"];

/// What a file's name ends in, behind the point.
fn ending(path: &Path) -> &str {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default()
}

/// The name of a file for a page: as it ends in nothing else.
pub fn page_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match ending(&path).to_ascii_lowercase().as_str() {
        "" | "html" | "htm" => Ok(path),
        other => Err(format!("a page is written as .html, not as .{other}")),
    }
}

/// A picture can be written only in formats that we write.
fn check_picture(path: &Path) -> Result<()> {
    if OTHER_PICTURES.contains(&ending(path).to_ascii_lowercase().as_str()) {
        let why = format!("pictures are written as .{}", Format::ENDINGS.join(", ."));
        return Err(cannot_write(path, why));
    }
    Ok(())
}

/// A file can be written only into a folder that is there, and where the system lets us; `-` is meant
/// as standard output, not as a name.
fn check_one(path: &Path) -> Result<()> {
    if path == Path::new("-") {
        return Err(cannot_write(path, "it names no file; standard output is /dev/stdout"));
    }
    match path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        Some(folder) if !folder.is_dir() => {
            Err(cannot_write(path, format_args!("there is no folder {}", folder.display())))
        }
        _ if path.is_dir() => Err(cannot_write(path, "it is a folder")),
        _ => AtomicFile::check(path).map_err(|error| cannot_write(path, error)),
    }
}

/// Where a file is, whatever leads to it; `None` for pipes and devices, which any number may read
/// and write.
fn place(path: &Path) -> Option<PathBuf> {
    match fs::metadata(path) {
        Ok(about) if !about.is_file() => None,
        Ok(_) => fs::canonicalize(path).ok(),
        Err(_) => {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            let folder = fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()?;
            Some(folder.join(path.file_name()?))
        }
    }
}

fn cannot_write(path: &Path, why: impl Display) -> Failure {
    Failure::bad_input(format!("cannot write {}: {why}", path.display()))
}

/// A disk that is full says nothing about the input: what was asked is undecided, and may be asked
/// again.
pub fn not_written(what: &str, error: &io::Error) -> Failure {
    let report = format!("cannot write {what}: {error}");
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            Failure::undecided(report)
        }
        _ => Failure::bad_input(report),
    }
}

/// The files for several results: the path itself for one, `name-1.svg`, `name-2.svg`, ... for
/// more.
pub fn numbered(path: &Path, results: usize) -> Vec<PathBuf> {
    if results == 1 {
        return vec![path.to_owned()];
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = |number: usize| match path.extension() {
        Some(extension) => format!("{stem}-{number}.{}", extension.to_string_lossy()),
        None => format!("{stem}-{number}"),
    };
    (1..=results).map(|number| path.with_file_name(name(number))).collect()
}

/// Write a file, so that an interruption leaves the old file or the new one and never half of
/// either.
pub fn write_whole(path: &Path, text: &str) -> Result<()> {
    write_stream(path, |file| file.write_all(text.as_bytes()))
}

/// Write a drawing in the format that the ending of the file's name stands for: SVG if it is no other.
pub fn write_picture(path: &Path, svg: &str) -> Result<()> {
    let format = Format::of_ending(ending(path)).unwrap_or(Format::Svg);
    let file = format.file(svg).map_err(Failure::undecided)?;
    write_stream(path, |out| out.write_all(&file))
}

/// The same for what is too long to be held as one text.
pub fn write_stream(
    path: &Path,
    content: impl FnOnce(&mut AtomicFile) -> io::Result<()>,
) -> Result<()> {
    let written = AtomicFile::create(path).and_then(|mut file| {
        content(&mut file)?;
        file.commit()
    });
    match written {
        // Of a pipe, as above.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(not_written(&path.display().to_string(), &error))
        }
        _ => Ok(()),
    }
}

/// The same into a file that may have been asked for.
pub fn write_asked(
    path: Option<&PathBuf>,
    content: impl FnOnce(&mut AtomicFile) -> io::Result<()>,
) -> Result<()> {
    path.map_or(Ok(()), |path| write_stream(path, content))
}

/// Make a folder with its parents.
pub fn make_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(|error| {
        Failure::bad_input(format!("cannot make the folder {}: {error}", path.display()))
    })
}
