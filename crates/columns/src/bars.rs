//! Bars from a Parquet file.

use std::fs::File;
use std::path::Path;

use ::parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ArrowReaderOptions, ParquetRecordBatchReaderBuilder,
};
use ::parquet::basic::CompressionCodec;
use ::parquet::file::FOOTER_SIZE;
use ::parquet::file::metadata::{ParquetMetaData, ParquetMetaDataReader, RowGroupMetaData};
use arrow_array::types::{
    ArrowPrimitiveType, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type,
    UInt8Type, UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrayRef, RecordBatch, cast::AsArray};
use arrow_schema::DataType;
use model::system_file::most_bars;
use model::{Bar, BarError};

use crate::error::ColumnsError;
use crate::guard::guarded;

const LENGTH: &str = "length_m";
const MASS: &str = "mass_kg";
const CENTRE: &str = "centre_m";
const COLUMNS: [&str; 3] = [LENGTH, MASS, CENTRE];
const WANTED: &str = "numbers (floating point of 32 or 64 bits, or integers)";

/// The compressions that the features of the `parquet` crate in our `Cargo.toml` are for.
const COMPRESSIONS: &str = "Snappy, Zstandard, LZ4 and no compression";

/// Rows decoded at a time: three columns of them stay in the second-level cache.
pub const BATCH_ROWS: usize = 1 << 14;

/// Read the bars of a Parquet file: the columns `length_m` and `mass_kg`, and if need be
/// `centre_m`, in any order; a row is a bar, from the start anchor to the end anchor.
///
/// The rules are those of [`model::system_file::columns`]: a missing `centre_m` means half the
/// length, the moments of inertia are those of a homogeneous slender bar, there are at most
/// [`most_bars`](model::system_file::most_bars) rows, and a column of another name is an error.
/// Numbers may be floating point or whole, of any width; pages may be plain or compressed by
/// Snappy, Zstandard or LZ4.
///
/// # Errors
///
/// [`ColumnsError`] with the file and, where there is one, the row and the column.
///
/// ```no_run
/// let bars = columns::read_bars("bars.parquet")?;
/// println!("{} bars", bars.len());
/// # Ok::<(), columns::ColumnsError>(())
/// ```
pub fn read_bars(path: impl AsRef<Path>) -> Result<Vec<Bar>, ColumnsError> {
    let path = path.as_ref();
    let file = open(path)?;
    guarded(path, || decode(path, file))
}

fn decode(path: &Path, file: File) -> Result<Vec<Bar>, ColumnsError> {
    let metadata = footer(path, &file)?;
    let rows = check_rows(path, &metadata)?;
    check_columns(path, &metadata)?;
    let damaged = |error: &dyn std::fmt::Display| ColumnsError::damaged(path, error);
    let batches = ParquetRecordBatchReaderBuilder::new_with_metadata(file, metadata)
        .with_batch_size(BATCH_ROWS)
        .build()
        .map_err(|error| damaged(&error))?;
    let mut bars = Vec::with_capacity(rows);
    for batch in batches {
        let batch = batch.map_err(|error| damaged(&error))?;
        Sheet { path, batch: &batch, first: bars.len() as u64 + 1 }.append_to(&mut bars)?;
        if bars.len() > rows {
            return Err(damaged(&"there are more rows than the file says"));
        }
    }
    if bars.len() < rows {
        return Err(damaged(&format!("{} rows of {rows} are there", bars.len())));
    }
    Ok(bars)
}

/// Open a regular file with something in it.
pub fn open(path: &Path) -> Result<File, ColumnsError> {
    let io = |error| ColumnsError::file(path, error);
    let file = File::open(path).map_err(io)?;
    let about = file.metadata().map_err(io)?;
    if about.is_dir() {
        return Err(ColumnsError::Folder { path: path.to_owned() });
    }
    if about.len() == 0 {
        return Err(ColumnsError::Empty { path: path.to_owned() });
    }
    Ok(file)
}

/// The description at the end of the file. What a writer says about its own types (`ARROW:schema`)
/// is left aside: the types of the format itself are enough for numbers.
pub fn footer(path: &Path, file: &File) -> Result<ArrowReaderMetadata, ColumnsError> {
    let not = |reason: String| ColumnsError::NotParquet { path: path.to_owned(), reason };
    let length = file.metadata().map_err(|error| ColumnsError::file(path, error))?.len();
    if length < FOOTER_SIZE as u64 {
        return Err(not(format!("{length} bytes are too short for one")));
    }
    let metadata = ParquetMetaDataReader::new()
        .parse_and_finish(file)
        .map_err(|error| not(error.to_string()))?;
    check_compressions(path, &metadata)?;
    let options = ArrowReaderOptions::new().with_skip_arrow_metadata(true);
    ArrowReaderMetadata::try_new(metadata.into(), options)
        .map_err(|error| ColumnsError::damaged(path, &error))
}

/// What cannot be unpacked is not damaged.
fn check_compressions(path: &Path, metadata: &ParquetMetaData) -> Result<(), ColumnsError> {
    use CompressionCodec::{BROTLI, GZIP, LZ4, LZ4_RAW, LZO, SNAPPY, UNCOMPRESSED, ZSTD};
    for column in metadata.row_groups().iter().flat_map(RowGroupMetaData::columns) {
        match column.compression_codec() {
            UNCOMPRESSED | SNAPPY | ZSTD | LZ4 | LZ4_RAW => {}
            found @ (GZIP | BROTLI | LZO) => {
                return Err(ColumnsError::Compression {
                    path: path.to_owned(),
                    column: column.column_path().string(),
                    found: found.to_string(),
                    supported: COMPRESSIONS,
                });
            }
        }
    }
    Ok(())
}

