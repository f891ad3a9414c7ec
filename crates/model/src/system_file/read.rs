//! Reading: a walk over the spanned TOML tree, so that every error knows its place.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::error::{SystemFileError, SystemFileErrorKind as Kind};
use crate::{
    Anchors, Bar, BarError, Chain, ChainError, Problem, Refusal, STANDARD_GRAVITY_M_S2, Vector,
};

/// Longest system file, bytes: a hundred thousand bars written one by one need a tenth of it.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

/// Most bars of one system: what an answer over so many joints still leaves of 24 GB of memory.
pub const MAX_BARS: usize = 20_000_000;

const ROOT_KEYS: &[&str] = &["name", "gravity_m_s2", "anchors", "bars"];
const ANCHOR_KEYS: &[&str] = &["start_m", "end_m"];
const BAR_KEYS: &[&str] = &["length_m", "mass_kg", "centre_m", "inertia_kg_m2", "count"];

/// Read a system file.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason.
pub fn read_system(path: impl AsRef<Path>) -> Result<Chain, SystemFileError> {
    load(path.as_ref()).and_then(|(file, text)| parse_system(&text, &file))
}

/// Read a system file that describes an equilibrium problem.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason; a [`Refusal`] points at the numbers it rests on.
pub fn read_problem(path: impl AsRef<Path>) -> Result<Problem, SystemFileError> {
    load(path.as_ref()).and_then(|(file, text)| parse_problem(&text, &file))
}

/// Parse the text of a system file; `file` is its name in errors.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason.
pub fn parse_system(text: &str, file: &str) -> Result<Chain, SystemFileError> {
    let source = Source { file, text };
    source.system().map(|(chain, _)| chain)
}

/// Parse the text of a system file that describes an equilibrium problem.
///
/// # Errors
///
/// [`SystemFileError`] with the place and the reason.
pub fn parse_problem(text: &str, file: &str) -> Result<Problem, SystemFileError> {
    let source = Source { file, text };
    let (chain, places) = source.system()?;
    Problem::new(chain).map_err(|refusal| {
        let (key, span) = match refusal {
            Refusal::SingleBar { .. } | Refusal::NoMass => {
                ("bars".to_owned(), places.bars[0].1.clone())
            }
            Refusal::OutOfReach { .. } | Refusal::Taut { .. } => {
                ("anchors.end_m".to_owned(), places.end.clone())
            }
            Refusal::BarTooLong { bar, .. } | Refusal::Folded { bar, .. } => {
                let table = places.bars.partition_point(|(first, _)| *first <= bar);
                (format!("bars[{table}].length_m"), places.bars[table - 1].1.clone())
            }
        };
        source.error(Kind::Refused(refusal), Some(key), Some(span))
    })
}

/// Read the whole file as text.
fn load(path: &Path) -> Result<(String, String), SystemFileError> {
    let file = path.display().to_string();
    let failed = |kind| SystemFileError::new(&file, "", None, None, kind);
    let metadata = std::fs::metadata(path).map_err(|e| failed(Kind::Unreadable(e)))?;
    if metadata.len() > MAX_FILE_BYTES {
        return Err(failed(Kind::TooLong { bytes: metadata.len(), limit: MAX_FILE_BYTES }));
    }
    let bytes = std::fs::read(path).map_err(|e| failed(Kind::Unreadable(e)))?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok((file, text)),
        Err(error) => Err(failed(Kind::NotText { offset: error.utf8_error().valid_up_to() })),
    }
}

/// Where things stand, for the errors that come after parsing.
struct Places {
    end: Range<usize>,
    /// For every `[[bars]]` table: the number of its first bar, from 1, and the span of its length.
    bars: Vec<(usize, Range<usize>)>,
}

struct Source<'a> {
    file: &'a str,
    text: &'a str,
}

