//! Reading: from files and texts to problems.

use std::path::Path;

use super::described::Described;
use super::error::{Result, SystemFileError};
use super::json;
use super::kind::SystemFileErrorKind as Kind;
use super::limits::most_file_bytes;
use super::load::{Loaded, load, without_mark};
use super::rows::RowsReader;
use super::source::Source;

/// Read a system file of any kind: a chain, a chain with loads, or joints by name; TOML, or JSON
/// with the same keys.
///
/// # Errors
/// [`SystemFileError`] with the place and the reason; why something is no equilibrium problem
/// points at the number that it rests on.
pub fn read(path: impl AsRef<Path>) -> Result<Described> {
    read_with(path, &|_, _| None)
}

/// [`read()`] for a program that reads columns from more kinds of files than this crate does:
/// `rows` is asked first for what `bars_file` and `joints_file` name.
///
/// # Errors
/// Those of [`read()`]; an error of a reader is placed at the key.
pub fn read_with(path: impl AsRef<Path>, rows: RowsReader<'_>) -> Result<Described> {
    let path = path.as_ref();
    let unreadable = |error| {
        let file = path.display().to_string();
        SystemFileError::new(&file, "", None, None, Kind::Unreadable(error))
    };
    let Loaded { file, text } = load(path, most_file_bytes()).map_err(unreadable)??;
    described(&file, without_mark(&text), path.parent(), Some(rows))
}

/// Parse the text of a system file of any kind; `file` is its name in errors. The bars must stand
/// in the text: no file is opened.
///
/// # Errors
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
pub fn parse(text: &str, file: &str) -> Result<Described> {
    described(file, without_mark(text), None, None)
}

/// JSON is read as the TOML that says the same.
fn described(
    file: &str,
    text: &str,
    folder: Option<&Path>,
    rows: Option<RowsReader<'_>>,
) -> Result<Described> {
    if !json::is_json(file, text) {
        return Source { folder, rows, ..Source::of(file, text) }.described();
    }
    let failed = |(offset, message): (usize, String)| {
        let kind = Kind::Json(message);
        SystemFileError::new(file, text, Some(offset..offset), None, kind)
    };
    let same = json::as_toml(text).map_err(failed)?;
    let source = Source { folder, rows, ..Source::of(file, &same) };
    source.described().map_err(|error| error.of_text(text))
}
