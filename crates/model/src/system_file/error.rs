//! What can be wrong with a system file, and where.

use std::fmt;
use std::ops::Range;

use crate::{BarError, ChainError, Refusal};

/// An error in a system file: which file, which line, which key, what is wrong, what is allowed.
#[derive(Debug)]
pub struct SystemFileError(Box<Details>);

/// Boxed, so that the good case does not carry it around.
#[derive(Debug)]
struct Details {
    file: String,
    text: String,
    span: Option<Range<usize>>,
    key: Option<String>,
    kind: SystemFileErrorKind,
}

/// What is wrong.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SystemFileErrorKind {
    /// Occurs when the file cannot be read: it is not there, is a folder, or access is denied.
    #[error("cannot read the file: {0}")]
    Unreadable(std::io::Error),
    /// Occurs when the file is longer than any system file needs to be.
    #[error("the file is {bytes} bytes long, more than the limit of {limit} bytes")]
    TooLong {
        /// Its length.
        bytes: u64,
        /// The limit.
        limit: u64,
    },
    /// Occurs when the file holds nothing but white space and comments.
    #[error("the file describes no system: it is empty")]
    Empty,
    /// Occurs when the file is not UTF-8.
    #[error("the file is not UTF-8 text (first bad byte at offset {offset})")]
    NotText {
        /// Offset of the first byte that is not UTF-8.
        offset: usize,
    },
    /// Occurs when the text is no TOML, a duplicate key included.
    #[error("not valid TOML: {0}")]
    Syntax(String),
    /// Occurs when a key is not one of those allowed in its table.
    #[error("unknown key `{key}`")]
    UnknownKey {
        /// The key.
        key: String,
        /// The keys allowed here.
        allowed: &'static [&'static str],
        /// The allowed key that looks most like it.
        suggestion: Option<&'static str>,
    },
    /// Occurs when a required key is missing.
    #[error("the key `{key}` is missing")]
    MissingKey {
        /// The key.
        key: &'static str,
        /// What it must hold.
        wanted: &'static str,
    },
    /// Occurs when a value has the wrong type.
    #[error("expected {wanted}, found {found}")]
    WrongType {
        /// What is allowed.
        wanted: &'static str,
        /// What stands there.
        found: String,
    },
    /// Occurs when a vector does not have three components.
    #[error("expected three numbers, found {found}")]
    WrongCount {
        /// How many stand there.
        found: usize,
    },
    /// Occurs when an integer does not fit where it stands.
    #[error("the number {found} is out of range")]
    OutOfRange {
        /// As written.
        found: String,
        /// What is allowed.
        wanted: &'static str,
    },
    /// Occurs when the counts add up to more bars than fit.
    #[error("the counts add up to more than {limit} bars")]
    TooManyBars {
        /// The limit.
        limit: usize,
    },
    /// Occurs when a bar cannot be built.
    #[error(transparent)]
    Bar(BarError),
    /// Occurs when the chain cannot be built.
    #[error(transparent)]
    Chain(ChainError),
    /// Occurs when the chain is no equilibrium problem.
    #[error(transparent)]
    Refused(Refusal),
}

/// A place in a text, for people: both from 1, columns in characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Position {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

impl SystemFileError {
    pub(super) fn new(
        file: &str,
        text: &str,
        span: Option<Range<usize>>,
        key: Option<String>,
        kind: SystemFileErrorKind,
    ) -> Self {
        Self(Box::new(Details { file: file.to_owned(), text: text.to_owned(), span, key, kind }))
    }

    /// The file as it was named.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.0.file
    }

    /// The text of the file as far as it could be read.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// The bytes of [`text`](Self::text) the error is about.
    #[must_use]
    pub fn span(&self) -> Option<Range<usize>> {
        self.0.span.clone()
    }

    /// The key the error is about, as a path such as `bars[2].length_m` (tables of `[[bars]]` counted
    /// from 1).
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        self.0.key.as_deref()
    }

    /// What is wrong.
    #[must_use]
    pub fn kind(&self) -> &SystemFileErrorKind {
        &self.0.kind
    }

    /// Line and column of the start of the span.
    #[must_use]
    pub fn position(&self) -> Option<Position> {
        let start = self.0.span.as_ref()?.start.min(self.0.text.len());
        let before = self.0.text.get(..start)?;
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Some(Position {
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        })
    }

    /// The line the error is about, without its line break.
    #[must_use]
    pub fn line(&self) -> Option<&str> {
        self.0.text.lines().nth(self.position()?.line - 1)
    }

    /// What is allowed here.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        use SystemFileErrorKind as K;
        Some(match &self.0.kind {
            K::UnknownKey { allowed, suggestion, .. } => {
                let list = format!("allowed here: {}", allowed.join(", "));
                match suggestion {
                    Some(near) => format!("did you mean `{near}`? {list}"),
                    None => list,
                }
            }
            K::MissingKey { key, wanted } => format!("{key} must be {wanted}"),
            K::WrongCount { .. } => "a vector is written [x, y, z]".to_owned(),
            K::OutOfRange { wanted, .. } => format!("allowed: {wanted}"),
            K::Empty => "a system needs [anchors] with start_m and end_m, and one or more [[bars]]"
                .to_owned(),
            K::Unreadable(error) if error.kind() == std::io::ErrorKind::IsADirectory => {
                "this is a folder; name a file in it".to_owned()
            }
            K::NotText { .. } => "save the file as UTF-8".to_owned(),
            K::TooLong { .. } | K::TooManyBars { .. } => {
                "equal bars in a row are written once, with `count`".to_owned()
            }
            K::Refused(refusal) => match refusal {
                Refusal::SingleBar { .. } => "use at least two bars",
                Refusal::OutOfReach { .. } | Refusal::Taut { .. } => {
                    "move the anchors together or lengthen the bars"
                }
                Refusal::BarTooLong { .. } | Refusal::Folded { .. } => {
                    "shorten this bar, lengthen another, or move the anchors apart"
                }
                Refusal::NoMass => "give at least one bar a mass",
            }
            .to_owned(),
            _ => return None,
        })
    }
}

impl fmt::Display for SystemFileError {
    /// `file:line:column: key: what is wrong`, without what is not known.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.0.file)?;
        if let Some(Position { line, column }) = self.position() {
            write!(f, "{line}:{column}:")?;
        }
        if let Some(key) = &self.0.key {
            write!(f, " {key}:")?;
        }
        write!(f, " {}", self.0.kind)
    }
}

impl std::error::Error for SystemFileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0.kind {
            SystemFileErrorKind::Unreadable(error) => Some(error),
            _ => None,
        }
    }
}
