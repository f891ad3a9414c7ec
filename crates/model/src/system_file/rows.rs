//! Rows of a file of columns, on their way from whoever reads the file to whoever knows what they
//! mean.

use std::error::Error;
use std::path::Path;

/// A cell of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell<'a> {
    /// It is empty.
    Nothing,
    /// A number.
    Number(f64),
    /// Text, which may be that of a number.
    Text(&'a str),
}

/// Takes in a file of columns: the names of the columns once, then row by row.
///
/// Both say whether they want to go on; if not, something was wrong, which is told to whoever asked
/// for the file.
pub trait Rows {
    /// The names of the columns, in order.
    fn names(&mut self, names: &[&str]) -> bool;

    /// A row: a cell for each column.
    fn row(&mut self, cells: &[Cell<'_>]) -> bool;
}

/// Reads the rows of a file of another kind than CSV, for [`read_with`](super::read_with): `None`
/// if it does not know this kind.
pub type RowsReader<'a> =
    &'a dyn Fn(&Path, &mut dyn Rows) -> Option<Result<(), Box<dyn Error + Send + Sync>>>;
