use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use ::parquet::basic::{
    Compression, Encoding, GzipLevel, LogicalType, Repetition, Type as Physical,
};
use ::parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int32Type, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::{EnabledStatistics, WriterProperties};
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::{ColumnPath, Type, TypePtr};

use crate::atomic::AtomicFile;
use crate::cells::{Cells, Values, type_of};
use crate::error::{ColumnsError, Result};
use crate::guard::guarded;
use crate::source::Source;
use crate::table::{Column, Data, Kind, Schema, Spread};

/// What the files say wrote them. Without a version: the same rows and notes give the same bytes
/// after an update of this crate, as long as the encoders do. Who writes a table may note a version
/// (a sweep does: `funicular.program`).
const CREATED_BY: &str = "funicular";

/// Largest dictionary of a column of few values, bytes; one that grows beyond it goes on as plain
/// numbers.
const DICTIONARY: usize = 1 << 16;

/// Level of gzip: see CONTRIBUTING for sizes and times.
const LEVEL: u32 = 2;

/// Rows of one page: enough for the compressor, little enough to read some rows without all.
const PAGE_ROWS: usize = 1 << 16;

pub struct ParquetWriter {
    writer: SerializedFileWriter<AtomicFile>,
}

impl ParquetWriter {
    pub fn new(path: &Path, file: AtomicFile, schema: &Schema) -> Result<Self> {
        fields(schema)
            .and_then(|fields| Type::group_type_builder("table").with_fields(fields).build())
            .and_then(|root| {
                SerializedFileWriter::new(file, Arc::new(root), Arc::new(properties(schema)))
            })
            .map(|writer| Self { writer })
            .map_err(|error| write_error(path, error))
    }

    pub fn write(&mut self, path: &Path, columns: Vec<Data>) -> Result<()> {
        if columns.first().is_none_or(Data::is_empty) {
            return Ok(());
        }
        self.write_group(columns).map_err(|error| write_error(path, error))
    }

    fn write_group(&mut self, columns: Vec<Data>) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for data in columns {
            // There are as many as in the schema.
            let Some(mut column) = group.next_column()? else { break };
            write_cells(&mut column, data)?;
            column.close()?;
        }
        group.close().map(|_| ())
    }

    pub fn finish(self, path: &Path) -> Result<AtomicFile> {
        // Writes the description at the end of the file, too.
        let mut file = self.writer.into_inner().map_err(|error| write_error(path, error))?;
        file.flush().map_err(|error| ColumnsError::file(path, error))?;
        Ok(file)
    }
}

fn write_cells(column: &mut SerializedColumnWriter<'_>, data: Data) -> Result<usize, ParquetError> {
    fn whole<T: Into<i32>>(cells: Vec<T>) -> Vec<i32> {
        cells.into_iter().map(Into::into).collect()
    }
    match data {
        Data::F64(cells) => column.typed::<DoubleType>().write_batch(&cells, None, None),
        Data::U64(cells) => {
            let cells: Vec<i64> = cells.into_iter().map(u64::cast_signed).collect();
            column.typed::<Int64Type>().write_batch(&cells, None, None)
        }
        Data::I16(cells) => column.typed::<Int32Type>().write_batch(&whole(cells), None, None),
        Data::U16(cells) => column.typed::<Int32Type>().write_batch(&whole(cells), None, None),
        Data::Utf8(cells) => {
            let cells: Vec<ByteArray> =
                cells.into_iter().map(|text| text.into_bytes().into()).collect();
            column.typed::<ByteArrayType>().write_batch(&cells, None, None)
        }
    }
}

/// The encoder wraps the error of the disk; it is the disk's all the same.
fn write_error(path: &Path, error: ParquetError) -> ColumnsError {
    let error = match error {
        ParquetError::External(cause) => {
            cause.downcast::<std::io::Error>().map_or_else(std::io::Error::other, |error| *error)
        }
        error => std::io::Error::other(error),
    };
    ColumnsError::file(path, error)
}

