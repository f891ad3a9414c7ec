//! The paper, judged.

use funicular::prelude::Reproduce;
use pyo3::prelude::*;

use crate::raise::internal;
use crate::work;

/// What `funicular reproduce --json` prints, the report as a page, and the tables.
#[pyfunction]
pub fn reproduce(
    py: Python<'_>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(String, String, String)> {
    let (json, html, said) = work::answer(py, threads, progress, |watch| {
        let report = Reproduce::new().run_watched(|what| watch.tell(what, 0, 0))?;
        Ok((report.json().map_err(|error| error.to_string()), report.html(), report.to_string()))
    })?;
    Ok((json.map_err(|error| internal(&error))?, html, said))
}
