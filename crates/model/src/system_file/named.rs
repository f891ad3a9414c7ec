//! Files that a system file names.

use std::path::PathBuf;

use super::error::{Result, SystemFileError};
use super::kind::SystemFileErrorKind as Kind;
use super::limits::most_bars_file_bytes;
use super::load::{Loaded, load, without_mark};
use super::suggest::nearest;
use super::table::Table;

/// The text of the file that a key of the root names, with at least one of these columns.
///
/// Whoever wrote the system file need not be allowed to read what it names. So nothing of the text is
/// shown where no column has a name that is known, or like one: it is no such file.
pub(super) fn text(
    root: &Table<'_>,
    key: &'static str,
    path: PathBuf,
    columns: &'static [&'static str],
) -> Result<Loaded> {
    let loaded = match load(&path, most_bars_file_bytes()) {
        Ok(loaded) => loaded,
        Err(error) => return Err(root.error(Kind::UnreadableBars { path, error }, key)),
    };
    let text = loaded.as_ref().map_or_else(SystemFileError::text, |loaded| &loaded.text);
    let text = without_mark(text);
    if text.trim().is_empty() || has_column(text, columns) {
        return loaded;
    }
    Err(root.error(Kind::NoColumns { path, allowed: columns }, key))
}

/// Whether a name in the first line is that of a column, or like one.
fn has_column(text: &str, columns: &[&str]) -> bool {
    let head = text.lines().next().unwrap_or_default();
    let blank = |c: char| c == '"' || c.is_whitespace();
    let mut names = head.split([',', ';', '\t', '|']).map(|name| name.trim_matches(blank));
    names.any(|name| nearest(name, columns).is_some())
}