fn properties(schema: &Schema) -> WriterProperties {
    let level = GzipLevel::try_new(LEVEL).unwrap_or_default();
    let notes = schema.notes.iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone()));
    let notes = notes.chain(schema.columns.iter().flat_map(about));
    let mut builder = WriterProperties::builder()
        .set_created_by(CREATED_BY.to_owned())
        .set_compression(Compression::GZIP(level))
        .set_dictionary_enabled(false)
        .set_dictionary_page_size_limit(DICTIONARY)
        .set_data_page_row_count_limit(PAGE_ROWS)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_key_value_metadata(Some(notes.collect()));
    for column in &schema.columns {
        let path = ColumnPath::from(column.name.as_str());
        builder = match (column.spread, column.kind) {
            (Spread::Few, _) | (_, Kind::Utf8) => builder.set_column_dictionary_enabled(path, true),
            (Spread::Rising, Kind::U64 | Kind::U16 | Kind::I16) => {
                builder.set_column_encoding(path, Encoding::DELTA_BINARY_PACKED)
            }
            // Signs and exponents are alike even where digits are not.
            _ => builder.set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT),
        };
    }
    builder.build()
}

fn about(column: &Column) -> [KeyValue; 2] {
    let note = |key, value: &String| KeyValue::new(format!("{}.{key}", column.name), value.clone());
    [note("unit", &column.unit), note("description", &column.description)]
}

/// The columns as the format has them.
fn fields(schema: &Schema) -> Result<Vec<TypePtr>, ParquetError> {
    let field = |column: &Column| {
        let (physical, meaning) = match column.kind {
            Kind::U64 => (Physical::INT64, Some(LogicalType::integer(64, false))),
            Kind::I16 => (Physical::INT32, Some(LogicalType::integer(16, true))),
            Kind::U16 => (Physical::INT32, Some(LogicalType::integer(16, false))),
            Kind::F64 => (Physical::DOUBLE, None),
            Kind::Utf8 => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(&column.name, physical);
        field.with_repetition(Repetition::REQUIRED).with_logical_type(meaning).build().map(Arc::new)
    };
    schema.columns.iter().map(field).collect()
}

/// Cells of a column that was checked to be of this kind; `None` if a number is too large for it.
fn data(kind: Kind, cells: &Cells) -> Option<Data> {
    fn narrow<T: TryFrom<i32>>(cells: &[i32]) -> Option<Vec<T>> {
        cells.iter().map(|cell| T::try_from(*cell).ok()).collect()
    }
    match (kind, &cells.values) {
        (Kind::F64, Values::F64(values)) => Some(Data::F64(values.cells.clone())),
        (Kind::U64, Values::I64(values)) => {
            Some(Data::U64(values.cells.iter().map(|cell| cell.cast_unsigned()).collect()))
        }
        (Kind::I16, Values::I32(values)) => narrow(&values.cells).map(Data::I16),
        (Kind::U16, Values::I32(values)) => narrow(&values.cells).map(Data::U16),
        _ => None,
    }
}

/// The notes kept with a table, in order, and behind them what is said of its columns.
pub fn notes(path: &Path) -> Result<Vec<(String, String)>> {
    guarded(path, || {
        let source = Source::open(path)?;
        let pairs = source.metadata.file_metadata().key_value_metadata();
        let pair = |pair: &KeyValue| (pair.key.clone(), pair.value.clone().unwrap_or_default());
        Ok(pairs.into_iter().flatten().map(pair).collect())
    })
}

pub fn read(path: &Path, schema: &Schema, each: &mut dyn FnMut(&[Data])) -> Result<()> {
    guarded(path, || {
        let source = Source::open(path)?;
        if !fields(schema).is_ok_and(|fields| fields == source.fields()) {
            let found = source.fields().iter();
            let found = found.map(|field| format!("{} ({})", field.name(), type_of(field)));
            return Err(ColumnsError::other_columns(path, schema, found.collect()));
        }
        source.read(|_, cells| {
            let columns = schema.columns.iter().zip(cells);
            let columns = columns.map(|(column, cells)| {
                let wrong = || format!("column `{}` holds what it should not", column.name);
                data(column.kind, cells).ok_or_else(|| ColumnsError::damaged(path, &wrong()))
            });
            each(&columns.collect::<Result<Vec<_>, _>>()?);
            Ok(true)
        })
    })
}
