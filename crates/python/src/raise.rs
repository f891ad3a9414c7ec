//! Exceptions of the package: classes of `funicular.errors`, made from a name, a sentence, and
//! numbers.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::printable::printable;
use crate::told::{Field, Told};

/// The exception for an error of the library.
pub fn raise(error: &funicular::Error) -> PyErr {
    exception(Told::of(error))
}

/// The exception.
pub fn exception(told: Told) -> PyErr {
    Python::attach(|py| {
        let made = fields(py, &told.fields).and_then(|fields| {
            let errors = py.import("funicular.errors")?;
            errors.call_method1("_make", (told.class, printable(&told.message), fields))
        });
        made.map_or_else(|error| error, PyErr::from_value)
    })
}

/// A name, a sentence and numbers, for exceptions that may never be raised.
pub fn parts<'py>(
    py: Python<'py>,
    told: &Told,
) -> PyResult<(&'static str, String, Bound<'py, PyDict>)> {
    Ok((told.class, printable(&told.message), fields(py, &told.fields)?))
}

fn fields<'py>(py: Python<'py>, fields: &[(&'static str, Field)]) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, field) in fields {
        match field {
            Field::Number(number) => dict.set_item(name, number)?,
            Field::Count(count) => dict.set_item(name, count)?,
            Field::Text(text) => dict.set_item(name, printable(text))?,
            Field::List(list) => {
                let list: Vec<String> = list.iter().map(|text| printable(text)).collect();
                dict.set_item(name, list)?;
            }
            Field::Json(text) => {
                let json = py.import("json")?;
                dict.set_item(name, json.call_method1("loads", (printable(text),))?)?;
            }
            Field::Nothing => dict.set_item(name, py.None())?,
        }
    }
    Ok(dict)
}

/// A bug: the work ended by a panic.
pub fn internal(what: &str) -> PyErr {
    exception(Told::new("InternalError", what.to_owned(), vec![]))
}

/// A setting of another value than it may have.
pub fn bad_setting(setting: &'static str, value: &str, why: &str) -> PyErr {
    let fields = vec![("setting", Field::from(setting)), ("value", Field::from(value))];
    exception(Told::new("SettingError", format!("{setting}: {why}"), fields))
}

/// A setting that is none of the words allowed.
pub fn bad_word(setting: &'static str, word: &str, allowed: &[&str]) -> PyErr {
    let message = format!("{setting} must be one of {}, got {word:?}", allowed.join(", "));
    let allowed = allowed.iter().map(|&word| word.to_owned()).collect::<Vec<_>>();
    let fields = vec![
        ("setting", Field::from(setting)),
        ("value", Field::from(word)),
        ("allowed", Field::from(allowed)),
    ];
    exception(Told::new("SettingError", message, fields))
}
