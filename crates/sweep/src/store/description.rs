//! The descriptions in the folder of a sweep, as JSON: their names, and how they are read and
//! written.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use serde::Serialize;

use crate::store::error::{Result, StoreError, regular};

/// Version of the folder's form; raised when a key or a column changes its meaning.
pub const SCHEMA_VERSION: u32 = 2;

pub(crate) const MANIFEST: &str = "manifest.json";
pub(crate) const SUMMARY: &str = "summary.json";

/// The list of an unfinished sweep, in the form of `sha256sum`: the manifest first, then a part a
/// line, in the order in which they were finished.
pub(crate) const DIGESTS: &str = ".digests";

/// Longest description that is read, bytes: the records of
/// [`MOST_PARTS`](crate::store::shard::MOST_PARTS) parts.
pub(crate) const MAX_DESCRIPTION: u64 = 64 << 20;

pub(crate) fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let description = |reason: String| StoreError::Description { path: path.to_owned(), reason };
    let text = serde_json::to_string_pretty(value).map_err(|e| description(e.to_string()))? + "\n";
    columns::write_whole(path, text.as_bytes()).map_err(|error| StoreError::file(path, error))
}

/// Read a description; one of another version of the form is told as that, whatever is in it.
pub(crate) fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T> {
    let fail = |reason: String| StoreError::Description { path: path.to_owned(), reason };
    let io = |error: std::io::Error| match error.kind() {
        ErrorKind::InvalidData => fail("it is not UTF-8 text".to_owned()),
        _ => StoreError::file(path, error),
    };
    regular(path)?;
    let length = fs::metadata(path).map_err(io)?.len();
    if length > MAX_DESCRIPTION {
        return Err(fail(format!("{length} bytes are too many for a description")));
    }
    let text = fs::read_to_string(path).map_err(io)?;
    let value: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| fail(error.to_string()))?;
    let version = value.get("schema_version").and_then(serde_json::Value::as_u64);
    if version != Some(SCHEMA_VERSION.into()) {
        let version = version.map_or_else(|| "missing".to_owned(), |version| version.to_string());
        return Err(fail(format!("its schema version is {version}, not {SCHEMA_VERSION}")));
    }
    // From the text: numbers for keys are strings in a value.
    serde_json::from_str(&text).map_err(|error| fail(error.to_string()))
}
