//! Tables as Parquet.

use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use ::parquet::arrow::ArrowWriter;
use ::parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use ::parquet::basic::{Compression, Encoding, ZstdLevel};
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::{EnabledStatistics, WriterProperties};
use ::parquet::schema::types::ColumnPath;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int16Type, UInt16Type, UInt64Type};
use arrow_array::{
    Array, ArrayRef, Float64Array, Int16Array, RecordBatch, StringArray, UInt16Array, UInt64Array,
};
use arrow_schema::{DataType, Field, SchemaRef};

use crate::atomic::AtomicFile;
use crate::bars::{BATCH_ROWS, footer, open};
use crate::error::ColumnsError;
use crate::guard::guarded;
use crate::table::{Column, Data, Kind, Schema, Spread};

/// What the files say wrote them. Without a version: the same rows and notes give the same bytes
/// after an update of this crate, as long as the encoders do. Who writes a table may note a version
/// (a sweep does: `funicular.program`).
const CREATED_BY: &str = "funicular";

/// Largest dictionary of a column of few values, bytes; one that grows beyond it goes on as plain
/// numbers.
const DICTIONARY: usize = 1 << 16;

/// Rows of one page: enough for the compressor, little enough to read some rows without all.
const PAGE_ROWS: usize = 1 << 16;

pub struct ParquetWriter {
    schema: SchemaRef,
    writer: ArrowWriter<AtomicFile>,
}

impl ParquetWriter {
    pub fn new(path: &Path, file: AtomicFile, schema: &Schema) -> Result<Self, ColumnsError> {
        let arrow = arrow_schema(schema);
        let writer = ArrowWriter::try_new(file, arrow.clone(), Some(properties(schema)))
            .map_err(|error| write_error(path, error))?;
        Ok(Self { schema: arrow, writer })
    }

    pub fn write(&mut self, path: &Path, columns: Vec<Data>) -> Result<(), ColumnsError> {
        let arrays = columns.into_iter().map(array).collect();
        RecordBatch::try_new(self.schema.clone(), arrays)
            .map_err(Into::into)
            .and_then(|batch| self.writer.write(&batch))
            .and_then(|()| self.writer.flush())
            .map_err(|error| write_error(path, error))
    }

    pub fn finish(self, path: &Path) -> Result<AtomicFile, ColumnsError> {
        // Writes the description at the end of the file, too.
        let mut file = self.writer.into_inner().map_err(|error| write_error(path, error))?;
        file.flush().map_err(|error| ColumnsError::file(path, error))?;
        Ok(file)
    }
}

/// The encoder wraps the error of the disk; it is the disk's all the same.
fn write_error(path: &Path, error: ::parquet::errors::ParquetError) -> ColumnsError {
    let error = match error {
        ::parquet::errors::ParquetError::External(cause) => {
            cause.downcast::<std::io::Error>().map_or_else(std::io::Error::other, |error| *error)
        }
        error => std::io::Error::other(error),
    };
    ColumnsError::file(path, error)
}

fn properties(schema: &Schema) -> WriterProperties {
    let level = ZstdLevel::try_new(1).unwrap_or_default();
    let notes = schema.notes.iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone()));
    let mut builder = WriterProperties::builder()
        .set_created_by(CREATED_BY.to_owned())
        .set_compression(Compression::ZSTD(level))
        .set_dictionary_enabled(false)
        .set_dictionary_page_size_limit(DICTIONARY)
        .set_data_page_row_count_limit(PAGE_ROWS)
        .set_max_row_group_row_count(None)
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

fn arrow_schema(schema: &Schema) -> SchemaRef {
    let fields: Vec<_> = schema.columns.iter().map(field).collect();
    Arc::new(arrow_schema::Schema::new(fields))
}

fn field(column: &Column) -> Field {
    let about = [("unit", &column.unit), ("description", &column.description)];
    Field::new(&column.name, data_type(column.kind), false).with_metadata(
        about
            .into_iter()
            .map(|(key, value)| (key.to_owned(), value.clone()))
            .collect::<std::collections::HashMap<_, _>>(),
    )
}

fn data_type(kind: Kind) -> DataType {
    match kind {
        Kind::U64 => DataType::UInt64,
        Kind::I16 => DataType::Int16,
        Kind::U16 => DataType::UInt16,
        Kind::F64 => DataType::Float64,
        Kind::Utf8 => DataType::Utf8,
    }
}

fn array(data: Data) -> ArrayRef {
    match data {
        Data::U64(cells) => Arc::new(UInt64Array::from(cells)),
        Data::I16(cells) => Arc::new(Int16Array::from(cells)),
        Data::U16(cells) => Arc::new(UInt16Array::from(cells)),
        Data::F64(cells) => Arc::new(Float64Array::from(cells)),
        Data::Utf8(cells) => Arc::new(StringArray::from(cells)),
    }
}

fn data(array: &ArrayRef) -> Option<Data> {
    Some(match array.data_type() {
        _ if array.null_count() > 0 => return None,
        DataType::UInt64 => Data::U64(array.as_primitive::<UInt64Type>().values().to_vec()),
        DataType::Int16 => Data::I16(array.as_primitive::<Int16Type>().values().to_vec()),
        DataType::UInt16 => Data::U16(array.as_primitive::<UInt16Type>().values().to_vec()),
        DataType::Float64 => Data::F64(array.as_primitive::<Float64Type>().values().to_vec()),
        DataType::Utf8 => Data::Utf8(
            array
                .as_string::<i32>()
                .iter()
                .map(|cell| cell.unwrap_or_default().to_owned())
                .collect(),
        ),
        _ => return None,
    })
}

/// The notes kept with a table, in order; what the format itself keeps there too.
pub fn notes(path: &Path) -> Result<Vec<(String, String)>, ColumnsError> {
    let file = open(path)?;
    guarded(path, || {
        let metadata = footer(path, &file)?;
        let pairs = metadata.metadata().file_metadata().key_value_metadata();
        let pair = |pair: &KeyValue| (pair.key.clone(), pair.value.clone().unwrap_or_default());
        Ok(pairs.into_iter().flatten().map(pair).collect())
    })
}

pub fn read(
    path: &Path,
    schema: &Schema,
    each: &mut dyn FnMut(&[Data]),
) -> Result<(), ColumnsError> {
    let file = open(path)?;
    guarded(path, || {
        let metadata = footer(path, &file)?;
        let fields = metadata.schema().fields();
        let same = fields.len() == schema.columns.len()
            && fields.iter().zip(&schema.columns).all(|(field, column)| {
                *field.name() == column.name && *field.data_type() == data_type(column.kind)
            });
        if !same {
            let found =
                fields.iter().map(|field| format!("{} ({})", field.name(), field.data_type()));
            return Err(ColumnsError::other_columns(path, schema, found.collect()));
        }
        let damaged = |error: &dyn std::fmt::Display| ColumnsError::damaged(path, error);
        let batches = ParquetRecordBatchReaderBuilder::new_with_metadata(file, metadata)
            .with_batch_size(BATCH_ROWS)
            .build()
            .map_err(|error| damaged(&error))?;
        for batch in batches {
            let batch = batch.map_err(|error| damaged(&error))?;
            let columns: Option<Vec<_>> = batch.columns().iter().map(data).collect();
            each(&columns.ok_or_else(|| damaged(&"a cell is missing"))?);
        }
        Ok(())
    })
}
