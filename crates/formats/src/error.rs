//! Why a file of another program cannot be used.

use std::fmt::Display;

use model::budget::OutOfMemory;

/// What is read of a file, or why it cannot be used.
pub type Result<T, E = FormatError> = std::result::Result<T, E>;

/// Why a file cannot be used: which file, which line where that is known, and what is wrong.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{}{what}", line.map_or_else(|| " ".to_owned(), |line| format!("{line}: ")))]
pub struct FormatError {
    /// The file as it was named.
    pub file: String,
    /// The line, from 1.
    pub line: Option<usize>,
    /// What is wrong.
    pub what: Box<Wrong>,
    /// What is allowed instead, or what to do about it.
    pub help: Option<String>,
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Wrong {
    /// Occurs when there is nothing in the file.
    #[error("the file is empty")]
    Empty,
    /// Occurs when the text is no JSON: what the parser says.
    #[error("this is not JSON: {0}")]
    Json(String),
    /// Occurs when the text is no XML: what the parser says.
    #[error("this is not XML: {0}")]
    Xml(String),
    /// Occurs when a part that is needed is not there.
    #[error("there is no {0}")]
    Missing(String),
    /// Occurs when a part is not understood, so that the system or answer would be another one
    /// without it.
    #[error("{0} is not understood")]
    Unknown(String),
    /// Occurs when a part is understood and outside of what systems of bars are.
    #[error("{0} is not part of a system of bars at rest")]
    OutOfScope(String),
    /// Occurs when a value is of the wrong type or out of range.
    #[error("{what} must be {wanted}, found {found:?}")]
    Value {
        /// Of what.
        what: String,
        /// What is allowed.
        wanted: &'static str,
        /// As it stands in the file.
        found: String,
    },
    /// Occurs when a line has not as many values as the line that names the columns.
    #[error("{wanted} values are needed here, found {found}")]
    Count {
        /// Values named.
        wanted: usize,
        /// Values found.
        found: usize,
    },
    /// Occurs when a name or number stands twice.
    #[error("{0} is there twice")]
    Repeated(String),
    /// Occurs when what the file describes needs more memory than there is.
    #[error("{0}")]
    Memory(OutOfMemory),
    /// Occurs when what was read is no system, and why: a length that is no length, a member twice.
    #[error("{0}")]
    NoSystem(String),
}

impl FormatError {
    pub(crate) fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// A file, or a line of it, in which something is wrong.
#[derive(Debug, Clone, Copy)]
pub(crate) struct At<'a> {
    pub(crate) file: &'a str,
    /// The line, from 1.
    pub(crate) line: Option<usize>,
}

impl<'a> At<'a> {
    pub(crate) fn file(file: &'a str) -> Self {
        Self { file, line: None }
    }

    pub(crate) fn line(file: &'a str, line: usize) -> Self {
        Self { file, line: Some(line) }
    }

    pub(crate) fn error(self, what: Wrong) -> FormatError {
        let Self { file, line } = self;
        FormatError { file: file.to_owned(), line, what: Box::new(what), help: None }
    }

    pub(crate) fn missing(self, what: impl Into<String>) -> FormatError {
        self.error(Wrong::Missing(what.into()))
    }

    pub(crate) fn unknown(self, what: impl Into<String>) -> FormatError {
        self.error(Wrong::Unknown(what.into()))
    }

    pub(crate) fn out_of_scope(self, what: impl Into<String>) -> FormatError {
        self.error(Wrong::OutOfScope(what.into()))
    }

    pub(crate) fn repeated(self, what: String) -> FormatError {
        self.error(Wrong::Repeated(what))
    }

    pub(crate) fn no_system(self, reason: impl Display) -> FormatError {
        self.error(Wrong::NoSystem(reason.to_string()))
    }

    pub(crate) fn memory(self, error: OutOfMemory) -> FormatError {
        self.error(Wrong::Memory(error))
    }

    pub(crate) fn value(self, what: &str, wanted: &'static str, found: &str) -> FormatError {
        self.error(Wrong::Value { what: what.to_owned(), wanted, found: shortened(found) })
    }

    /// A finite number; anything else, `nan` and `inf` too, is an error.
    pub(crate) fn number(self, what: &str, text: &str) -> Result<f64> {
        let parsed = text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        parsed.ok_or_else(|| self.value(what, "a finite number", text))
    }

    /// A number above zero.
    pub(crate) fn positive(self, what: &str, text: &str) -> Result<f64> {
        let found = self.number(what, text)?;
        if found > 0.0 { Ok(found) } else { Err(self.value(what, "positive", text)) }
    }
}

/// What an error shows of a text.
pub(crate) fn shortened(text: &str) -> String {
    /// Characters.
    const SHOWN: usize = 60;
    let mut out: String = text.trim().chars().take(SHOWN).collect();
    if text.trim().chars().count() > SHOWN {
        out.push_str("...");
    }
    out
}

/// A whole number that was checked to fit.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole, from 0 to 2^32"
)]
pub(crate) fn as_count(x: f64) -> usize {
    x as usize
}
