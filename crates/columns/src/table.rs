//! What a table is: named columns of one type each, with units.

/// The type of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Whole numbers that count: seeds.
    U64,
    /// Small whole numbers with a sign: outcomes.
    I16,
    /// Small whole numbers that count: iterations.
    U16,
    /// Doubles.
    F64,
    /// Text.
    Utf8,
}

/// How the numbers of a column are spread: what its encoding on disk rests on, and never its
/// content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spread {
    /// Each is a little more than the one before.
    Rising,
    /// Few are different.
    Few,
    /// Nearly all are different.
    Many,
}

/// One column of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Its name; a quantity with a unit ends in it (`_m`, `_j`).
    pub name: String,
    /// The type of its cells.
    pub kind: Kind,
    /// How its numbers are spread.
    pub spread: Spread,
    /// The unit, `"1"` for a pure number, empty for text.
    pub unit: String,
    /// What it holds, in a sentence.
    pub description: String,
}

impl Column {
    /// A column.
    pub fn new(name: &str, kind: Kind, spread: Spread, unit: &str, description: &str) -> Self {
        let [name, unit, description] = [name, unit, description].map(str::to_owned);
        Self { name, kind, spread, unit, description }
    }
}

/// The columns of a table, and what there is to say about the whole.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Schema {
    /// The columns, in order.
    pub columns: Vec<Column>,
    /// Keys and values kept with the table (in Parquet; CSV has no place for them).
    pub notes: Vec<(String, String)>,
}

/// Cells of one column.
///
/// ```
/// use columns::{Data, Kind};
/// let mut cells = Data::empty(Kind::F64);
/// cells.append(&mut Data::F64(vec![1.5, -2.0]));
/// // Cells of another type are left alone.
/// cells.append(&mut Data::U16(vec![3]));
/// assert_eq!((cells.kind(), cells.len()), (Kind::F64, 2));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Of a [`Kind::U64`] column.
    U64(Vec<u64>),
    /// Of a [`Kind::I16`] column.
    I16(Vec<i16>),
    /// Of a [`Kind::U16`] column.
    U16(Vec<u16>),
    /// Of a [`Kind::F64`] column.
    F64(Vec<f64>),
    /// Of a [`Kind::Utf8`] column.
    Utf8(Vec<String>),
}

impl Data {
    /// No cells of a column of this type.
    pub fn empty(kind: Kind) -> Self {
        match kind {
            Kind::U64 => Self::U64(Vec::new()),
            Kind::I16 => Self::I16(Vec::new()),
            Kind::U16 => Self::U16(Vec::new()),
            Kind::F64 => Self::F64(Vec::new()),
            Kind::Utf8 => Self::Utf8(Vec::new()),
        }
    }

    /// The type of the column they belong to.
    pub fn kind(&self) -> Kind {
        match self {
            Self::U64(_) => Kind::U64,
            Self::I16(_) => Kind::I16,
            Self::U16(_) => Kind::U16,
            Self::F64(_) => Kind::F64,
            Self::Utf8(_) => Kind::Utf8,
        }
    }

    /// How many cells.
    pub fn len(&self) -> usize {
        match self {
            Self::U64(cells) => cells.len(),
            Self::I16(cells) => cells.len(),
            Self::U16(cells) => cells.len(),
            Self::F64(cells) => cells.len(),
            Self::Utf8(cells) => cells.len(),
        }
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Append the cells of another run of the same column; those of another type are left alone.
    pub fn append(&mut self, other: &mut Self) {
        match (self, other) {
            (Self::U64(a), Self::U64(b)) => a.append(b),
            (Self::I16(a), Self::I16(b)) => a.append(b),
            (Self::U16(a), Self::U16(b)) => a.append(b),
            (Self::F64(a), Self::F64(b)) => a.append(b),
            (Self::Utf8(a), Self::Utf8(b)) => a.append(b),
            _ => {}
        }
    }
}

impl Schema {
    /// How many rows these columns hold.
    /// What is wrong with them, if they are not the columns of this schema or not all of one
    /// length.
    pub(crate) fn rows(&self, data: &[Data]) -> Result<usize, Mismatch> {
        if data.len() != self.columns.len() {
            return Err(Mismatch::Count { wanted: self.columns.len(), found: data.len() });
        }
        let rows = data.first().map_or(0, Data::len);
        for (column, cells) in self.columns.iter().zip(data) {
            if cells.kind() != column.kind || cells.len() != rows {
                return Err(Mismatch::Column { column: column.name.clone() });
            }
        }
        Ok(rows)
    }
}

/// How columns do not fit a schema.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum Mismatch {
    /// Occurs when there are more or fewer columns.
    #[error("{wanted} columns are wanted, and {found} given")]
    Count { wanted: usize, found: usize },
    /// Occurs when a column has another type or another length than it should.
    #[error("column `{column}` has another type or another length than it should")]
    Column { column: String },
}
