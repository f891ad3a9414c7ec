//! Texts of JSON as trees of values.

use model::budget::Budget;
use serde_json::Value;

use crate::error::{At, FormatError, Result, Wrong};

/// Memory that a byte of JSON needs as a tree of values, bytes: some 105 by the sizes of the nodes of the
/// tree, of a list of objects with one key of no letters.
const BYTES_PER_BYTE: u64 = 120;

/// The tree of a text.
pub(crate) fn parse(text: &str, file: &str) -> Result<Value> {
    let bytes = (text.len() as u64).saturating_mul(BYTES_PER_BYTE);
    let asked = Budget::default().fits(bytes);
    asked.map_err(|error| At::file(file).memory(error))?;
    serde_json::from_str(text.trim_start_matches('\u{feff}'))
        .map_err(|error| At::line(file, error.line()).error(Wrong::Json(error.to_string())))
}

/// Reads the tree of a file, by its name in errors.
#[derive(Clone, Copy)]
pub(crate) struct Reader<'a> {
    pub at: At<'a>,
}

impl Reader<'_> {
    pub(crate) fn wrong(self, what: &str, wanted: &'static str, found: &Value) -> FormatError {
        self.at.value(what, wanted, &found.to_string())
    }

    pub(crate) fn number(self, what: &str, value: &Value) -> Result<f64> {
        let number = value.as_f64().filter(|x| x.is_finite());
        number.ok_or_else(|| self.wrong(what, "a finite number", value))
    }
}
