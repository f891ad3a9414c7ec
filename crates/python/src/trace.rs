//! All equilibria of a chain over a parameter, and load paths of any system.

use std::sync::Arc;

use funicular::LoadPaths;
use funicular::prelude::Trace;
use pyo3::prelude::*;

use crate::problem::Problem;
use crate::work;

/// What `funicular trace --json` prints, the points of the branches or load paths as CSV, whether the checks
/// agree and are decided, the tables, and the page of load paths.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one for each setting")]
pub fn trace<'py>(
    py: Python<'py>,
    problem: &Problem,
    vary: Vec<String>,
    numbers: Vec<String>,
    max_points: Option<usize>,
    branches: usize,
    linear_buckling: bool,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, String, bool, bool, String, String)> {
    let of = Arc::clone(&problem.of);
    work::answer(py, threads, progress, move |watch| {
        let mut trace = numbers.into_iter().fold(Trace::new(), Trace::of).branches(branches);
        if linear_buckling {
            trace = trace.linear_buckling();
        }
        if let Some(points) = max_points {
            trace = trace.max_points(points);
        }
        let trace = vary.iter().try_fold(trace, |trace, text| trace.vary(text))?;
        let found = trace
            .run_watched(&of, &|_, at| watch.tell("censuses", at.done as u64, at.total as u64))?;
        let mut csv = vec![];
        // A vector takes all that is written.
        let _ = found.write_csv(&mut csv);
        let csv = String::from_utf8_lossy(&csv).into_owned();
        let page = found.load_paths().map_or_else(String::new, LoadPaths::page);
        let (text, said) = work::told(&found);
        Ok((text, csv, found.checks_agree(), found.checks_decided(), said, page))
    })
}
