//! Every equilibrium, with proof.

use std::sync::Arc;

use funicular::prelude::Census;
use pyo3::prelude::*;

use crate::printable::printable;
use crate::problem::Problem;
use crate::raise::{raise, unwritten};
use crate::solve::{Arrays, Told, told};
use crate::work;

/// What `funicular census --json` prints and the arrays of the equilibria; and the tables.
#[pyfunction]
pub fn census<'py>(
    py: Python<'py>,
    problem: &Problem,
    max_bars: Option<usize>,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(Told<'py>, String)> {
    let of = Arc::clone(&problem.of);
    let census = max_bars.map_or_else(Census::new, |bars| Census::new().max_bars(bars));
    let found = work::run(py, threads, progress.as_ref(), move |watch| {
        let tell = |done, waiting| watch.tell("cells", done, done + waiting);
        let found = census.run_watched(&of, &|at| tell(at.done, at.waiting))?;
        let all = found.equilibria.iter().map(|one| one.equilibrium.clone());
        let is_chain = of.as_chain().is_some();
        let arrays: Vec<_> = all.map(|one| Arrays::new(found.system(), one, is_chain)).collect();
        Ok((serde_json::to_string(&found), arrays, found.to_string()))
    })?;
    let (text, arrays, said) = found.map_err(|error: funicular::Error| raise(&error))?;
    let told = told(py, text.map_err(|error| unwritten(&error))?, arrays)?;
    Ok((told, printable(&said)))
}
