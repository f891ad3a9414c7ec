//! The paper, judged.

use funicular::Error;
use funicular::prelude::Reproduce;
use pyo3::prelude::*;

use crate::raise::{internal, raise};
use crate::work;

/// What `funicular reproduce --json` prints, the report as a page, and the tables.
#[pyfunction]
pub fn reproduce(
    py: Python<'_>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(String, String, String)> {
    let found = work::run(py, threads, progress.as_ref(), |watch| {
        let report = Reproduce::new().run_watched(|what| watch.tell(what, 0, 0))?;
        let json = report.json().map_err(|error| error.to_string());
        Ok::<_, Error>((json, report.html(), report.to_string()))
    })?;
    let (json, html, said) = found.map_err(|error| raise(&error))?;
    Ok((json.map_err(|error| internal(&error))?, html, said))
}
