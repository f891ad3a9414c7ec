//! The tables that are built into the program, read key by key: code that is derived for each of
//! them takes long to compile.

use toml::{Table, Value};

/// A whole file.
///
/// # Panics
/// On what is no TOML.
pub fn parsed(file: &str) -> Table {
    file.parse().expect("what is built in is TOML")
}

/// The value of a key, as `read` has it.
///
/// # Panics
/// Without the key, and on a value that `read` refuses; a test reads all that is built in.
pub fn key<'a, T>(table: &'a Table, key: &str, read: fn(&'a Value) -> Option<T>) -> T {
    optional(table, key, read).unwrap_or_else(|| panic!("there is no {key}"))
}

/// The value of a key that may be left out.
///
/// # Panics
/// On a value that `read` refuses.
pub fn optional<'a, T>(table: &'a Table, key: &str, read: fn(&'a Value) -> Option<T>) -> Option<T> {
    let value = table.get(key)?;
    Some(read(value).unwrap_or_else(|| panic!("{key} is not to be {value}")))
}

/// A number; a whole one may be written without a point.
pub fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// The numbers of several keys, as by [`key`].
pub fn numbers<const N: usize>(table: &Table, keys: [&str; N]) -> [f64; N] {
    keys.map(|name| key(table, name, number))
}

/// A number of things.
pub fn count(value: &Value) -> Option<usize> {
    value.as_integer()?.try_into().ok()
}

/// A text.
pub fn text(value: &Value) -> Option<String> {
    value.as_str().map(str::to_owned)
}

/// Several texts.
pub fn texts(value: &Value) -> Option<Vec<String>> {
    value.as_array()?.iter().map(text).collect()
}

/// Several tables.
pub fn tables(value: &Value) -> Option<Vec<&Table>> {
    value.as_array()?.iter().map(Value::as_table).collect()
}
