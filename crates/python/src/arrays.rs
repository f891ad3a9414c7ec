//! Arrays from Python and for Python.

use model::Vector;
use numpy::{PyArray1, PyArray2, PyArrayMethods as _, PyReadonlyArrayDyn};
use pyo3::prelude::*;

/// The numbers of a contiguous array, copied: while the solvers work, other threads may write into
/// the array.
pub fn numbers(array: &PyReadonlyArrayDyn<'_, f64>) -> PyResult<Vec<f64>> {
    Ok(array.as_slice()?.to_vec())
}

/// The rows of a contiguous array of shape (n, 3).
pub fn vectors(array: &PyReadonlyArrayDyn<'_, f64>) -> PyResult<Vec<Vector>> {
    let (rows, []) = array.as_slice()?.as_chunks() else {
        return Err(pyo3::exceptions::PyValueError::new_err("rows of three numbers are wanted"));
    };
    Ok(rows.to_vec())
}

/// An array of shape (n,), which takes over the memory.
pub fn column(py: Python<'_>, values: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    PyArray1::from_vec(py, values)
}

/// An array of shape (n, 3), which takes over the memory.
pub fn rows(py: Python<'_>, vectors: Vec<Vector>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let n = vectors.len();
    PyArray1::from_vec(py, vectors.into_flattened()).reshape([n, 3])
}
