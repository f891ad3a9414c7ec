//! Errors with the line they are about.

use std::io::Write as _;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use model::system_file::SystemFileError;

use crate::printable::{Printable, filtered};

/// Show errors with their source lines, and without a backtrace of the program's inside.
pub fn install() {
    // The hook can be set once per process; a second call would come from a test and is harmless.
    let _ = miette::set_hook(Box::new(|_| {
        Box::new(miette::MietteHandlerOpts::new().context_lines(1).tab_width(4).build())
    }));
}

/// An error in a system file as miette shows it.
#[derive(Debug)]
pub struct SystemFileReport {
    error: SystemFileError,
    source: NamedSource<String>,
}

impl From<SystemFileError> for SystemFileReport {
    fn from(error: SystemFileError) -> Self {
        let end = error.span().map_or(0, |span| span.end);
        let source = NamedSource::new(printable(error.file()), excerpt(error.text(), end));
        Self { error, source }
    }
}

/// Longest column that is shown in its line; an error beyond it is told by its place alone.
const WIDEST: usize = 400;

/// Bytes of a line that are shown after what an error is about, or at all.
const SHOWN: usize = 200;

/// A text for a terminal: what would steer it, such as escape sequences, becomes question marks, as
/// many as it has bytes.
fn printable(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        if c.is_control() && !matches!(c, '\n' | '\t' | '\r') {
            out.extend(std::iter::repeat_n('?', c.len_utf8()));
        } else {
            out.push(c);
        }
        out
    })
}

/// A text whose lines are no longer than is good to look at, the one with `end` in it not before
/// that. Nothing moves that stands before `end`.
fn excerpt(text: &str, end: usize) -> String {
    let mut out = String::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let content = line.trim_end_matches('\n');
        // Before the end all stays, so that places stay: only the last line that is shown may be
        // cut.
        let keep = if at + line.len() <= end { line.len() } else { end.saturating_sub(at) + SHOWN };
        if content.len() > keep {
            let cut = (keep..content.len()).find(|k| content.is_char_boundary(*k));
            out.push_str(&printable(&content[..cut.unwrap_or(content.len())]));
            out.push_str(if line.ends_with('\n') { "...\n" } else { "..." });
        } else {
            out.push_str(&printable(line));
        }
        at += line.len();
    }
    out
}

impl std::fmt::Display for SystemFileReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&printable(&self.error.to_string()))
    }
}

// Why a file cannot be read is part of the message; as a source it would be told twice.
impl std::error::Error for SystemFileReport {}

impl Diagnostic for SystemFileReport {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        self.error.help().map(|help| Box::new(help) as Box<dyn std::fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        let near = self.error.position().is_some_and(|place| place.column <= WIDEST);
        near.then_some(&self.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.source_code()?;
        let span = self.error.span()?;
        let label = Printable(self.error.key().unwrap_or("here")).to_string();
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(label), span))))
    }
}

/// Tell something on standard error. Nobody may be reading there, and then there is nobody to tell
/// that.
pub fn tell(text: impl std::fmt::Display) {
    let _ = writeln!(std::io::stderr(), "{}", filtered(&text.to_string(), true));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_cannot_steer_the_terminal() {
        assert_eq!(printable("a\u{1b}]0;title\u{7}\u{9b}\tb\n"), "a?]0;title???\tb\n");
    }

    #[test]
    fn what_stands_before_an_error_stays_where_it_is_and_long_lines_end() {
        let text = format!("x = 1\ny = {}\nz = {}", "1".repeat(500), "2".repeat(9));
        let shown = excerpt(&text, 10);
        assert!(shown.starts_with(&text[..10 + SHOWN]));
        assert!(shown.ends_with("111...\nz = 222222222"));
        assert_eq!(excerpt("short\n", 3), "short\n");
    }
}
