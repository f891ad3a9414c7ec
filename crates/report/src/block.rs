//! What a report is made of: the same blocks become Markdown and HTML.

use paper::equations::EquationAudit;

use crate::equations::Judged;
use crate::figures::Figure;
use crate::numbers::signs;

/// A piece of the report. Texts may hold `code`, **strong** and links `[text](#anchor)`.
#[derive(Debug, Clone)]
pub enum Block<'a> {
    /// A heading: level from 1, name of its anchor, text.
    Heading(u8, String, String),
    /// A paragraph.
    Text(String),
    /// Items.
    List(Vec<String>),
    /// A table.
    Table(Table),
    /// A numbered equation with its verdict.
    Equation(Judged<'a>),
    /// Rows of the audit that belong to no numbered equation.
    Statements(Vec<&'a EquationAudit>),
    /// Pictures: drawn in HTML, in Markdown their caption alone.
    Figure(Figure),
    /// A piece of HTML of its own, and what Markdown says instead.
    Slot {
        /// HTML.
        html: String,
        /// Text.
        instead: String,
    },
    /// Text as it is, in this language.
    Code(&'static str, String),
}

/// A table. The first column names the row.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Table {
    /// What it shows.
    pub caption: String,
    /// Names of the columns.
    pub head: Vec<&'static str>,
    /// As many cells each as the head has.
    pub rows: Vec<Vec<String>>,
    /// Column whose cells are verdicts, if any.
    pub verdicts: Option<usize>,
}

/// A heading.
pub(crate) fn heading<'a>(level: u8, id: &str, text: &str) -> Block<'a> {
    Block::Heading(level, id.to_owned(), text.to_owned())
}

/// A paragraph.
pub(crate) fn text<'a>(text: impl Into<String>) -> Block<'a> {
    Block::Text(text.into())
}

/// What an audited row says in cells: what, measured, as printed, as corrected, verdict.
#[must_use]
pub fn audit_cells(row: &EquationAudit) -> [String; 5] {
    let number = |x: f64| {
        if row.counts { crate::numbers::counted(x) } else { crate::numbers::measured(x, 4) }
    };
    [
        signs(row.what),
        signs(row.measure),
        number(row.as_printed),
        match (row.as_corrected, row.corrected) {
            (None, _) => "-".to_owned(),
            (Some(value), "") => number(value),
            (Some(value), form) => format!("{}: {}", number(value), signs(form)),
        },
        crate::equations::verdict_word(row.verdict).to_owned(),
    ]
}
