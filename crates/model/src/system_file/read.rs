//! Reading: from files and texts to chains and problems.

use std::path::Path;

use super::error::SystemFileError;
use super::kind::SystemFileErrorKind as Kind;
use super::limits::MAX_FILE_BYTES;
use super::load::{Loaded, load, without_mark};
use super::source::{BarsReader, Source};
use crate::{Chain, Problem};

/// Read a system file.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason.
pub fn read_system(path: impl AsRef<Path>) -> Result<Chain, SystemFileError> {
    let path = path.as_ref();
    let Loaded { file, text } = open(path)?;
    let text = without_mark(&text);
    Source { file: &file, text, folder: path.parent(), reader: None }.chain()
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
    Source { file: &file, text, folder: path.parent(), reader: Some(reader) }.problem()
}

/// Parse the text of a system file; `file` is its name in errors. The bars must stand in the text: no
/// file is opened.
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
    Source { file, text: without_mark(text), folder: None, reader: None }.chain()
}

/// Parse the text of a system file that describes an equilibrium problem; see [`parse_system`].
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason; a [`Refusal`](crate::Refusal) points at the
/// number it rests on.
pub fn parse_problem(text: &str, file: &str) -> Result<Problem, SystemFileError> {
    Source { file, text: without_mark(text), folder: None, reader: None }.problem()
}

fn open(path: &Path) -> Result<Loaded, SystemFileError> {
    let unreadable = |error| {
        let file = path.display().to_string();
        SystemFileError::new(&file, "", None, None, Kind::Unreadable(error))
    };
    load(path, MAX_FILE_BYTES).map_err(unreadable)?
}
