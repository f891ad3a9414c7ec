//! Small oscillations.

use std::sync::Arc;

use funicular::prelude::Modes;
use pyo3::prelude::*;

use crate::printable::printable;
use crate::problem::Problem;
use crate::raise::{raise, unwritten};
use crate::work;

/// What `funicular modes` prints, with `--json` and without.
#[pyfunction]
pub fn modes<'py>(
    py: Python<'py>,
    problem: &Problem,
    max_bars: Option<usize>,
    lowest: Option<usize>,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, String)> {
    let of = Arc::clone(&problem.of);
    let mut modes = max_bars.map_or_else(Modes::new, |bars| Modes::new().max_bars(bars));
    if let Some(count) = lowest {
        modes = modes.lowest(count);
    }
    let found = work::run(py, threads, progress.as_ref(), move |_| modes.run(&of))?;
    let found = found.map_err(|error| raise(&error))?;
    let text = serde_json::to_string(&found).map_err(|error| unwritten(&error))?;
    Ok((text, printable(&found.to_string())))
}
