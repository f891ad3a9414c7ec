//! Every equilibrium, with proof.

use std::sync::Arc;

use funicular::prelude::Census;
use pyo3::prelude::*;

use crate::problem::Problem;
use crate::raise::{raise, unwritten};
use crate::solve::{Arrays, Told, told};
use crate::work;

/// What `funicular census --json` prints, and the arrays of the equilibria.
#[pyfunction]
pub fn census<'py>(
    py: Python<'py>,
    problem: &Problem,
    max_bars: Option<usize>,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Told<'py>> {
    let of = Arc::clone(&problem.of);
    let census = max_bars.map_or_else(Census::new, |bars| Census::new().max_bars(bars));
    let found = work::run(py, threads, progress.as_ref(), move |watch| {
        let tell = |done, waiting| watch.tell("cells", done, done + waiting);
        if let Some(system) = of.as_system() {
            let found = census.run_system_watched(system, &|at| tell(at.done, at.waiting))?;
            let arrays: Vec<_> = found
                .equilibria()
                .iter()
                .cloned()
                .map(|one| Arrays::new(found.system(), one, false))
                .collect();
            return Ok((serde_json::to_string(&found), arrays));
        }
        let found = census.run_watched(&of, &|at| tell(at.done, at.waiting))?;
        let system = funicular::system_of(&of);
        let Some(row) = system.as_row() else { unreachable!("a chain is a row") };
        let as_system =
            |found: &funicular::census::Found| row.equilibrium(found.equilibrium.clone());
        let equilibria = found.equilibria.iter().map(as_system);
        let arrays = equilibria.map(|one| Arrays::new(&system, one, true)).collect();
        Ok((serde_json::to_string(&found), arrays))
    })?;
    let (text, arrays) = found.map_err(|error: funicular::Error| raise(&error))?;
    told(py, text.map_err(|error| unwritten(&error))?, arrays)
}
