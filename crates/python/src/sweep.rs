//! Many starts, and where each of them leads.

use std::sync::Arc;

use funicular::SweepAnswer;
use funicular::prelude::Sweep;
use pyo3::prelude::*;
use serde_json::json;

use crate::printable::printable;
use crate::problem::Problem;
use crate::{words, work};

/// The equilibria and the counts of outcomes, in memory, and the tables.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one for each setting")]
pub fn sweep<'py>(
    py: Python<'py>,
    problem: &Problem,
    seeds: u64,
    number: u64,
    spread: &str,
    solver: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, String)> {
    let sweep = Sweep::new(seeds)
        .number(number)
        .spread(words::spread(spread)?)
        .solvers(words::solvers(solver)?);
    let of = Arc::clone(&problem.of);
    let found = work::answer(py, threads, progress, move |watch| {
        sweep.threads(rayon::current_num_threads()).run_watched(&of, &|done| {
            watch.tell("starts", done, seeds);
        })
    })?;
    let SweepAnswer { equilibria, complete, listed_below_j, .. } = &found;
    let object = json!({
        "seeds": seeds,
        "equilibria": equilibria,
        "complete": complete,
        "listed_below_j": listed_below_j,
        "outcomes": found.outcomes(),
    });
    Ok((object.to_string(), printable(&found.to_string())))
}
