//! One table of a system file: its keys, with their types checked and their places known.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use super::error::{Result, SystemFileError};
use super::kind::{NOT_MODELLED, SystemFileErrorKind as Kind};
use super::source::Source;
use super::suggest::nearest;
use crate::Vector;

/// A value with its place.
pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// One table, with its path in front of its keys.
pub(super) struct Table<'a> {
    source: &'a Source<'a>,
    path: String,
    entries: &'a DeTable<'a>,
    pub(super) span: Range<usize>,
}

impl<'a> Table<'a> {
    /// The table of the whole file.
    pub(super) fn root(source: &'a Source<'a>, entries: &'a DeTable<'a>) -> Self {
        // What is missing from the whole file is missing at its start.
        Self { source, path: String::new(), entries, span: 0..0 }
    }

    /// The text that the table stands in.
    pub(super) fn source(&self) -> &'a Source<'a> {
        self.source
    }

    /// The path of a key of this table.
    pub(super) fn key(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// An error about a key; its place is that of the key's value, or of the table if it has none.
    pub(super) fn error(&self, kind: Kind, key: &str) -> SystemFileError {
        let span = self.get(key).map_or(self.span.clone(), Spanned::span);
        self.error_at(kind, key, span)
    }

    pub(super) fn error_at(&self, kind: Kind, key: &str, span: Range<usize>) -> SystemFileError {
        self.source.error(kind, Some(self.key(key)), Some(span))
    }

    /// An error about the first component of a vector that is not as it should be, or about the
    /// vector.
    pub(super) fn component_error(
        &self,
        kind: Kind,
        key: &str,
        good: impl Fn(f64) -> bool,
    ) -> SystemFileError {
        let items = self.get(key).and_then(|value| value.get_ref().as_array());
        let bad = items.and_then(|items| {
            items.iter().enumerate().find(|(_, item)| !number(item).is_some_and(&good))
        });
        match bad {
            Some((k, item)) => self.error_at(kind, &component(key, k), item.span()),
            None => self.error(kind, key),
        }
    }

    pub(super) fn get(&self, key: &str) -> Option<&'a Value<'a>> {
        self.entries.get(key)
    }

    /// Refuse keys that are not allowed here: the first in the order of the file.
    pub(super) fn only(&self, allowed: &'static [&'static str]) -> Result<()> {
        let unknown = self.entries.keys().filter(|key| !allowed.contains(&key.get_ref().as_ref()));
        match unknown.min_by_key(|key| key.span().start) {
            None => Ok(()),
            Some(key) => {
                let name = key.get_ref().to_string();
                let kind = if NOT_MODELLED.contains(&name.as_str()) {
                    Kind::OutOfScope(name.clone())
                } else {
                    let suggestion = nearest(&name, allowed);
                    Kind::UnknownKey { key: name.clone(), allowed, suggestion }
                };
                Err(self.error_at(kind, &name, key.span()))
            }
        }
    }

    pub(super) fn require(&self, key: &'static str, wanted: &'static str) -> Result<&'a Value<'a>> {
        self.get(key).ok_or_else(|| self.error(Kind::MissingKey { key, wanted }, key))
    }

