//! Parquet files for tests: written by the `parquet` crate, or forged byte by byte.

use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, LogicalType, Repetition};
use parquet::data_type::{DataType, DoubleType};
use parquet::file::metadata::{
    ColumnChunkMetaData, FileMetaData, ParquetMetaDataBuilder, ParquetMetaDataWriter,
    RowGroupMetaData,
};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{ColumnPath, SchemaDescriptor, Type, TypePtr};

/// A column with gaps, to be written.
pub struct Cells {
    field: TypePtr,
    write: Box<dyn Fn(&mut SerializedColumnWriter<'_>)>,
}

pub fn cells<T: DataType>(
    name: &str,
    meaning: Option<LogicalType>,
    cells: Vec<Option<T::T>>,
) -> Cells {
    let field = Type::primitive_type_builder(name, T::get_physical_type());
    let field = field.with_repetition(Repetition::OPTIONAL).with_logical_type(meaning);
    let write = move |column: &mut SerializedColumnWriter<'_>| {
        let levels: Vec<i16> = cells.iter().map(|cell| i16::from(cell.is_some())).collect();
        let values: Vec<T::T> = cells.iter().flatten().cloned().collect();
        column.typed::<T>().write_batch(&values, Some(&levels), None).unwrap();
    };
    Cells { field: Arc::new(field.build().unwrap()), write: Box::new(write) }
}

pub fn doubles(name: &str, values: impl IntoIterator<Item = f64>) -> Cells {
    cells::<DoubleType>(name, None, values.into_iter().map(Some).collect())
}

fn schema(fields: Vec<TypePtr>) -> TypePtr {
    Arc::new(Type::group_type_builder("table").with_fields(fields).build().unwrap())
}

pub fn write(path: &Path, columns: &[Cells], properties: WriterProperties) {
    let schema = schema(columns.iter().map(|column| column.field.clone()).collect());
    let file = File::create(path).unwrap();
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties)).unwrap();
    let mut group = writer.next_row_group().unwrap();
    for cells in columns {
        let mut column = group.next_column().unwrap().unwrap();
        (cells.write)(&mut column);
        column.close().unwrap();
    }
    group.close().unwrap();
    writer.close().unwrap();
}

/// A column without gaps whose pages are these bytes.
pub struct Forged {
    pub field: Type,
    pub compression: Compression,
    pub encoding: Encoding,
    pub rows: i64,
    pub pages: Vec<u8>,
}

impl Forged {
    /// A file of this column alone.
    pub fn write(&self, path: &Path) {
        const MAGIC: &[u8] = b"PAR1";
        let schema = Arc::new(SchemaDescriptor::new(schema(vec![Arc::new(self.field.clone())])));
        let chunk = ColumnChunkMetaData::builder(schema.column(0))
            .set_compression(self.compression)
            .set_encodings(vec![self.encoding])
            .set_num_values(self.rows)
            .set_data_page_offset(i64::try_from(MAGIC.len()).unwrap())
            .set_total_compressed_size(i64::try_from(self.pages.len()).unwrap())
            .build()
            .unwrap();
        let group = RowGroupMetaData::builder(schema.clone()).set_num_rows(self.rows);
        let group = group.set_column_metadata(vec![chunk]).build().unwrap();
        let about = FileMetaData::new(1, self.rows, None, None, schema, None);
        let metadata = ParquetMetaDataBuilder::new(about).add_row_group(group).build();
        fs::write(path, [MAGIC, &self.pages].concat()).unwrap();
        let file = File::options().append(true).open(path).unwrap();
        ParquetMetaDataWriter::new(file, &metadata).finish().unwrap();
    }
}

/// A page of data, or of a dictionary: its header by Thrift's compact protocol, then its bytes.
pub fn page(dictionary: bool, values: i32, encoding: Encoding, bytes: &[u8]) -> Vec<u8> {
    /// The header of a field of 32 bits whose number is one more than that before.
    const NEXT_I32: u8 = 0x15;
    let levels = Encoding::RLE as i32;
    let size = i32::try_from(bytes.len()).unwrap();
    let (kind, about, fields) = if dictionary {
        (2, 0x4c, vec![values, encoding as i32])
    } else {
        (0, 0x2c, vec![values, encoding as i32, levels, levels])
    };
    let field = |value: i32| {
        let mut field = vec![NEXT_I32];
        field.extend(number((i64::from(value) << 1).cast_unsigned()));
        field
    };
    let mut page: Vec<u8> = [kind, size, size].into_iter().flat_map(field).collect();
    page.push(about);
    page.extend(fields.into_iter().flat_map(field));
    page.extend([0, 0]);
    page.extend(bytes);
    page
}

/// A whole number in groups of seven bits, the lowest first.
pub fn number(mut number: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    loop {
        let group = number.to_le_bytes()[0] & 0x7f;
        number >>= 7;
        if number == 0 {
            bytes.push(group);
            return bytes;
        }
        bytes.push(0x80 | group);
    }
}

/// A string or a number of the files here, written by its encoding.
pub fn encoded(name: &str, encoding: Encoding) -> WriterProperties {
    let path = ColumnPath::from(name);
    let properties = WriterProperties::builder().set_dictionary_enabled(false);
    properties.set_column_encoding(path, encoding).build()
}
