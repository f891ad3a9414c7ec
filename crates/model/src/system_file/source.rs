//! The text that is read, and where it comes from.

use std::ops::Range;
use std::path::Path;

use super::error::SystemFileError;
use super::kind::SystemFileErrorKind as Kind;
use super::rows::RowsReader;
use crate::budget::Budget;

/// A text with its name, and the folder it comes from if it comes from one.
pub(super) struct Source<'a> {
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    pub(super) folder: Option<&'a Path>,
    pub(super) rows: Option<RowsReader<'a>>,
    /// What the system may come to need.
    pub(super) budget: Budget,
}

impl<'a> Source<'a> {
    /// A text that comes from no folder, with all memory there is.
    pub(super) fn of(file: &'a str, text: &'a str) -> Self {
        Self { file, text, folder: None, rows: None, budget: Budget::default() }
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