    pub(super) fn wrong_type(
        &self,
        key: &str,
        value: &Value<'_>,
        wanted: &'static str,
    ) -> SystemFileError {
        let found = match value.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) => "an integer",
            DeValue::Float(_) => "a number with a decimal point",
            DeValue::Boolean(_) => "a boolean",
            DeValue::Datetime(_) => "a date or time",
            DeValue::Array(_) => "an array",
            DeValue::Table(_) => "a table",
        };
        self.error_at(Kind::WrongType { wanted, found }, key, value.span())
    }

    /// The table under a key of this one; `key` may be one of an array of tables, as `bars[2]`.
    pub(super) fn table(&self, key: &str, value: &'a Value<'a>) -> Result<Table<'a>> {
        match value.get_ref().as_table() {
            Some(entries) => {
                Ok(Table { source: self.source, path: self.key(key), entries, span: value.span() })
            }
            None => Err(self.wrong_type(key, value, "a table")),
        }
    }

    /// The tables of an array, if there is one.
    pub(super) fn tables(
        &self,
        key: &str,
        wanted: &'static str,
    ) -> Result<impl Iterator<Item = Result<Table<'a>>>> {
        let items = match self.get(key).map(|value| (value, value.get_ref().as_array())) {
            Some((value, None)) => return Err(self.wrong_type(key, value, wanted)),
            items => items.and_then(|(_, items)| items),
        };
        let numbered = items.into_iter().flatten().enumerate();
        Ok(numbered.map(move |(k, value)| self.table(&format!("{key}[{}]", k + 1), value)))
    }

    pub(super) fn text(&self, key: &str) -> Result<Option<&'a str>> {
        let Some(value) = self.get(key) else { return Ok(None) };
        match value.get_ref().as_str() {
            Some(text) => Ok(Some(text)),
            None => Err(self.wrong_type(key, value, "a string")),
        }
    }

    pub(super) fn boolean(&self, key: &str) -> Result<Option<bool>> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let DeValue::Boolean(is) = value.get_ref() else {
            return Err(self.wrong_type(key, value, "true or false"));
        };
        Ok(Some(*is))
    }

    pub(super) fn number(&self, key: &str) -> Result<Option<f64>> {
        self.get(key).map(|value| self.number_of(key, value)).transpose()
    }

    /// A number; integers count as numbers. Whether it is finite is for the constructors to say.
    pub(super) fn number_of(&self, key: &str, value: &Value<'_>) -> Result<f64> {
        number(value).ok_or_else(|| self.wrong_type(key, value, "a number"))
    }

    pub(super) fn vector(&self, key: &str, value: &'a Value<'a>) -> Result<Vector> {
        let Some(items) = value.get_ref().as_array() else {
            return Err(self.wrong_type(key, value, "three numbers [x, y, z]"));
        };
        if items.len() != 3 {
            return Err(self.error(Kind::WrongCount(items.len()), key));
        }
        let mut vector = [0.0; 3];
        for (k, (slot, item)) in vector.iter_mut().zip(items.iter()).enumerate() {
            *slot = self.number_of(&component(key, k), item)?;
        }
        Ok(vector)
    }

    /// A whole number of at least 1; 1 if the key is not there.
    pub(super) fn count(&self, key: &str) -> Result<usize> {
        match self.get(key) {
            Some(value) => self.count_of(key, value, "a whole number of bars, 1 or more"),
            None => Ok(1),
        }
    }

    /// A whole number of at least 1.
    pub(super) fn count_of(
        &self,
        key: &str,
        value: &Value<'_>,
        wanted: &'static str,
    ) -> Result<usize> {
        let Some(whole) = number(value).filter(|x| x.fract().abs() <= 0.0) else {
            return Err(self.wrong_type(key, value, wanted));
        };
        match whole.to_string().parse() {
            Ok(count) if count > 0 => Ok(count),
            _ => {
                let found = self.source.text[value.span()].to_owned();
                Err(self.error(Kind::OutOfRange { found, wanted }, key))
            }
        }
    }

    /// Refuse a mass below zero and a number that is not finite, at its place.
    pub(super) fn check_load(
        &self,
        mass_kg: Option<f64>,
        force_n: Option<Vector>,
        force_key: &str,
    ) -> Result<()> {
        if mass_kg.is_some_and(|mass| !(mass.is_finite() && mass >= 0.0)) {
            return Err(self.error(Kind::Mass(mass_kg.unwrap_or(f64::NAN)), "mass_kg"));
        }
        if let Some(bad) = force_n.and_then(|force| force.into_iter().find(|x| !x.is_finite())) {
            let kind = Kind::Force(bad);
            return Err(self.component_error(kind, force_key, f64::is_finite));
        }
        Ok(())
    }

    /// The keys with their values, in the order of the file.
    pub(super) fn in_order(&self) -> Vec<(&'a str, &'a Value<'a>)> {
        let entries: &'a DeTable<'a> = self.entries;
        let mut all: Vec<_> = entries.iter().collect();
        all.sort_by_key(|(key, _)| key.span().start);
        all.into_iter().map(|(key, value)| (key.get_ref().as_ref(), value)).collect()
    }
}

/// Component `k` of a vector, counted from 1 like lines and tables.
fn component(key: &str, k: usize) -> String {
    format!("{key}[{}]", k + 1)
}

/// The double nearest to a number as it is written.
fn number(value: &Value<'_>) -> Option<f64> {
    match value.get_ref() {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => whole(integer),
        _ => None,
    }
}

fn whole(integer: &DeInteger<'_>) -> Option<f64> {
    match integer.radix() {
        // As a decimal fraction it may have any number of digits.
        10 => integer.as_str().parse().ok(),
        radix => u128::from_str_radix(integer.as_str(), radix).ok().map(|whole| whole as f64),
    }
}
