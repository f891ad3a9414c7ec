//! Answers of many systems as arrays: an entry for each, NaN where there is none, and why.

use model::Rung;
use numpy::PyArrayMethods as _;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::column;
use crate::raise::parts;
use crate::told::Told;

/// No rung was reached.
const NO_RUNG: i8 = -1;

/// The answers, and the arrays that there are of them.
pub struct Many<'py, T> {
    found: Vec<Result<T, Told>>,
    arrays: Bound<'py, PyDict>,
}

impl<'py, T> Many<'py, T> {
    pub fn new(py: Python<'py>, found: Vec<Result<T, Told>>) -> Self {
        Self { found, arrays: PyDict::new(py) }
    }

    /// An array of this shape of each.
    pub fn add(&self, name: &str, shape: &[usize], numbers: impl Fn(&T) -> &[f64]) -> PyResult<()> {
        let size = shape.iter().product();
        let mut all = Vec::with_capacity(self.found.len().saturating_mul(size));
        for found in &self.found {
            match found {
                Ok(found) => all.extend_from_slice(numbers(found)),
                Err(_) => all.extend(std::iter::repeat_n(f64::NAN, size)),
            }
        }
        let shape = [&[self.found.len()], shape].concat();
        self.arrays.set_item(name, column(self.arrays.py(), all).reshape(shape)?)
    }

    /// All arrays, with the rung of each, and why there is no answer.
    pub fn done(self, rung: impl Fn(&T) -> Option<Rung>) -> PyResult<Bound<'py, PyDict>> {
        let py = self.arrays.py();
        let reached =
            |found: &Result<T, Told>| found.as_ref().ok().and_then(&rung).map_or(NO_RUNG, number);
        let rungs = self.found.iter().map(reached).collect();
        self.arrays.set_item("rung", numpy::PyArray1::from_vec(py, rungs))?;
        let refused =
            self.found.iter().enumerate().filter_map(|(k, found)| Some((k, found.as_ref().err()?)));
        let failures = refused.map(|(k, told)| Ok((k, parts(py, told)?)));
        self.arrays.set_item("failures", failures.collect::<PyResult<Vec<_>>>()?)?;
        Ok(self.arrays)
    }
}

/// The number of a rung, lowest first, from 0.
fn number(rung: Rung) -> i8 {
    let place = Rung::ALL.iter().position(|other| *other == rung);
    place.and_then(|k| k.try_into().ok()).unwrap_or(NO_RUNG)
}
