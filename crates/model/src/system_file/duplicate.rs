//! Where a key that is given twice was given first.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::location::Position;

/// A key that appears a second time: its name, and where it was first where that is certain.
pub(super) struct Duplicate {
    pub(super) name: String,
    /// Path and line of the first appearance.
    pub(super) first: Option<(String, usize)>,
}

/// Look for the first appearance of the key at `span`. The text before the line of the second is
/// good TOML, or the parser would have complained of that.
pub(super) fn find(text: &str, span: Range<usize>) -> Duplicate {
    let name = text.get(span.clone()).unwrap_or_default().trim_matches(['"', '\'']).to_owned();
    let first = start_of_line(text, span.start).and_then(|start| {
        let before = &text[..start];
        let tree = DeTable::parse(before).ok()?;
        let mut search = Search { text: before, name: &name, latest: None };
        search.table(tree.get_ref(), "");
        let (offset, path) = search.latest?;
        Some((path, Position::of(text, offset)?.line))
    });
    Duplicate { name, first }
}

/// Start of the line, if the key is the first thing in it. Keys in inline tables and the later
/// parts of dotted keys are not, and several of the same name may stand in one line.
fn start_of_line(text: &str, offset: usize) -> Option<usize> {
    let before = text.get(..offset)?;
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    before[start..].chars().all(|c| c.is_whitespace() || c == '[').then_some(start)
}

/// The last key of this name that is the first thing in its line: no table ends before its second
/// appearance, so that this is the first one in the same table.
struct Search<'a> {
    text: &'a str,
    name: &'a str,
    latest: Option<(usize, String)>,
}

impl Search<'_> {
    fn table(&mut self, table: &DeTable<'_>, path: &str) {
        for (key, value) in table {
            let place = key.span().start;
            let dot = if path.is_empty() { "" } else { "." };
            let path = format!("{path}{dot}{}", key.get_ref());
            if key.get_ref() == self.name && start_of_line(self.text, place).is_some() {
                let later = self.latest.as_ref().is_none_or(|(latest, _)| *latest < place);
                if later {
                    self.latest = Some((place, path.clone()));
                }
            }
            self.value(value, &path);
        }
    }

    fn value(&mut self, value: &Spanned<DeValue<'_>>, path: &str) {
        match value.get_ref() {
            DeValue::Table(table) => self.table(table, path),
            DeValue::Array(items) => {
                for (k, item) in items.iter().enumerate() {
                    self.value(item, &format!("{path}[{}]", k + 1));
                }
            }
            _ => {}
        }
    }
}
