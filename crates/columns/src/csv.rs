//! Tables as comma-separated values.
//!
//! The first line names the columns; doubles have the fewest digits that read back to the same
//! bits, and are `NaN`, `inf` or `-inf` where they are no numbers. Text with a comma, a quote or a
//! line end stands in quotes, as RFC 4180 has it.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufRead, BufReader, Write as _};
use std::path::Path;

use crate::atomic::AtomicFile;
use crate::error::{ColumnsError, Result};
use crate::source::open;
use crate::table::{Data, Schema};

/// Rows read at a time.
const BATCH_ROWS: usize = 1 << 14;

/// Longest line that is read, bytes: far more than our columns need, little enough to hold.
const MAX_LINE: u64 = 1 << 20;

pub struct CsvWriter {
    file: AtomicFile,
    text: String,
}

impl CsvWriter {
    pub fn new(path: &Path, mut file: AtomicFile, schema: &Schema) -> Result<Self> {
        writeln!(file, "{}", header(schema)).map_err(|error| ColumnsError::file(path, error))?;
        Ok(Self { file, text: String::new() })
    }

    pub fn write(&mut self, path: &Path, columns: &[Data]) -> Result<()> {
        self.text.clear();
        for row in 0..columns.first().map_or(0, Data::len) {
            for (k, column) in columns.iter().enumerate() {
                if k > 0 {
                    self.text.push(',');
                }
                cell(&mut self.text, column, row);
            }
            self.text.push('\n');
        }
        self.file.write_all(self.text.as_bytes()).map_err(|error| ColumnsError::file(path, error))
    }

    pub fn finish(self) -> AtomicFile {
        self.file
    }
}

fn header(schema: &Schema) -> String {
    let names: Vec<_> = schema.columns.iter().map(|column| quoted(&column.name)).collect();
    names.join(",")
}

/// A text, in quotes where it has to be (RFC 4180).
fn quoted(text: &str) -> Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\"")).into()
    } else {
        text.into()
    }
}

fn cell(text: &mut String, column: &Data, row: usize) {
    // Writing to a String cannot fail.
    let _ = match column {
        Data::U64(cells) => write!(text, "{}", cells[row]),
        Data::I16(cells) => write!(text, "{}", cells[row]),
        Data::U16(cells) => write!(text, "{}", cells[row]),
        Data::F64(cells) => write!(text, "{:?}", cells[row]),
        Data::Utf8(cells) => write!(text, "{}", quoted(&cells[row])),
    };
}

pub fn read(path: &Path, schema: &Schema, each: &mut dyn FnMut(&[Data])) -> Result<()> {
    let mut lines = Lines { path, file: BufReader::new(open(path)?), line: String::new(), row: 0 };
    let names = lines.next()?.unwrap_or_default().to_owned();
    if names != header(schema) {
        let found = names.split(',').map(str::to_owned).collect();
        return Err(ColumnsError::other_columns(path, schema, found));
    }
    let empty = || schema.columns.iter().map(|column| Data::empty(column.kind)).collect();
    let mut batch: Vec<Data> = empty();
    let mut rows = 0;
    while lines.next()?.is_some() {
        lines.append_to(&mut batch, schema)?;
        rows += 1;
        if rows == BATCH_ROWS {
            each(&batch);
            batch = empty();
            rows = 0;
        }
    }
    if rows > 0 {
        each(&batch);
    }
    Ok(())
}

struct Lines<'a> {
    path: &'a Path,
    file: BufReader<File>,
    line: String,
    /// Rows read, the names not counted.
    row: u64,
}

impl Lines<'_> {
    /// The next line without its end; a last line without one was cut off.
    fn next(&mut self) -> Result<Option<&str>> {
        self.line.clear();
        let mut reader = std::io::Read::take(&mut self.file, MAX_LINE);
        let read = reader.read_line(&mut self.line);
        if read.map_err(|error| ColumnsError::file(self.path, error))? == 0 {
            return Ok(None);
        }
        if !self.line.ends_with('\n') {
            return Err(ColumnsError::damaged(self.path, "the last line is cut off"));
        }
        self.row += 1;
        Ok(Some(self.line.trim_end_matches('\n')))
    }

    fn append_to(&self, batch: &mut [Data], schema: &Schema) -> Result<()> {
        let line = self.line.trim_end_matches('\n');
        let mut cells = line.split(',');
        for (data, column) in batch.iter_mut().zip(&schema.columns) {
            let bad = || {
                let row = self.row - 1;
                ColumnsError::damaged(self.path, &format!("row {row}, column `{}`", column.name))
            };
            let cell = cells.next().ok_or_else(bad)?;
            match data {
                Data::U64(cells) => cells.push(cell.parse().map_err(|_| bad())?),
                Data::I16(cells) => cells.push(cell.parse().map_err(|_| bad())?),
                Data::U16(cells) => cells.push(cell.parse().map_err(|_| bad())?),
                Data::F64(cells) => cells.push(cell.parse().map_err(|_| bad())?),
                Data::Utf8(cells) => cells.push(cell.to_owned()),
            }
        }
        if cells.next().is_some() {
            let reason = format!("row {} has too many cells", self.row - 1);
            return Err(ColumnsError::damaged(self.path, &reason));
        }
        Ok(())
    }
}
