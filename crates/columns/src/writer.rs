//! Tables written in row groups.

use std::path::{Path, PathBuf};

use crate::atomic::AtomicFile;
use crate::csv::CsvWriter;
use crate::error::{ColumnsError, Result};
use crate::parquet::ParquetWriter;
use crate::table::{Data, Kind, Schema};

/// The form of a table on disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Apache Parquet: units and descriptions in the metadata, compressed by gzip.
    Parquet,
    /// Comma-separated values: names in the first line, doubles in the shortest digits that read
    /// back to the same bits.
    Csv,
}

impl Format {
    /// What the names of such files end in.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Parquet => "parquet",
            Self::Csv => "csv",
        }
    }
}

/// Writes a table, a row group at a time, to a file that is whole or not there.
///
/// The same rows in the same groups give the same bytes, on any day and by any number of threads.
///
/// ```
/// use columns::{Column, Data, Format, Kind, Schema, Spread, TableWriter, read_table};
/// let energy = Column::new("energy_j", Kind::F64, Spread::Many, "J", "Energy above joint 0");
/// let schema = Schema { columns: vec![energy], notes: Vec::new() };
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("energies.parquet");
///
/// let mut table = TableWriter::create(&path, Format::Parquet, &schema)?;
/// table.write(vec![Data::F64(vec![-1.5, 0.25])])?;
/// table.finish()?;
///
/// let mut sum = 0.0;
/// read_table(&path, Format::Parquet, &schema, &mut |columns| {
///     if let Data::F64(energies) = &columns[0] {
///         sum += energies.iter().sum::<f64>();
///     }
/// })?;
/// assert_eq!(sum, -1.25);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct TableWriter {
    path: PathBuf,
    schema: Schema,
    output: Output,
}

enum Output {
    Parquet(Box<ParquetWriter>),
    Csv(Box<CsvWriter>),
}

impl TableWriter {
    /// Begin a table.
    ///
    /// # Errors
    ///
    /// [`ColumnsError`] if the file cannot be made.
    pub fn create(path: &Path, format: Format, schema: &Schema) -> Result<Self> {
        let file = AtomicFile::create(path).map_err(|error| ColumnsError::file(path, error))?;
        let output = match format {
            Format::Parquet => Output::Parquet(Box::new(ParquetWriter::new(path, file, schema)?)),
            Format::Csv => Output::Csv(Box::new(CsvWriter::new(path, file, schema)?)),
        };
        Ok(Self { path: path.to_owned(), schema: schema.clone(), output })
    }

    /// Write rows as one row group.
    ///
    /// # Errors
    ///
    /// [`ColumnsError`] if the disk does not take them, or they are not of this table.
    pub fn write(&mut self, columns: Vec<Data>) -> Result<()> {
        let path = || self.path.clone();
        self.schema
            .rows(&columns)
            .map_err(|error| ColumnsError::Mismatch { path: path(), error })?;
        match &mut self.output {
            Output::Parquet(inner) => inner.write(&self.path, columns),
            Output::Csv(inner) => inner.write(&self.path, &columns),
        }
    }

    /// Finish the table: from now on the file is there.
    ///
    /// # Errors
    ///
    /// [`ColumnsError`] if the disk does not take the rest.
    pub fn finish(self) -> Result<()> {
        let file = match self.output {
            Output::Parquet(inner) => inner.finish(&self.path)?,
            Output::Csv(inner) => inner.finish(),
        };
        file.commit().map_err(|error| ColumnsError::file(&self.path, error))
    }
}

/// Read a table of numbers back, some rows at a time.
///
/// # Errors
///
/// [`ColumnsError`] if the file is damaged or its columns are not exactly those of `schema`.
pub fn read_table(
    path: &Path,
    format: Format,
    schema: &Schema,
    each: &mut dyn FnMut(&[Data]),
) -> Result<()> {
    if let Some(text) = schema.columns.iter().find(|column| column.kind == Kind::Utf8) {
        // Nothing that is read back holds text.
        let (column, wanted) = (text.name.clone(), "numbers, to be read back");
        let found = "text".to_owned();
        return Err(ColumnsError::WrongType { path: path.to_owned(), column, wanted, found });
    }
    match format {
        Format::Parquet => crate::parquet::read(path, schema, each),
        Format::Csv => crate::csv::read(path, schema, each),
    }
}

/// The notes of a Parquet table, key by key; what is said of its columns (`NAME.unit`,
/// `NAME.description`) is among them.
///
/// # Errors
///
/// [`ColumnsError`] if the file is no Parquet file.
///
/// ```
/// use columns::{Column, Data, Format, Kind, Schema, Spread, TableWriter, read_notes};
/// let seed = Column::new("seed", Kind::U64, Spread::Rising, "1", "Number of the start");
/// let note = ("sweep.seed_number".to_owned(), "7".to_owned());
/// let schema = Schema { columns: vec![seed], notes: vec![note.clone()] };
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("seeds.parquet");
/// let mut table = TableWriter::create(&path, Format::Parquet, &schema)?;
/// table.write(vec![Data::U64(vec![0, 1, 2])])?;
/// table.finish()?;
/// assert!(read_notes(&path)?.contains(&note));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_notes(path: &Path) -> Result<Vec<(String, String)>> {
    crate::parquet::notes(path)
}
