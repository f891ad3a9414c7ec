//! Rows of a Parquet file for whoever knows what its columns mean: joints, bars between them.

use std::path::Path;

use model::system_file::{Cell, Rows};

use crate::cells::Cells;
use crate::error::{ColumnsError, Result};
use crate::guard::guarded;
use crate::source::Source;

const WANTED: &str = "numbers (floating point of 32 or 64 bits, or integers), text, or booleans";

/// Hand the rows of a Parquet file to `rows`, which knows what the columns mean; a cell without a
/// value is [`Cell::Nothing`], a boolean the number 1 or 0.
///
/// # Errors
///
/// [`ColumnsError`] with the file. What `rows` refuses is for it to tell: reading ends there.
pub fn read_rows(path: impl AsRef<Path>, rows: &mut dyn Rows) -> Result<()> {
    let path = path.as_ref();
    guarded(path, || {
        let source = Source::open(path)?;
        source.check_rows()?;
        source.check_types(WANTED)?;
        let names: Vec<&str> = source.fields().iter().map(|field| field.name()).collect();
        if !rows.names(&names) {
            return Ok(());
        }
        let mut number = 0;
        source.read(|rows_here, columns| {
            let mut cells = Vec::with_capacity(columns.len());
            for row in 0..rows_here {
                number += 1;
                cells.clear();
                for (column, name) in columns.iter().zip(&names) {
                    cells.push(cell(column, row).ok_or_else(|| {
                        let reason = format!("row {number}, column `{name}`: text is not UTF-8");
                        ColumnsError::damaged(path, &reason)
                    })?);
                }
                if !rows.row(&cells) {
                    return Ok(false);
                }
            }
            Ok(true)
        })
    })
}

/// A cell; `None` if it is text that cannot be read.
fn cell(column: &Cells, row: usize) -> Option<Cell<'_>> {
    match column.text(row) {
        Some([]) => Some(Cell::Nothing),
        Some(text) => std::str::from_utf8(text).ok().map(Cell::Text),
        None => Some(column.number(row).map_or(Cell::Nothing, Cell::Number)),
    }
}
