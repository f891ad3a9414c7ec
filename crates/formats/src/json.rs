//! Texts of JSON as trees of values.

use model::budget::Budget;
use serde_json::Value;

use crate::error::{FormatError, Wrong};

/// Memory that a byte of JSON needs as a tree of values, bytes: some 105 by the sizes of the nodes of the
/// tree, of a list of objects with one key of no letters.
const BYTES_PER_BYTE: u64 = 120;

/// The tree of a text.
pub(crate) fn parse(text: &str, file: &str) -> Result<Value, FormatError> {
    let bytes = (text.len() as u64).saturating_mul(BYTES_PER_BYTE);
    let asked = Budget::default().fits(bytes);
    asked.map_err(|error| FormatError::new(file, None, Wrong::Memory(error)))?;
    serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(|error| {
        FormatError::new(file, Some(error.line()), Wrong::Json { reason: error.to_string() })
    })
}
