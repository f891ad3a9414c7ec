//! Rows of a Parquet file for whoever knows what its columns mean: joints, bars between them.

use std::fs::File;
use std::path::Path;

use ::parquet::arrow::arrow_reader::{ArrowReaderMetadata, ParquetRecordBatchReaderBuilder};
use arrow_array::{Array, ArrayRef, BooleanArray, LargeStringArray, StringArray, cast::AsArray};
use arrow_schema::DataType;
use model::system_file::{Cell, Rows};

use crate::bars::{BATCH_ROWS, Numbers, check_rows, footer, is_float, numbers, open};
use crate::error::ColumnsError;
use crate::guard::guarded;

const WANTED: &str = "numbers (floating point of 32 or 64 bits, or integers), text, or booleans";

/// Hand the rows of a Parquet file to `rows`, which knows what the columns mean; a cell without a
/// value is [`Cell::Nothing`], a boolean the number 1 or 0.
///
/// # Errors
///
/// [`ColumnsError`] with the file. What `rows` refuses is for it to tell: reading ends there.
pub fn read_rows(path: impl AsRef<Path>, rows: &mut dyn Rows) -> Result<(), ColumnsError> {
    let path = path.as_ref();
    let file = open(path)?;
    guarded(path, || hand_over(path, file, rows))
}

fn hand_over(path: &Path, file: File, rows: &mut dyn Rows) -> Result<(), ColumnsError> {
    let metadata = footer(path, &file)?;
    check_rows(path, &metadata)?;
    check_types(path, &metadata)?;
    let names: Vec<String> =
        metadata.schema().fields().iter().map(|field| field.name().clone()).collect();
    let damaged = |error: &dyn std::fmt::Display| ColumnsError::damaged(path, error);
    let batches = ParquetRecordBatchReaderBuilder::new_with_metadata(file, metadata)
        .with_batch_size(BATCH_ROWS)
        .build()
        .map_err(|error| damaged(&error))?;
    if !rows.names(&names.iter().map(String::as_str).collect::<Vec<_>>()) {
        return Ok(());
    }
    for batch in batches {
        let batch = batch.map_err(|error| damaged(&error))?;
        let columns: Vec<Cells<'_>> = batch.columns().iter().map(Cells::of).collect();
        let mut cells = Vec::with_capacity(columns.len());
        for row in 0..batch.num_rows() {
            cells.clear();
            cells.extend(columns.iter().map(|column| column.cell(row)));
            if !rows.row(&cells) {
                return Ok(());
            }
        }
    }
    Ok(())
}

fn check_types(path: &Path, metadata: &ArrowReaderMetadata) -> Result<(), ColumnsError> {
    for field in metadata.schema().fields() {
        let kind = field.data_type();
        let text = matches!(kind, DataType::Utf8 | DataType::LargeUtf8 | DataType::Boolean);
        if !(text || kind.is_integer() || is_float(kind)) {
            return Err(ColumnsError::WrongType {
                path: path.to_owned(),
                column: field.name().clone(),
                wanted: WANTED,
                found: kind.to_string(),
            });
        }
    }
    Ok(())
}

/// A column of a batch.
enum Cells<'a> {
    Numbers(Numbers),
    Text(&'a StringArray),
    LargeText(&'a LargeStringArray),
    Booleans(&'a BooleanArray),
}

impl<'a> Cells<'a> {
    fn of(array: &'a ArrayRef) -> Self {
        match array.data_type() {
            DataType::Utf8 => Self::Text(array.as_string()),
            DataType::LargeUtf8 => Self::LargeText(array.as_string()),
            DataType::Boolean => Self::Booleans(array.as_boolean()),
            _ => Self::Numbers(numbers(array)),
        }
    }

    fn cell(&self, row: usize) -> Cell<'a> {
        let text = |text: &'a str| if text.is_empty() { Cell::Nothing } else { Cell::Text(text) };
        match self {
            Self::Numbers(numbers) => numbers.get(row).map_or(Cell::Nothing, Cell::Number),
            Self::Text(array) if array.is_valid(row) => text(array.value(row)),
            Self::LargeText(array) if array.is_valid(row) => text(array.value(row)),
            Self::Booleans(array) if array.is_valid(row) => {
                Cell::Number(if array.value(row) { 1.0 } else { 0.0 })
            }
            Self::Text(_) | Self::LargeText(_) | Self::Booleans(_) => Cell::Nothing,
        }
    }
}
