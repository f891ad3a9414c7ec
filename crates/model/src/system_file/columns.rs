//! Bars as columns: a text of comma-separated values, for chains of a million different bars.
//!
//! ```text
//! length_m,mass_kg,centre_m
//! 1.0,2.0,0.25
//! 0.5,1e-3,
//! ```
//!
//! The first line names the columns, in any order: `length_m` and `mass_kg`, and if need be
//! `centre_m` (an empty cell: half the length). Every line after it is a bar, from the start anchor
//! to the end anchor; the moments of inertia are those of a homogeneous slender bar. Blanks around
//! a cell and empty lines at the end do not count; a line that is empty, or a comment, before the
//! end is an error, so that bar *k* is always in line *k* + 1. Cells are plain numbers: quotes are
//! refused.

use std::path::Path;

use super::error::SystemFileError;
use super::kind::SystemFileErrorKind as Kind;
use super::limits::{most_bars_file_bytes, most_bars_of_file};
use super::load::{Loaded, load, without_mark};
use super::location::span_of;
use super::suggest::nearest;
use crate::{Bar, BarError};

pub(super) const COLUMNS: &[&str] = &["length_m", "mass_kg", "centre_m"];
const WANTED_LENGTH: &str = "a column of lengths in metres";

/// Read a bars file.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason; its key is the column.
pub fn read_bars(path: impl AsRef<Path>) -> Result<Vec<Bar>, SystemFileError> {
    let path = path.as_ref();
    let loaded = load(path, most_bars_file_bytes()).map_err(|error| {
        let file = path.display().to_string();
        SystemFileError::new(&file, "", None, None, Kind::Unreadable(error))
    })??;
    Sheet::of(&loaded).bars()
}

/// Parse the text of a bars file; `file` is its name in errors.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason; its key is the column.
///
/// ```
/// use model::system_file::columns::parse_bars;
/// let bars = parse_bars("length_m,mass_kg,centre_m\n1.0,2.0,0.25\n0.5,1e-3,\n", "bars.csv")?;
/// assert_eq!(bars[0].centre_m(), 0.25);
/// assert_eq!(bars[1], model::Bar::homogeneous(0.5, 1e-3).unwrap());
///
/// let error = parse_bars("length_m,mass_kg\n1.0,2.0\n0.5,-1\n", "bars.csv").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "bars.csv:3:5: mass_kg: the mass of a bar must be zero or positive, and finite, got -1 kg"
/// );
/// # Ok::<(), model::system_file::SystemFileError>(())
/// ```
pub fn parse_bars(text: &str, file: &str) -> Result<Vec<Bar>, SystemFileError> {
    Sheet { file, text: without_mark(text) }.bars()
}

/// The text of a bars file with its name.
pub(super) struct Sheet<'a> {
    file: &'a str,
    text: &'a str,
}

/// Which cell of a row is which.
struct Header {
    cells: usize,
    length: usize,
    mass: usize,
    centre: Option<usize>,
}

impl<'a> Sheet<'a> {
    pub(super) fn of(loaded: &'a Loaded) -> Self {
        Self { file: &loaded.file, text: without_mark(&loaded.text) }
    }

    pub(super) fn bars(&self) -> Result<Vec<Bar>, SystemFileError> {
        let mut lines = self.lines();
        let header = self.header(lines.next().unwrap_or(&self.text[..0]))?;
        // Rows are of like length: the first tells how many there may be.
        let row = lines.clone().next().map_or(1, |line| line.len() + 1);
        let mut bars = Vec::with_capacity((self.text.len() / row).min(most_bars_of_file()));
        for line in lines {
            if bars.len() == most_bars_of_file() {
                return Err(self.error(
                    Kind::TooManyBars { limit: most_bars_of_file() },
                    None,
                    line,
                ));
            }
            bars.push(self.bar(line, &header)?);
        }
        if bars.is_empty() {
            return Err(self.error(Kind::NoRows, None, &self.text[..0]));
        }
        Ok(bars)
    }

