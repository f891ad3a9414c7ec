//! Every equilibrium, with proof.

use std::sync::Arc;

use funicular::prelude::Census;
use pyo3::prelude::*;

use crate::problem::Problem;
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
    let (text, arrays, said) = work::answer(py, threads, progress, move |watch| {
        let tell = |done, waiting| watch.tell("cells", done, done + waiting);
        let found = census.run_watched(&of, &|at| tell(at.done, at.waiting))?;
        let all = found.equilibria.iter().map(|one| one.equilibrium.clone());
        let arrays: Vec<_> = all.map(|one| Arrays::new(found.system(), one)).collect();
        let (text, said) = work::told(&found);
        Ok((text, arrays, said))
    })?;
    Ok((told(py, text, arrays)?, said))
}
