//! The text that is read, and where it comes from.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use super::error::SystemFileError;
use super::kind::SystemFileErrorKind as Kind;
use crate::Bar;

/// Reads bars from a file of another kind than [`columns`](super::columns), for
/// [`read_problem_with`](super::read_problem_with): `None` if it does not know this kind.
pub type BarsReader<'a> =
    &'a dyn Fn(&Path) -> Option<Result<Vec<Bar>, Box<dyn Error + Send + Sync>>>;

/// A text with its name, and the folder it comes from if it comes from one.
pub(super) struct Source<'a> {
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    pub(super) folder: Option<&'a Path>,
    pub(super) reader: Option<BarsReader<'a>>,
}

impl Source<'_> {
    pub(super) fn error(
        &self,
        kind: Kind,
        key: Option<String>,
        span: Option<Range<usize>>,
    ) -> SystemFileError {
        SystemFileError::new(self.file, self.text, span, key, kind)
    }
}
