//! What can go wrong with columns on disk.

use std::path::{Path, PathBuf};

use crate::table::{Mismatch, Schema};

/// What reading or writing columns leads to.
pub(crate) type Result<T, E = ColumnsError> = std::result::Result<T, E>;

/// Why columns cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum ColumnsError {
    /// Occurs when the file cannot be opened, read or written.
    #[error("{}: {error}", path.display())]
    File { path: PathBuf, error: std::io::Error },
    /// Occurs when a folder stands where a file is wanted.
    #[error("{} is a folder, not a file", path.display())]
    Folder { path: PathBuf },
    /// Occurs when the file holds not a single byte.
    #[error("{} is empty", path.display())]
    Empty { path: PathBuf },
    /// Occurs when the file is no Parquet file, or its end is missing.
    #[error("{} is not a Parquet file, or not a whole one: {reason}", path.display())]
    NotParquet { path: PathBuf, reason: String },
    /// Occurs when the file begins and ends as a Parquet file, yet its columns cannot be decoded.
    #[error("{} is damaged: {reason}", path.display())]
    Damaged { path: PathBuf, reason: String },
    /// Occurs when a column is compressed by what this program does not read.
    #[error("{}: column `{column}` is compressed by {found}, which cannot be read here; {supported} can", path.display())]
    Compression { path: PathBuf, column: String, found: String, supported: &'static str },
    /// Occurs when a column claims more memory than there is for the columns of a file.
    #[error("{}: column `{column}` claims {claimed} bytes of memory; of {budget} for a file, {left} are left", path.display())]
    Memory {
        path: PathBuf,
        column: String,
        /// What a page or a dictionary of it needs at least, bytes.
        claimed: u64,
        /// What the others leave, bytes.
        left: u64,
        /// What all of them may hold, bytes.
        budget: u64,
    },
    /// Occurs when a column holds something else than numbers.
    #[error("{}: column `{column}` must hold {wanted}, and holds {found}", path.display())]
    WrongType { path: PathBuf, column: String, wanted: &'static str, found: String },
    /// Occurs when a table to be read back has other columns than it was written with.
    #[error("{}: the columns are {}, and should be {}", path.display(), found.join(", "), wanted.join(", "))]
    OtherColumns { path: PathBuf, wanted: Vec<String>, found: Vec<String> },
    /// Occurs when rows to be written are not those of the table.
    #[error("{}: {error}", path.display())]
    Mismatch { path: PathBuf, error: Mismatch },
    /// Occurs when there are more rows than a system may have bars.
    #[error("{}: {rows} bars are more than the {limit} that a system may have", path.display())]
    TooManyBars { path: PathBuf, rows: u64, limit: usize },
}

impl ColumnsError {
    pub(crate) fn file(path: &Path, error: std::io::Error) -> Self {
        Self::File { path: path.to_owned(), error }
    }

    pub(crate) fn other_columns(path: &Path, schema: &Schema, found: Vec<String>) -> Self {
        let wanted = schema.columns.iter().map(|column| column.name.clone()).collect();
        Self::OtherColumns { path: path.to_owned(), wanted, found }
    }

    pub(crate) fn damaged(path: &Path, reason: &(impl ToString + ?Sized)) -> Self {
        Self::Damaged { path: path.to_owned(), reason: reason.to_string() }
    }
}
