//! The columns of a file of joints or bars, by name, and its rows, by what their cells hold.

use std::borrow::Cow;

use super::kind::SystemFileErrorKind as Kind;
use super::rows::{Cell, Rows};
use super::suggest::nearest;
use crate::{Vector, name_of_cell};

/// What is wrong with a row, and in which of the known columns.
pub(super) type Wrong = (Option<&'static str>, Kind);

/// What is wrong in a file, and where.
pub(super) struct Fault {
    /// The row, from 1; 0 is the head.
    pub(super) row: usize,
    /// Number of the column in the file, and its name.
    pub(super) column: Option<(usize, String)>,
    pub(super) kind: Kind,
}

/// Columns that a file may have, and those that it must have with what they hold.
pub(super) struct Known {
    pub(super) columns: &'static [&'static str],
    pub(super) needed: &'static [(&'static str, &'static str)],
}

/// Takes in a file whose columns are known.
pub(super) struct RowTable<'t> {
    known: &'static Known,
    /// Where each of the known columns stands in the file.
    places: Vec<Option<usize>>,
    rows: usize,
    take: &'t mut dyn FnMut(&Row<'_>) -> Result<(), Wrong>,
    fault: Option<Fault>,
}

/// A row of a file, whose number and cells are known.
pub(super) struct Row<'r> {
    /// From 1.
    pub(super) number: usize,
    known: &'static Known,
    places: &'r [Option<usize>],
    cells: &'r [Cell<'r>],
}

impl<'t> RowTable<'t> {
    pub(super) fn new(
        known: &'static Known,
        take: &'t mut dyn FnMut(&Row<'_>) -> Result<(), Wrong>,
    ) -> Self {
        let places = vec![None; known.columns.len()];
        Self { known, places, rows: 0, take, fault: None }
    }

    /// What was wrong, or that there was nothing at all.
    pub(super) fn finish(self) -> Option<Fault> {
        let nothing = || Fault { row: 0, column: None, kind: Kind::NoRows };
        self.fault.or_else(|| (self.rows == 0).then(nothing))
    }

    /// Where a known column stands in the file.
    fn place(&self, column: &str) -> Option<(usize, String)> {
        let place = place(self.known, &self.places, column)?;
        Some((place, column.to_owned()))
    }

    fn fail(&mut self, row: usize, column: Option<(usize, String)>, kind: Kind) -> bool {
        self.fault = Some(Fault { row, column, kind });
        false
    }
}

impl Rows for RowTable<'_> {
    fn names(&mut self, names: &[&str]) -> bool {
        let Known { columns, needed } = self.known;
        // An empty file has one name, which is empty.
        let names = if *names == [""] { &[] } else { names };
        for (k, name) in names.iter().enumerate() {
            let here = Some((k, (*name).to_owned()));
            match columns.iter().position(|known| known == name) {
                None => {
                    let (key, suggestion) = ((*name).to_owned(), nearest(name, columns));
                    return self.fail(
                        0,
                        here,
                        Kind::UnknownKey { key, allowed: columns, suggestion },
                    );
                }
                Some(known) => {
                    if self.places[known].replace(k).is_some() {
                        return self.fail(0, here, Kind::DuplicateColumn(columns[known]));
                    }
                }
            }
        }
        let missing = needed.iter().find(|(key, _)| self.place(key).is_none());
        match missing {
            Some((key, wanted)) => self.fail(0, None, Kind::MissingKey { key, wanted }),
            None => true,
        }
    }

    fn row(&mut self, cells: &[Cell<'_>]) -> bool {
        self.rows += 1;
        let number = self.rows;
        let row = Row { number, known: self.known, places: &self.places, cells };
        match (self.take)(&row) {
            Ok(()) => true,
            Err((column, kind)) => {
                let column = column.and_then(|column| self.place(column));
                self.fail(number, column, kind)
            }
        }
    }
}

fn place(known: &Known, places: &[Option<usize>], column: &str) -> Option<usize> {
    let column = known.columns.iter().position(|name| *name == column)?;
    places[column]
}

impl Row<'_> {
    fn cell(&self, column: &str) -> Cell<'_> {
        let place = place(self.known, self.places, column);
        place.and_then(|place| self.cells.get(place).copied()).unwrap_or(Cell::Nothing)
    }

    /// Whether the file has this column.
    pub(super) fn has(&self, column: &str) -> bool {
        place(self.known, self.places, column).is_some()
    }

    /// A number, if there is one.
    pub(super) fn number(&self, column: &'static str) -> Result<Option<f64>, Wrong> {
        match self.cell(column) {
            Cell::Nothing => Ok(None),
            Cell::Number(number) => Ok(Some(number)),
            Cell::Text(text) => match text.parse() {
                Ok(number) => Ok(Some(number)),
                Err(_) => Err((Some(column), Kind::NotANumber(text.to_owned()))),
            },
        }
    }

    /// A number that must be there.
    pub(super) fn needed(&self, column: &'static str) -> Result<f64, Wrong> {
        self.number(column)?.ok_or((Some(column), Kind::EmptyCell))
    }

    /// Three numbers: all of them, or none.
    pub(super) fn vector(&self, columns: [&'static str; 3]) -> Result<Option<Vector>, Wrong> {
        let [x, y, z] = columns;
        match [self.number(x)?, self.number(y)?, self.number(z)?] {
            [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
            [None, None, None] => Ok(None),
            numbers => {
                let empty = numbers.iter().position(Option::is_none).unwrap_or_default();
                Err((Some(columns[empty]), Kind::EmptyCell))
            }
        }
    }

    /// A name, which may be written as a whole number.
    pub(super) fn name(&self, column: &'static str) -> Result<Cow<'_, str>, Wrong> {
        /// Up to here every whole number is a double of its own.
        const LARGEST: f64 = 9_007_199_254_740_992.0;
        match self.cell(column) {
            Cell::Nothing => Err((Some(column), Kind::EmptyCell)),
            Cell::Text(text) => Ok(Cow::Borrowed(name_of_cell(text))),
            Cell::Number(number) if number.fract() == 0.0 && number.abs() < LARGEST => {
                Ok(Cow::Owned(format!("{number}")))
            }
            Cell::Number(number) => Err((Some(column), Kind::NoName(number))),
        }
    }

    /// A word, if there is one.
    pub(super) fn word(&self, column: &'static str) -> Result<Option<Cow<'_, str>>, Wrong> {
        match self.cell(column) {
            Cell::Nothing => Ok(None),
            _ => self.name(column).map(Some),
        }
    }
}
