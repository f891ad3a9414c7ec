use ::parquet::basic::{ConvertedType, LogicalType, Repetition, Type as Physical};
use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use ::parquet::data_type::{
    BoolType, ByteArrayType, DataType, DoubleType, FloatType, Int32Type, Int64Type,
};
use ::parquet::errors::ParquetError;
use ::parquet::schema::types::{ColumnDescPtr, Type};

use crate::budget::Share;
use crate::pages::Pages;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    Numbers,
    /// Whole numbers without a sign.
    Counts,
    Text,
    Booleans,
}

impl Holds {
    /// What is read of a column of this type; `None` if it is not read here.
    pub fn of(field: &Type) -> Option<Self> {
        use ConvertedType::{
            INT_8, INT_16, INT_32, INT_64, JSON, NONE, UINT_8, UINT_16, UINT_32, UINT_64, UTF8,
        };
        let about = field.get_basic_info();
        if !field.is_primitive() || about.repetition() == Repetition::REPEATED {
            return None;
        }
        let meaning = (about.logical_type_ref(), about.converted_type());
        match (field.get_physical_type(), meaning) {
            (Physical::BOOLEAN, (None, NONE)) => Some(Self::Booleans),
            (Physical::FLOAT | Physical::DOUBLE, (None, NONE)) => Some(Self::Numbers),
            (Physical::INT32 | Physical::INT64, meaning) => match meaning {
                (Some(LogicalType::Integer(kind)), _) if kind.is_signed => Some(Self::Numbers),
                (None, NONE | INT_8 | INT_16 | INT_32 | INT_64) => Some(Self::Numbers),
                (Some(LogicalType::Integer(_)), _)
                | (None, UINT_8 | UINT_16 | UINT_32 | UINT_64) => Some(Self::Counts),
                _ => None,
            },
            (
                Physical::BYTE_ARRAY,
                (Some(LogicalType::String | LogicalType::Json), _) | (None, UTF8 | JSON),
            ) => Some(Self::Text),
            _ => None,
        }
    }
}

/// The type of a column in words of the format, for messages.
pub fn type_of(field: &Type) -> String {
    let about = field.get_basic_info();
    if !field.is_primitive() {
        return "a group of columns".to_owned();
    }
    let meaning = match (about.logical_type_ref(), about.converted_type()) {
        (None, ConvertedType::NONE) => String::new(),
        (Some(meaning), ConvertedType::NONE) => format!(" ({meaning:?})"),
        (_, meaning) => format!(" ({meaning})"),
    };
    let list = if about.repetition() == Repetition::REPEATED { "a list of " } else { "" };
    format!("{list}{}{meaning}", field.get_physical_type())
}

/// Some cells of a column.
pub struct Cells {
    holds: Holds,
    /// One for each row, 0 where there is no value; empty if there always is one.
    levels: Vec<i16>,
    pub values: Values,
    /// What text holds that grows as it is decoded; `None` if it is part of a page.
    grown: Option<Share>,
}

/// The values of some rows, by their type in the file.
pub enum Values {
    Booleans(Typed<BoolType>),
    I32(Typed<Int32Type>),
    I64(Typed<Int64Type>),
    F32(Typed<FloatType>),
    F64(Typed<DoubleType>),
    Text(Typed<ByteArrayType>),
}

pub struct Typed<T: DataType> {
    reader: ColumnReaderImpl<T>,
    pub cells: Vec<T::T>,
}

impl Cells {
    /// The cells of a column of a row group; `None` if their type is not read here. `grown` is for
    /// text that is not there as it is in its pages.
    pub fn new(column: ColumnDescPtr, pages: Pages, grown: Option<Share>) -> Option<Self> {
        let holds = Holds::of(column.self_type())?;
        let values = match get_column_reader(column, Box::new(pages)) {
            ColumnReader::BoolColumnReader(reader) => Values::Booleans(Typed::new(reader)),
            ColumnReader::Int32ColumnReader(reader) => Values::I32(Typed::new(reader)),
            ColumnReader::Int64ColumnReader(reader) => Values::I64(Typed::new(reader)),
            ColumnReader::FloatColumnReader(reader) => Values::F32(Typed::new(reader)),
            ColumnReader::DoubleColumnReader(reader) => Values::F64(Typed::new(reader)),
            ColumnReader::ByteArrayColumnReader(reader) => Values::Text(Typed::new(reader)),
            _ => return None,
        };
        Some(Self { holds, levels: Vec::new(), values, grown })
    }