impl Source<'_> {
    fn error(
        &self,
        kind: Kind,
        key: Option<String>,
        span: Option<Range<usize>>,
    ) -> SystemFileError {
        SystemFileError::new(self.file, self.text, span, key, kind)
    }

    fn system(&self) -> Result<(Chain, Places), SystemFileError> {
        let root = DeTable::parse(self.text).map_err(|error| {
            self.error(Kind::Syntax(error.message().to_owned()), None, error.span())
        })?;
        let whole = root.span();
        let root = root.get_ref();
        if root.is_empty() {
            return Err(self.error(Kind::Empty, None, None));
        }
        let top = Table { source: self, path: String::new(), entries: root, span: whole };
        top.only(ROOT_KEYS)?;
        let name = match top.get("name") {
            None => "unnamed",
            Some(value) => {
                value.get_ref().as_str().ok_or_else(|| top.wrong_type("name", value, "a string"))?
            }
        };
        let gravity = top.number("gravity_m_s2")?.unwrap_or(STANDARD_GRAVITY_M_S2);

        let anchors = top.require("anchors", "a table with start_m and end_m")?;
        let anchors = top.table("anchors", anchors)?;
        anchors.only(ANCHOR_KEYS)?;
        let wanted = "three coordinates in metres, [x, y, z]";
        let end_value = anchors.require("end_m", wanted)?;
        let start_m = anchors.vector("start_m", anchors.require("start_m", wanted)?)?;
        let end_m = anchors.vector("end_m", end_value)?;

        let wanted = "one or more tables [[bars]] with length_m and mass_kg";
        let value = top.require("bars", wanted)?;
        let tables =
            value.get_ref().as_array().ok_or_else(|| top.wrong_type("bars", value, wanted))?;
        let (bars, places) = self.bars(&top, tables)?;
        let places = Places { end: end_value.span(), bars: places };

        let chain =
            Chain::new(name, gravity, Anchors { start_m, end_m }, bars).map_err(|error| {
                let (key, span) = match error {
                    ChainError::Gravity { .. } => {
                        ("gravity_m_s2", top.get("gravity_m_s2").map(Spanned::span))
                    }
                    ChainError::Anchor { coordinate_m } => {
                        let in_start =
                            start_m.iter().any(|x| x.to_bits() == coordinate_m.to_bits());
                        let key = if in_start { "start_m" } else { "end_m" };
                        let path = if in_start { "anchors.start_m" } else { "anchors.end_m" };
                        (path, anchors.get(key).map(Spanned::span))
                    }
                    ChainError::NoBars | ChainError::Overflow { .. } => {
                        ("bars", Some(value.span()))
                    }
                };
                self.error(Kind::Chain(error), Some(key.to_owned()), span)
            })?;
        Ok((chain, places))
    }

    #[expect(clippy::type_complexity, reason = "the bars and where they stand, used in one place")]
    fn bars(
        &self,
        top: &Table<'_>,
        tables: &DeArray<'_>,
    ) -> Result<(Vec<Bar>, Vec<(usize, Range<usize>)>), SystemFileError> {
        let (mut bars, mut places) = (Vec::new(), Vec::new());
        for (k, value) in tables.iter().enumerate() {
            let table = top.table(&format!("bars[{}]", k + 1), value)?;
            table.only(BAR_KEYS)?;
            let length_value = table.require("length_m", "a length in metres")?;
            let length_m = table.number_of("length_m", length_value)?;
            let mass_kg =
                table.number_of("mass_kg", table.require("mass_kg", "a mass in kilograms")?)?;
            let centre_m = table.number("centre_m")?.unwrap_or(0.5 * length_m);
            let inertia = match table.get("inertia_kg_m2") {
                Some(value) => table.vector("inertia_kg_m2", value)?,
                None => Bar::slender_inertia(length_m, mass_kg),
            };
            let bar = Bar::new(length_m, mass_kg, centre_m, inertia).map_err(|error| {
                let key = match error {
                    BarError::Length { .. } => "length_m",
                    BarError::Mass { .. } => "mass_kg",
                    BarError::Centre { .. } => "centre_m",
                    BarError::Inertia { .. } => "inertia_kg_m2",
                };
                let span = table.get(key).map_or(table.span.clone(), Spanned::span);
                self.error(Kind::Bar(error), Some(table.key(key)), Some(span))
            })?;
            let count = table.count()?;
            if count > MAX_BARS - bars.len() {
                let span = table.get("count").map_or(table.span.clone(), Spanned::span);
                return Err(self.error(
                    Kind::TooManyBars { limit: MAX_BARS },
                    Some(table.key("count")),
                    Some(span),
                ));
            }
            places.push((bars.len() + 1, length_value.span()));
            bars.resize(bars.len() + count, bar);
        }
        Ok((bars, places))
    }
}

/// One table of the file, with its path in front of its keys.
struct Table<'a> {
    source: &'a Source<'a>,
    path: String,
    entries: &'a DeTable<'a>,
    span: Range<usize>,
}

