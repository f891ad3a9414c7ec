//! Errors with the line they are about.

use std::fmt;
use std::io::{IsTerminal as _, Write as _};
use std::ops::Range;

use model::system_file::SystemFileError;
use unicode_width::UnicodeWidthStr as _;

use crate::printable::{Printable, filtered};
use crate::tables::wrapped;

/// What is wrong, the line that it is in, and what to do about it.
#[derive(Debug)]
pub struct Diagnostic {
    message: String,
    line: Option<Box<Line>>,
    help: Option<String>,
}

/// A line with a part that is marked.
#[derive(Debug)]
struct Line {
    number: usize,
    before: String,
    marked: String,
    after: String,
    label: String,
}

/// The most characters of a line that are shown before a mark; a mark beyond is told by its place
/// alone.
const BEFORE: usize = 400;

/// The most characters that are shown of a mark, and of what follows it.
const SHOWN: usize = 200;

impl<T: fmt::Display> From<T> for Diagnostic {
    fn from(message: T) -> Self {
        Self { message: message.to_string(), line: None, help: None }
    }
}

impl Diagnostic {
    /// An error in a system file.
    pub fn of_file(error: &SystemFileError) -> Self {
        let label = Printable(error.key().unwrap_or("here")).to_string();
        let span = error.span().filter(|_| error.line().is_some());
        let line = span.and_then(|span| Line::of(error.text(), span, label)).map(Box::new);
        Self { message: error.to_string(), line, help: error.help() }
    }

    /// With what to do about it.
    pub fn with_help(self, help: impl Into<Option<String>>) -> Self {
        Self { help: help.into(), ..self }
    }

    /// With the part of a text that it is about.
    pub fn at(self, text: &str, span: Range<usize>, label: String) -> Self {
        Self { line: Line::of(text, span, label).map(Box::new), ..self }
    }

    /// What is wrong, and what to do about it.
    pub fn words(&self) -> (&str, Option<&str>) {
        (&self.message, self.help.as_deref())
    }

    /// Print it to standard error.
    pub fn print(&self) {
        let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        tell(self.shown(!plain && std::io::stderr().is_terminal()));
    }

    fn shown(&self, colours: bool) -> String {
        let [red, blue, off] =
            if colours { ["\u{1b}[1;31m", "\u{1b}[1;34m", "\u{1b}[0m"] } else { [""; 3] };
        let paragraph = |colour: &str, head: &str, text: &str| {
            // No line of a message begins where a line of the program's own does.
            let text = format!("{head}: {text}").replace('\n', "\n  ");
            let lines: Vec<String> = text.lines().map(|line| wrapped(line, 2)).collect();
            format!("{colour}{head}{off}{}", &lines.join("\n")[head.len()..])
        };
        let mut parts = vec![paragraph(red, "error", &self.message)];
        if let Some(line) = &self.line {
            let Line { number, before, marked, after, label } = line.as_ref();
            let number = number.to_string();
            let gutter = " ".repeat(number.len());
            let indent = " ".repeat(before.width());
            let carets = "^".repeat(marked.width().max(1));
            parts.push(format!(
                "{blue}{gutter} |{off}\n{blue}{number} |{off} {before}{marked}{after}\n\
                 {blue}{gutter} |{off} {indent}{red}{carets} {label}{off}"
            ));
        }
        parts.extend(self.help.as_ref().map(|help| paragraph(blue, "help", help)));
        parts.join("\n")
    }
}

impl Line {
    /// `None` where the mark is too far on in its line.
    fn of(text: &str, span: Range<usize>, label: String) -> Option<Self> {
        let (until, rest) = text.split_at_checked(span.start)?;
        let first = until.rfind('\n').map_or(0, |end| end + 1);
        let rest = rest.lines().next().unwrap_or_default();
        let (marked, after) = rest.split_at_checked(span.len().min(rest.len()))?;
        let before = &until[first..];
        (before.chars().count() <= BEFORE).then(|| Self {
            number: until.matches('\n').count() + 1,
            before: clean(before),
            marked: clean(&cut(marked)),
            after: clean(&cut(after)),
            label,
        })
    }
}

/// A text that is not longer than is good to look at.
fn cut(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => text[..end].to_owned() + "...",
        None => text.to_owned(),
    }
}

/// A part of a line as it is shown: no tabs, and nothing that steers the terminal.
fn clean(text: &str) -> String {
    filtered(&text.replace('\t', "    "), false)
}

/// Tell something on standard error. Nobody may be reading there, and then there is nobody to tell
/// that.
pub fn tell(text: impl fmt::Display) {
    let _ = writeln!(std::io::stderr(), "{}", filtered(&text.to_string(), true));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str, span: Range<usize>) -> String {
        Diagnostic::from("wrong")
            .at(text, span, "here".to_owned())
            .with_help("do".to_owned())
            .shown(false)
    }

    /// Marks stand below what they are about, also behind tabs and wide letters.
    #[test]
    fn the_line_is_shown_and_marked() {
        let wanted = "error: wrong\n  |\n2 | y = 3 # 4\n  |     ^ here\nhelp: do";
        assert_eq!(shown("x = 1\ny = 3 # 4\nz = 5", 10..11), wanted);
        let wanted = "error: wrong\n  |\n1 |     \u{68a1} = 3\n  |          ^ here\nhelp: do";
        assert_eq!(shown("\t\u{68a1} = 3\n", 7..8), wanted);
    }

    #[test]
    fn a_file_cannot_steer_the_terminal() {
        assert!(shown("a\u{1b}]0;title\u{7}\u{9b}b\n", 0..1).contains("| a?]0;title??b\n"));
    }

    #[test]
    fn long_lines_are_cut_and_marks_far_on_are_not_shown() {
        let text = "1".repeat(500);
        let line = format!("| {}{}...\n", "1".repeat(10), "1".repeat(SHOWN));
        assert!(shown(&text, 9..10).contains(&line));
        assert_eq!(shown(&text, 450..451), "error: wrong\nhelp: do");
        assert_eq!(shown("\u{e4}", 1..2), "error: wrong\nhelp: do");
    }

    #[test]
    fn long_messages_are_wrapped() {
        let text = Diagnostic::from("word ".repeat(30)).shown(true);
        assert!(text.starts_with("\u{1b}[1;31merror\u{1b}[0m: word word"));
        assert!(text.lines().all(|line| line.len() <= 80 + 11), "{text}");
        assert_eq!(text.matches("word").count(), 30);
        assert_eq!(Diagnostic::from("a\nerror: b").shown(false), "error: a\n  error: b");
    }
}
