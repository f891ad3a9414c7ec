//! Places in a text, for people.

use std::ops::Range;

/// A place in a text: both numbers from 1, the column in characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Position {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

impl Position {
    /// The place of a byte offset; `None` inside a character. Offsets behind the end are the end.
    pub(super) fn of(text: &str, offset: usize) -> Option<Self> {
        let before = text.get(..offset.min(text.len()))?;
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Some(Self {
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        })
    }
}

/// Where a part of a text stands in it. `part` must be a slice of `text`.
pub(super) fn span_of(text: &str, part: &str) -> Range<usize> {
    let start = part.as_ptr().addr() - text.as_ptr().addr();
    start..start + part.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_from_one_in_characters() {
        let at = |offset| Position::of("\u{e4}b\nc", offset).map(|p| (p.line, p.column));
        assert_eq!(at(0), Some((1, 1)));
        assert_eq!(at(1), None, "inside the umlaut");
        assert_eq!(at(2), Some((1, 2)));
        assert_eq!(at(4), Some((2, 1)));
        assert_eq!(at(5), Some((2, 2)));
        assert_eq!(at(99), Some((2, 2)));
    }

    #[test]
    fn parts_know_their_place() {
        let text = "one,two";
        let cell = text.split(',').nth(1).unwrap_or_default();
        assert_eq!(span_of(text, cell), 4..7);
    }
}