impl<'a> Table<'a> {
    fn key(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    fn fail<T>(&self, kind: Kind, key: &str, span: Range<usize>) -> Result<T, SystemFileError> {
        Err(self.source.error(kind, Some(self.key(key)), Some(span)))
    }

    fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.entries.get(key)
    }

    /// Refuse keys that are not allowed here: the first in the order of the file.
    fn only(&self, allowed: &'static [&'static str]) -> Result<(), SystemFileError> {
        let unknown = self.entries.keys().filter(|key| !allowed.contains(&key.get_ref().as_ref()));
        match unknown.min_by_key(|key| key.span().start) {
            None => Ok(()),
            Some(key) => {
                let name = key.get_ref().to_string();
                let suggestion = nearest(&name, allowed);
                self.fail(
                    Kind::UnknownKey { key: name.clone(), allowed, suggestion },
                    &name,
                    key.span(),
                )
            }
        }
    }

    fn require(
        &self,
        key: &'static str,
        wanted: &'static str,
    ) -> Result<&'a Spanned<DeValue<'a>>, SystemFileError> {
        match self.get(key) {
            Some(value) => Ok(value),
            None => self.fail(Kind::MissingKey { key, wanted }, key, self.span.clone()),
        }
    }

    fn wrong_type(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        wanted: &'static str,
    ) -> SystemFileError {
        let found = match value.get_ref() {
            DeValue::Array(_) => "an array".to_owned(),
            other => format!("a value of type {}", other.type_str()),
        };
        self.source.error(
            Kind::WrongType { wanted, found },
            Some(self.key(key)),
            Some(value.span()),
        )
    }

    fn table(
        &self,
        key: &str,
        value: &'a Spanned<DeValue<'a>>,
    ) -> Result<Table<'a>, SystemFileError> {
        match value.get_ref().as_table() {
            Some(table) => Ok(Table {
                source: self.source,
                path: self.key(key),
                entries: table,
                span: value.span(),
            }),
            None => Err(self.wrong_type(key, value, "a table")),
        }
    }

    fn number(&self, key: &str) -> Result<Option<f64>, SystemFileError> {
        self.get(key).map(|value| self.number_of(key, value)).transpose()
    }

    /// A number; integers count as numbers. Whether it is finite is for the constructors to say.
    fn number_of(&self, key: &str, value: &Spanned<DeValue<'_>>) -> Result<f64, SystemFileError> {
        let parsed = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
            _ => None,
        };
        parsed.ok_or_else(|| self.wrong_type(key, value, "a number"))
    }

    fn vector(
        &self,
        key: &str,
        value: &'a Spanned<DeValue<'a>>,
    ) -> Result<Vector, SystemFileError> {
        let Some(items) = value.get_ref().as_array() else {
            return Err(self.wrong_type(key, value, "three numbers [x, y, z]"));
        };
        if items.len() != 3 {
            return self.fail(Kind::WrongCount { found: items.len() }, key, value.span());
        }
        let mut vector = [0.0; 3];
        for (slot, item) in vector.iter_mut().zip(items.iter()) {
            *slot = self.number_of(key, item)?;
        }
        Ok(vector)
    }

    /// `count`, or 1.
    fn count(&self) -> Result<usize, SystemFileError> {
        const WANTED: &str = "a whole number of bars, 1 or more";
        let Some(value) = self.get("count") else { return Ok(1) };
        let Some(integer) = value.get_ref().as_integer() else {
            return Err(self.wrong_type("count", value, WANTED));
        };
        let parsed = usize::from_str_radix(integer.as_str(), integer.radix());
        match parsed {
            Ok(count) if count > 0 => Ok(count),
            _ => {
                let found = integer.to_string();
                self.fail(Kind::OutOfRange { found, wanted: WANTED }, "count", value.span())
            }
        }
    }
}

/// The allowed key at the smallest edit distance, if that is small enough to be a slip.
fn nearest(key: &str, allowed: &[&'static str]) -> Option<&'static str> {
    let (distance, best) = allowed.iter().map(|&name| (edits(key, name), name)).min()?;
    // A third of the letters wrong is still a slip; more is another word.
    (3 * distance <= key.chars().count().max(best.len())).then_some(best)
}

/// Levenshtein distance.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut corner = i;
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let change = corner + usize::from(x != *y);
            corner = row[j + 1];
            row[j + 1] = change.min(corner + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
