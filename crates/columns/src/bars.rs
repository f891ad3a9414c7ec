//! Bars from a Parquet file.

use std::path::Path;

use model::{Bar, BarError};

use crate::cells::{Cells, Holds};
use crate::error::ColumnsError;
use crate::guard::guarded;
use crate::source::Source;

const LENGTH: &str = "length_m";
const MASS: &str = "mass_kg";
const CENTRE: &str = "centre_m";
const COLUMNS: [&str; 3] = [LENGTH, MASS, CENTRE];
const WANTED: &str = "numbers (floating point of 32 or 64 bits, or integers)";

/// Read the bars of a Parquet file: the columns `length_m` and `mass_kg`, and if need be
/// `centre_m`, in any order; a row is a bar, from the start anchor to the end anchor.
///
/// The rules are those of [`model::system_file::columns`]: a missing `centre_m` means half the
/// length, the moments of inertia are those of a homogeneous slender bar, there are at most
/// [`most_bars_of_file`](model::system_file::most_bars_of_file) rows, and a column of another name is an error.
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
    guarded(path, || {
        let source = Source::open(path)?;
        let rows = source.bars()?;
        let columns = check_columns(path, &source)?;
        let mut bars = Vec::with_capacity(rows);
        source.read(|rows, cells| {
            let first = bars.len() as u64 + 1;
            Sheet { path, columns, rows, cells, first }.append_to(&mut bars)?;
            Ok(true)
        })?;
        Ok(bars)
    })
}

/// Where lengths, masses and, if they are there, centres stand among the columns.
type Places = (usize, usize, Option<usize>);

fn check_columns(path: &Path, source: &Source<'_>) -> Result<Places, ColumnsError> {
    let path = || path.to_owned();
    let names: Vec<&str> = source.fields().iter().map(|field| field.name()).collect();
    for (k, name) in names.iter().enumerate() {
        let column = (*name).to_owned();
        if !COLUMNS.contains(name) {
            let allowed = COLUMNS.join(", ");
            return Err(ColumnsError::UnknownColumn { path: path(), column, allowed });
        }
        if names[..k].contains(name) {
            return Err(ColumnsError::DuplicateColumn { path: path(), column });
        }
    }
    source.check_types(WANTED, |holds| matches!(holds, Holds::Numbers | Holds::Counts))?;
    let place = |column| names.iter().position(|name| *name == column);
    let needed = |column, meaning| {
        place(column).ok_or_else(|| ColumnsError::MissingColumn { path: path(), column, meaning })
    };
    let lengths = needed(LENGTH, "lengths in metres")?;
    Ok((lengths, needed(MASS, "masses in kilograms")?, place(CENTRE)))
}

/// Some rows of the file.
struct Sheet<'a> {
    path: &'a Path,
    columns: Places,
    rows: usize,
    cells: &'a [Cells],
    /// The number of its first row.
    first: u64,
}

impl Sheet<'_> {
    fn append_to(&self, bars: &mut Vec<Bar>) -> Result<(), ColumnsError> {
        let (lengths, masses, centres) = self.columns;
        for row in 0..self.rows {
            let length_m = self.there(lengths, row, LENGTH)?;
            let mass_kg = self.there(masses, row, MASS)?;
            let centre_m = centres.and_then(|column| self.cells[column].number(row));
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

    fn there(&self, place: usize, row: usize, column: &'static str) -> Result<f64, ColumnsError> {
        self.cells[place].number(row).ok_or_else(|| ColumnsError::Missing {
            path: self.path.to_owned(),
            row: self.row(row),
            column,
        })
    }
}
