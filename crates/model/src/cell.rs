//! Names in cells of CSV, which programs of tables take for formulas where they begin like one.

use std::borrow::Cow;

/// What a formula begins with.
const FORMULA: [char; 4] = ['=', '+', '-', '@'];

/// What tells such programs that a cell is text. It stands before names that begin like a formula, and
/// before those that would be taken for one of these.
const TEXT: char = '\'';

/// A name as a cell has it: text for every program. Numbers need no such care.
///
/// ```
/// use model::{name_of_cell, text_cell};
/// assert_eq!(text_cell("=1+2"), "'=1+2");
/// assert_eq!(text_cell("lamp"), "lamp");
/// for name in ["=1+2", "-", "'=", "'", "lamp", ""] {
///     assert_eq!(name_of_cell(&text_cell(name)), name);
/// }
/// ```
pub fn text_cell(name: &str) -> Cow<'_, str> {
    if begins_like_formula(name) { format!("{TEXT}{name}").into() } else { name.into() }
}

/// The name that a cell has: the inverse of [`text_cell`].
pub fn name_of_cell(cell: &str) -> &str {
    cell.strip_prefix(TEXT).filter(|name| begins_like_formula(name)).unwrap_or(cell)
}

fn begins_like_formula(name: &str) -> bool {
    name.trim_start_matches(TEXT).starts_with(FORMULA)
}
