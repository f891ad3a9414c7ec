//! Small oscillations.

use std::sync::Arc;

use funicular::prelude::Modes;
use pyo3::prelude::*;

use crate::problem::Problem;
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
    work::answer(py, threads, progress, move |_| Ok(work::told(&modes.run(&of)?)))
}