    /// An error about the length of a bar, counted from 1.
    pub(super) fn length_error(&self, kind: Kind, bar: usize) -> SystemFileError {
        let line = self.lines().nth(bar).unwrap_or(&self.text[..0]);
        let header = self.lines().next().and_then(|line| self.header(line).ok());
        let cell = header.and_then(|header| line.split(',').nth(header.length));
        self.error(kind, Some("length_m"), cell.unwrap_or(line))
    }

    /// Lines without their ends, up to the last that is not blank.
    fn lines(&self) -> impl Iterator<Item = &'a str> + Clone {
        let text = self.text.trim_end();
        text.split('\n').map(|line| line.strip_suffix('\r').unwrap_or(line))
    }

    fn error(&self, kind: Kind, key: Option<&str>, part: &str) -> SystemFileError {
        let part = part.trim();
        let span = span_of(self.text, part);
        SystemFileError::new(self.file, self.text, Some(span), key.map(str::to_owned), kind)
    }

    fn header(&self, line: &str) -> Result<Header, SystemFileError> {
        let missing = |key, wanted| self.error(Kind::MissingKey { key, wanted }, Some(key), line);
        if line.trim().is_empty() {
            return Err(missing("length_m", WANTED_LENGTH));
        }
        let mut places = [None; COLUMNS.len()];
        let mut cells = 0;
        for (k, cell) in line.split(',').enumerate() {
            let name = cell.trim();
            cells = k + 1;
            let fail = |kind| Err(self.error(kind, Some(name).filter(|n| !n.is_empty()), cell));
            if let Some(column) = COLUMNS.iter().position(|known| *known == name) {
                if places[column].replace(k).is_some() {
                    return fail(Kind::DuplicateColumn { column: COLUMNS[column] });
                }
            } else if let Some(found) = name.chars().find(|c| matches!(c, ';' | '\t' | '|')) {
                return Err(self.error(Kind::Separator { found }, None, line));
            } else if name.contains('"') {
                return fail(Kind::Quoted);
            } else {
                let suggestion = nearest(name, COLUMNS);
                return fail(Kind::UnknownKey {
                    key: name.to_owned(),
                    allowed: COLUMNS,
                    suggestion,
                });
            }
        }
        Ok(Header {
            cells,
            length: places[0].ok_or_else(|| missing("length_m", WANTED_LENGTH))?,
            mass: places[1].ok_or_else(|| missing("mass_kg", "a column of masses in kilograms"))?,
            centre: places[2],
        })
    }

    fn bar(&self, line: &str, header: &Header) -> Result<Bar, SystemFileError> {
        let mut cells = [""; COLUMNS.len()];
        let mut found = 0;
        for cell in line.split(',') {
            if let Some(slot) = cells.get_mut(found) {
                *slot = cell;
            }
            found += 1;
        }
        if found != header.cells {
            let found = if line.trim().is_empty() { 0 } else { found };
            let kind = Kind::WrongCells { wanted: header.cells, found };
            let kind = if line.contains('"') { Kind::Quoted } else { kind };
            return Err(self.error(kind, None, line));
        }
        let length_m = self.number("length_m", cells[header.length])?;
        let mass_kg = self.number("mass_kg", cells[header.mass])?;
        let centre = header.centre.map(|k| cells[k]).filter(|cell| !cell.trim().is_empty());
        let centre_m = centre.map(|cell| self.number("centre_m", cell)).transpose()?;
        Bar::given(length_m, mass_kg, centre_m, None).map_err(|error| {
            let (key, part) = match error {
                BarError::Length { .. } => ("length_m", cells[header.length]),
                BarError::Mass { .. } => ("mass_kg", cells[header.mass]),
                BarError::Centre { .. } => ("centre_m", centre.unwrap_or(line)),
                // Without a column of its own: m l²/12 is too large.
                BarError::Inertia { .. } => ("length_m", line),
            };
            self.error(Kind::Bar(error), Some(key), part)
        })
    }

    fn number(&self, key: &str, cell: &str) -> Result<f64, SystemFileError> {
        let text = cell.trim();
        text.parse().map_err(|_| {
            let kind = if text.contains('"') {
                Kind::Quoted
            } else {
                Kind::NotANumber { found: text.to_owned() }
            };
            self.error(kind, Some(key), cell)
        })
    }
}