pub fn check_rows(path: &Path, metadata: &ArrowReaderMetadata) -> Result<usize, ColumnsError> {
    let said = metadata.metadata().file_metadata().num_rows();
    let rows =
        u64::try_from(said).map_err(|_| ColumnsError::damaged(path, &format!("{said} rows")))?;
    match usize::try_from(rows) {
        Ok(0) => Err(ColumnsError::NoBars { path: path.to_owned() }),
        Ok(rows) if rows <= most_bars() => Ok(rows),
        _ => Err(ColumnsError::TooManyBars { path: path.to_owned(), rows, limit: most_bars() }),
    }
}

fn check_columns(path: &Path, metadata: &ArrowReaderMetadata) -> Result<(), ColumnsError> {
    let path = || path.to_owned();
    let mut seen = Vec::new();
    for field in metadata.schema().fields() {
        let column = field.name();
        if !COLUMNS.contains(&column.as_str()) {
            let (column, allowed) = (column.clone(), COLUMNS.join(", "));
            return Err(ColumnsError::UnknownColumn { path: path(), column, allowed });
        }
        if seen.contains(&column) {
            return Err(ColumnsError::DuplicateColumn { path: path(), column: column.clone() });
        }
        if !(field.data_type().is_integer() || is_float(field.data_type())) {
            return Err(ColumnsError::WrongType {
                path: path(),
                column: column.clone(),
                wanted: WANTED,
                found: field.data_type().to_string(),
            });
        }
        seen.push(column);
    }
    for (column, meaning) in [(LENGTH, "lengths in metres"), (MASS, "masses in kilograms")] {
        if !seen.iter().any(|name| *name == column) {
            return Err(ColumnsError::MissingColumn { path: path(), column, meaning });
        }
    }
    Ok(())
}

pub fn is_float(kind: &DataType) -> bool {
    matches!(kind, DataType::Float32 | DataType::Float64)
}

/// Some rows of the file.
struct Sheet<'a> {
    path: &'a Path,
    batch: &'a RecordBatch,
    /// The number of its first row.
    first: u64,
}

impl Sheet<'_> {
    fn append_to(&self, bars: &mut Vec<Bar>) -> Result<(), ColumnsError> {
        let column = |name| self.batch.column_by_name(name).map(numbers);
        // Both are there: the columns were checked.
        let (lengths, masses) =
            (column(LENGTH).unwrap_or_default(), column(MASS).unwrap_or_default());
        let centres = column(CENTRE);
        for row in 0..self.batch.num_rows() {
            let length_m = self.there(&lengths, row, LENGTH)?;
            let mass_kg = self.there(&masses, row, MASS)?;
            let centre_m = centres.as_ref().and_then(|column| column.get(row));
            let bar = Bar::given(length_m, mass_kg, centre_m, None).map_err(|error| {
                let column = match error {
                    BarError::Mass { .. } => MASS,
                    BarError::Centre { .. } => CENTRE,
                    // The moments have no column of their own: m l²/12 is too large.
                    _ => LENGTH,
                };
                ColumnsError::Bar { path: self.path.to_owned(), row: self.row(row), column, error }
            })?;
            bars.push(bar);
        }
        Ok(())
    }

    fn row(&self, row: usize) -> u64 {
        self.first + row as u64
    }

    fn there(
        &self,
        numbers: &Numbers,
        row: usize,
        column: &'static str,
    ) -> Result<f64, ColumnsError> {
        numbers.get(row).ok_or_else(|| ColumnsError::Missing {
            path: self.path.to_owned(),
            row: self.row(row),
            column,
        })
    }
}

/// A column as doubles; `there` only if something is missing.
#[derive(Default)]
pub struct Numbers {
    values: Vec<f64>,
    there: Option<Vec<bool>>,
}

impl Numbers {
    pub fn get(&self, row: usize) -> Option<f64> {
        let there = self.there.as_ref().is_none_or(|there| there.get(row).copied() == Some(true));
        self.values.get(row).copied().filter(|_| there)
    }
}

#[expect(clippy::cast_precision_loss, reason = "a length or a mass is the double nearest to it")]
pub fn numbers(array: &ArrayRef) -> Numbers {
    let values = match array.data_type() {
        DataType::Float64 => array.as_primitive::<Float64Type>().values().to_vec(),
        DataType::Float32 => converted::<Float32Type>(array, f64::from),
        DataType::Int8 => converted::<Int8Type>(array, f64::from),
        DataType::Int16 => converted::<Int16Type>(array, f64::from),
        DataType::Int32 => converted::<Int32Type>(array, f64::from),
        DataType::Int64 => converted::<Int64Type>(array, |x| x as f64),
        DataType::UInt8 => converted::<UInt8Type>(array, f64::from),
        DataType::UInt16 => converted::<UInt16Type>(array, f64::from),
        DataType::UInt32 => converted::<UInt32Type>(array, f64::from),
        DataType::UInt64 => converted::<UInt64Type>(array, |x| x as f64),
        // The columns were checked.
        _ => Vec::new(),
    };
    let there =
        array.nulls().filter(|nulls| nulls.null_count() > 0).map(|nulls| nulls.iter().collect());
    Numbers { values, there }
}

fn converted<T: ArrowPrimitiveType>(array: &ArrayRef, to: impl Fn(T::Native) -> f64) -> Vec<f64> {
    array.as_primitive::<T>().values().iter().map(|&x| to(x)).collect()
}
