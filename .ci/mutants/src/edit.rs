//! Text put into a source at several places at once.

use crate::{Position, Span};

/// The byte at which each line begins.
pub struct Lines<'a> {
    source: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    pub fn new(source: &'a str) -> Self {
        let starts =
            std::iter::once(0).chain(source.match_indices('\n').map(|(at, _)| at + 1)).collect();
        Self { source, starts }
    }

    /// The byte of a position.
    pub fn byte(&self, at: Position) -> usize {
        let start = self.starts[at.line - 1];
        self.source[start..]
            .char_indices()
            .nth(at.column - 1)
            .map_or(self.source.len(), |(offset, _)| start + offset)
    }

    pub fn text(&self, span: Span) -> &'a str {
        &self.source[self.byte(span.start)..self.byte(span.end)]
    }
}

/// Insertions before and behind pieces of a source, the outer ones outside.
#[derive(Default)]
pub struct Insertions(Vec<(usize, bool, usize, String)>);

impl Insertions {
    /// `before` and `behind` around the bytes from `start` to `end`.
    pub fn around(&mut self, start: usize, end: usize, before: String, behind: &str) {
        self.0.push((start, true, usize::MAX - (end - start), before));
        self.0.push((end, false, end - start, behind.to_owned()));
    }

    /// `text` at one place, outside of all that begins there.
    pub fn at(&mut self, place: usize, text: String) {
        self.0.push((place, true, 0, text));
    }

    /// `text` behind all that ends at a place.
    pub fn behind(&mut self, place: usize, text: String) {
        self.0.push((place, false, usize::MAX, text));
    }

    pub fn applied(mut self, source: &str) -> String {
        // What ends at a place comes before what begins there.
        self.0.sort_by_key(|(place, begins, rank, _)| (*place, *begins, *rank));
        let mut text = String::with_capacity(2 * source.len());
        let mut from = 0;
        for (place, _, _, inserted) in self.0 {
            text.push_str(&source[from..place]);
            text.push_str(&inserted);
            from = place;
        }
        text.push_str(&source[from..]);
        text
    }
}
