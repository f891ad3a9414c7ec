//! What can be wrong with a parameter as it is written.

use std::ops::Range;

/// What reading a parameter leads to.
pub(crate) type Result<T, E = ParameterError> = std::result::Result<T, E>;

/// Why a text describes no parameter: what is wrong, where, and what would be allowed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}`, character {}: {what}", self.column())]
pub struct ParameterError {
    /// The text of the parameter.
    pub text: String,
    /// The bytes of the text that the error is about.
    pub span: Range<usize>,
    /// What is wrong with them.
    pub what: String,
    /// What is allowed there.
    pub help: String,
}

impl ParameterError {
    pub(crate) fn new(
        text: &str,
        span: Range<usize>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self { text: text.to_owned(), span, what: what.into(), help: help.into() }
    }

    /// Where, in characters from 1.
    pub fn column(&self) -> usize {
        self.text.char_indices().take_while(|(at, _)| *at < self.span.start).count() + 1
    }
}
