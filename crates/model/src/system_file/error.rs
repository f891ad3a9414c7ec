//! An error in a system file, with its place.

use std::fmt;
use std::ops::Range;

use super::kind::SystemFileErrorKind;
use super::location::Position;

/// What is read of a system file, or what is wrong there.
pub type Result<T, E = SystemFileError> = std::result::Result<T, E>;

/// An error in a system file: which file, which line, which key, what is wrong, what is allowed.
///
/// Shown as `file:line:column: key: what is wrong`. With [`text`](Self::text), [`span`](Self::span)
/// and [`help`](Self::help) a program can show the line and mark the place.
///
/// ```
/// use model::system_file::parse;
/// let text = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0]\n";
/// let error = parse(text, "chain.toml").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "chain.toml:3:9: anchors.end_m: expected three numbers, found 2"
/// );
/// assert_eq!(error.line(), Some("end_m = [0, 0]"));
/// assert_eq!(&error.text()[error.span().unwrap()], "[0, 0]");
/// assert_eq!(error.help().unwrap(), "a vector is written [x, y, z]");
/// ```
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

    /// The same error in a text whose places are those of this one.
    pub(super) fn of_text(mut self, text: &str) -> Self {
        text.clone_into(&mut self.0.text);
        self
    }

    /// The file as it was named; the bars file if the error stands there.
    pub fn file(&self) -> &str {
        &self.0.file
    }

    /// The text of the file as far as it could be read, without a byte order mark; bytes that are
    /// not UTF-8 are replaced by U+FFFD.
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// The bytes of [`text`](Self::text) the error is about.
    pub fn span(&self) -> Option<Range<usize>> {
        self.0.span.clone()
    }

    /// The key the error is about, as a path such as `bars[2].length_m` or `anchors.end_m[3]`:
    /// tables of `[[bars]]` and components of vectors are counted from 1, as the lines are. In a
    /// bars file, the column.
    pub fn key(&self) -> Option<&str> {
        self.0.key.as_deref()
    }

    /// What is wrong.
    pub fn kind(&self) -> &SystemFileErrorKind {
        &self.0.kind
    }

    /// Line and column of the start of the span.
    pub fn position(&self) -> Option<Position> {
        Position::of(&self.0.text, self.0.span.as_ref()?.start)
    }

    /// The line the error is about, without its line break; nothing of a file that is something else,
    /// whose lines are not to be shown: neither TOML nor JSON, and without the keys that every system
    /// has.
    pub fn line(&self) -> Option<&str> {
        let is_known = || ["anchors", "joints", "bars"].iter().any(|key| self.0.text.contains(key));
        if matches!(self.0.kind, SystemFileErrorKind::Syntax(_) | SystemFileErrorKind::Json(_))
            && !is_known()
        {
            return None;
        }
        self.0.text.lines().nth(self.position()?.line - 1)
    }

    /// What is allowed here, or what to do about it.
    pub fn help(&self) -> Option<String> {
        self.0.kind.help()
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
            SystemFileErrorKind::Unreadable(error)
            | SystemFileErrorKind::UnreadableBars { error, .. } => Some(error),
            _ => None,
        }
    }
}
