//! Reading: from files and texts to chains and problems.

use std::path::Path;

use super::described::Described;
use super::error::SystemFileError;
use super::json;
use super::kind::SystemFileErrorKind as Kind;
use super::limits::most_file_bytes;
use super::load::{Loaded, load, without_mark};
use super::source::{BarsReader, Readers, Source};
use crate::{Chain, Problem};

/// Read a system file of any kind: a chain, a chain with loads, or joints by name; TOML, or JSON
/// with the same keys.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason; why something is no equilibrium problem
/// points at the number that it rests on.
pub fn read(path: impl AsRef<Path>) -> Result<Described, SystemFileError> {
    read_with(path, Readers { bars: &|_| None, rows: &|_, _| None })
}

/// [`read()`] for a program that reads columns from more kinds of files than this crate does:
/// `readers` are asked first for what `bars_file` and `joints_file` name.
///
/// # Errors
///
/// Those of [`read()`]; an error of a reader is placed at the key.
pub fn read_with(
    path: impl AsRef<Path>,
    readers: Readers<'_>,
) -> Result<Described, SystemFileError> {
    let path = path.as_ref();
    let Loaded { file, text } = open(path)?;
    described(&file, without_mark(&text), path.parent(), Some(readers))
}

/// Parse the text of a system file of any kind; `file` is its name in errors. The bars must stand
/// in the text: no file is opened.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason.
///
/// ```
/// use model::system_file::{Described, parse};
/// let text = r#"
/// [joints]
/// A = { at_m = [0, 0, 0] }
/// B = { at_m = [1, 0, 0] }
/// lamp = { mass_kg = 5 }
///
/// [[bars]]
/// from = "A"
/// to = "lamp"
/// length_m = 1
/// mass_kg = 0
///
/// [[bars]]
/// from = "lamp"
/// to = "B"
/// length_m = 0.5
/// mass_kg = 0
/// count = 2
/// "#;
/// let Described::System(system) = parse(text, "lamp.toml")? else { panic!("joints by name") };
/// assert_eq!((system.joints().len(), system.members().len()), (4, 3));
/// # Ok::<(), model::system_file::SystemFileError>(())
/// ```
pub fn parse(text: &str, file: &str) -> Result<Described, SystemFileError> {
    described(file, without_mark(text), None, None)
}

/// JSON is read as the TOML that says the same.
fn described(
    file: &str,
    text: &str,
    folder: Option<&Path>,
    readers: Option<Readers<'_>>,
) -> Result<Described, SystemFileError> {
    let (reader, rows) = readers.map(|readers| (readers.bars, readers.rows)).unzip();
    if !json::is_json(text) {
        return Source { folder, reader, rows, ..Source::of(file, text) }.described();
    }
    let failed = |(offset, message): (usize, String)| {
        let kind = Kind::Json(message);
        SystemFileError::new(file, text, Some(offset..offset), None, kind)
    };
    let same = json::as_toml(text).map_err(failed)?;
    let source = Source { folder, reader, rows, ..Source::of(file, &same) };
    source.described().map_err(|error| error.of_text(text))
}

/// Read the system file of a chain.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason.
pub fn read_system(path: impl AsRef<Path>) -> Result<Chain, SystemFileError> {
    let path = path.as_ref();
    let Loaded { file, text } = open(path)?;
    let text = without_mark(&text);
    Source { folder: path.parent(), ..Source::of(&file, text) }.chain()
}

/// Read a system file that describes an equilibrium problem.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason; a [`Refusal`](crate::Refusal) points at the
/// number it rests on.
pub fn read_problem(path: impl AsRef<Path>) -> Result<Problem, SystemFileError> {
    read_problem_with(path, &|_| None)
}

/// [`read_problem`] for a program that reads bars from more kinds of files than this crate does:
/// `reader` is asked first for what `bars_file` names.
///
/// # Errors
///
/// Those of [`read_problem`]; an error of the reader is placed at `bars_file`.
pub fn read_problem_with(
    path: impl AsRef<Path>,
    reader: BarsReader<'_>,
) -> Result<Problem, SystemFileError> {
    let path = path.as_ref();
    let Loaded { file, text } = open(path)?;
    let text = without_mark(&text);
    Source { folder: path.parent(), reader: Some(reader), ..Source::of(&file, text) }.problem()
}

/// Parse the text of a system file; `file` is its name in errors. The bars must stand in the text:
/// no file is opened.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason.
///
/// ```
/// let chain = model::system_file::parse_system(
///     "anchors = { start_m = [0, 0, 0], end_m = [3, 0, 4] }\n\
///      bars = [{ length_m = 2, mass_kg = 1, count = 4 }]\n",
///     "inline.toml",
/// )?;
/// assert_eq!((chain.bars().len(), chain.anchors().span_m()), (4, 5.0));
/// # Ok::<(), model::system_file::SystemFileError>(())
/// ```
pub fn parse_system(text: &str, file: &str) -> Result<Chain, SystemFileError> {
    Source::of(file, without_mark(text)).chain()
}

/// Parse the text of a system file that describes an equilibrium problem; see [`parse_system`].
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason; a [`Refusal`](crate::Refusal) points at the
/// number it rests on.
///
/// ```
/// use model::system_file::parse_problem;
/// let text = "anchors = { start_m = [0, 0, 0], end_m = [3, 0, 0] }\n\
///             bars = [{ length_m = 1, mass_kg = 1, count = 2 }]\n";
/// // The place, the key, and what is wrong in numbers.
/// let error = parse_problem(text, "short.toml").unwrap_err().to_string();
/// let place = "short.toml:1:42: anchors.end_m: ";
/// let why = "the anchors are 3 m apart and the bars reach only 2 m: 1 m are missing";
/// assert_eq!(error, format!("{place}{why}"));
/// ```
pub fn parse_problem(text: &str, file: &str) -> Result<Problem, SystemFileError> {
    Source::of(file, without_mark(text)).problem()
}

fn open(path: &Path) -> Result<Loaded, SystemFileError> {
    let unreadable = |error| {
        let file = path.display().to_string();
        SystemFileError::new(&file, "", None, None, Kind::Unreadable(error))
    };
    load(path, most_file_bytes()).map_err(unreadable)?
}
