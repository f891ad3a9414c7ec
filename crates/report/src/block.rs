//! What a report is made of: the same blocks become Markdown and HTML.

use model::number::Number;
use paper::equations::EquationAudit;
use paper::sentence::Sentence;

use crate::badge::Badge;
use crate::cell::Cell;
use crate::equations::Judged;
use crate::figures::Figure;
use crate::symbols::signs;

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
    /// Pictures with colours of their own, on white.
    Sheet(Figure),
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
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// What it shows.
    pub caption: String,
    /// Names of the columns.
    pub head: Vec<&'static str>,
    /// As many cells each as the head has.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table with these rows; the names of its columns stand between bars.
    pub(crate) fn new(caption: &str, head: &'static str, rows: Vec<Vec<Cell>>) -> Self {
        Self { caption: caption.to_owned(), head: head.split('|').collect(), rows }
    }
}

/// A heading.
pub(crate) fn heading<'a>(level: u8, id: &str, text: &str) -> Block<'a> {
    Block::Heading(level, id.to_owned(), text.to_owned())
}

/// A paragraph.
pub(crate) fn text<'a>(text: impl Into<String>) -> Block<'a> {
    Block::Text(text.into())
}

/// A residual of the audit, or a count.
pub fn residual(row: &EquationAudit, value: f64) -> Number {
    /// Significant digits of a residual.
    const DIGITS: usize = 4;
    if row.counts { Number::count(value) } else { Number::significant(value, DIGITS) }
}

/// What an audited row says in cells: what, measured, as printed, as corrected, verdict.
pub fn audit_cells(row: &EquationAudit) -> [Cell; 5] {
    let corrected = row.as_corrected.map(|value| {
        let number = residual(row, value);
        if row.corrected.is_empty() {
            Cell::number(number)
        } else {
            let form = signs(row.corrected);
            Sentence::from([number.into(), ": ".into(), form.into()]).into()
        }
    });
    [
        signs(row.what).into(),
        signs(row.measure).into(),
        residual(row, row.as_printed).into(),
        corrected.unwrap_or(Cell::Nothing),
        Badge::of_row(row).into(),
    ]
}

/// The head of a table of statements, and its rows.
pub(crate) fn statements(audit: &[&EquationAudit]) -> Table {
    let row = |row: &&EquationAudit| {
        [Cell::from(row.number)].into_iter().chain(audit_cells(row)).collect()
    };
    Table::new(
        "Statements of the text between the equations.",
        "where|what it says, or what is wrong|measured|as printed|as corrected|verdict",
        audit.iter().map(row).collect(),
    )
}