    /// Read the next rows in the place of those that are here; how many there were.
    pub fn read(&mut self, rows: usize) -> Result<usize, ParquetError> {
        self.levels.clear();
        let levels = &mut self.levels;
        match &mut self.values {
            Values::Booleans(values) => values.read(rows, levels),
            Values::I32(values) => values.read(rows, levels),
            Values::I64(values) => values.read(rows, levels),
            Values::F32(values) => values.read(rows, levels),
            Values::F64(values) => values.read(rows, levels),
            Values::Text(values) => match &mut self.grown {
                None => values.read(rows, levels),
                Some(share) => values.read_within(rows, levels, share),
            },
        }
    }

    /// The number of a row, if it has one: the double nearest to it. A boolean is 1 or 0.
    pub fn number(&self, row: usize) -> Option<f64> {
        self.is_there(row).then_some(match (&self.values, self.holds) {
            (Values::F64(values), _) => values.cells[row],
            (Values::F32(values), _) => values.cells[row].into(),
            (Values::I32(values), Holds::Counts) => values.cells[row].cast_unsigned().into(),
            (Values::I32(values), _) => values.cells[row].into(),
            (Values::I64(values), Holds::Counts) => values.cells[row].cast_unsigned() as f64,
            (Values::I64(values), _) => values.cells[row] as f64,
            (Values::Booleans(values), _) => u8::from(values.cells[row]).into(),
            (Values::Text(_), _) => return None,
        })
    }

    /// The text of a row of a column of text; empty if it has no value.
    pub fn text(&self, row: usize) -> Option<&[u8]> {
        let Values::Text(values) = &self.values else { return None };
        Some(if self.is_there(row) { values.cells[row].data() } else { &[] })
    }

    fn is_there(&self, row: usize) -> bool {
        self.levels.get(row) != Some(&0)
    }
}

impl<T: DataType> Typed<T> {
    fn new(reader: ColumnReaderImpl<T>) -> Self {
        Self { reader, cells: Vec::new() }
    }

    fn read(&mut self, rows: usize, levels: &mut Vec<i16>) -> Result<usize, ParquetError> {
        self.cells.clear();
        let (read, ..) = self.reader.read_records(rows, Some(levels), None, &mut self.cells)?;
        self.spread(levels);
        Ok(read)
    }

    /// Values come without gaps: move them to their rows.
    fn spread(&mut self, levels: &[i16]) {
        let mut from = self.cells.len();
        if from == levels.len() || levels.is_empty() {
            return;
        }
        self.cells.resize(levels.len(), T::T::default());
        for (to, level) in levels.iter().enumerate().rev() {
            if *level > 0 && from > 0 {
                from -= 1;
                self.cells.swap(from, to);
            }
        }
    }
}

impl Typed<ByteArrayType> {
    /// Text that shares its beginning with the text before can grow row by row: ask for each.
    fn read_within(
        &mut self,
        rows: usize,
        levels: &mut Vec<i16>,
        share: &mut Share,
    ) -> Result<usize, ParquetError> {
        self.cells.clear();
        *share = share.empty();
        for row in 0..rows {
            let before = self.cells.len();
            let (read, ..) = self.reader.read_records(1, Some(levels), None, &mut self.cells)?;
            if read == 0 {
                self.spread(levels);
                return Ok(row);
            }
            share.take(self.cells[before..].iter().map(|text| text.len() as u64).sum())?;
        }
        self.spread(levels);
        Ok(rows)
    }
}
