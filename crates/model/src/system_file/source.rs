//! The text that is read, and where it comes from.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use super::error::SystemFileError;
use super::kind::SystemFileErrorKind as Kind;
use super::rows::RowsReader;
use crate::Bar;
use crate::budget::Budget;

/// Reads bars from a file of another kind than [`columns`](super::columns), for
/// [`read_problem_with`](super::read_problem_with): `None` if it does not know this kind.
pub type BarsReader<'a> =
    &'a dyn Fn(&Path) -> Option<Result<Vec<Bar>, Box<dyn Error + Send + Sync>>>;

/// Reads files of columns of other kinds than CSV, for [`read_with`](super::read_with): each is
/// asked first for what a system file names, and says `None` if it does not know the kind.
#[derive(Clone, Copy)]
pub struct Readers<'a> {
    /// Reads the bars of a chain.
    pub bars: BarsReader<'a>,
    /// Reads the joints and the bars of other systems.
    pub rows: RowsReader<'a>,
}

/// A text with its name, and the folder it comes from if it comes from one.
pub(super) struct Source<'a> {
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    pub(super) folder: Option<&'a Path>,
    pub(super) reader: Option<BarsReader<'a>>,
    pub(super) rows: Option<RowsReader<'a>>,
    /// What the system may come to need.
    pub(super) budget: Budget,
}

impl<'a> Source<'a> {
    /// A text that comes from no folder, with all memory there is.
    pub(super) fn of(file: &'a str, text: &'a str) -> Self {
        Self { file, text, folder: None, reader: None, rows: None, budget: Budget::default() }
    }
    pub(super) fn error(
        &self,
        kind: Kind,
        key: Option<String>,
        span: Option<Range<usize>>,
    ) -> SystemFileError {
        SystemFileError::new(self.file, self.text, span, key, kind)
    }
}
