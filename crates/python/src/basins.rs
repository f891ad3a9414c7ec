//! Which start leads where, over the angles of two bars or the place of a joint.

use std::sync::Arc;

use funicular::prelude::{Basins, SolverName};
use funicular::{Error, Field};
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::printable::printable;
use crate::problem::Problem;
use crate::{words, work};

/// What the axes are, and where each begins and ends.
type Axes = ([String; 2], [[f64; 2]; 2]);

/// By solver: outcomes and iterations of all starts, (size, size), and a picture of each as SVG; the
/// equilibria in words, the axes, and what the program prints.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one for each setting")]
pub fn basins<'py>(
    py: Python<'py>,
    problem: &Problem,
    size: u32,
    bars: [usize; 2],
    others_deg: f64,
    joint: Option<String>,
    plane: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, Vec<String>, Axes, String)> {
    let basins =
        Basins::new().size(size).bars(bars).others_deg(others_deg).plane(words::plane(plane)?);
    let basins = match joint {
        Some(name) => basins.joint(&name),
        None => basins,
    };
    let of = Arc::clone(&problem.of);
    let (found, pictures) = work::answer(py, threads, progress, move |watch| {
        watch.tell("starts", 0, u64::from(size).pow(2));
        let found = basins.run(&of)?;
        let draw = |solver: &SolverName| {
            Ok::<_, Error>([
                found.svg(solver, Field::Outcome)?,
                found.svg(solver, Field::Iterations)?,
            ])
        };
        let pictures = [draw(&SolverName::LAGRANGE)?, draw(&SolverName::ENERGY)?];
        Ok((found, pictures))
    })?;
    let all = PyDict::new(py);
    let square = [size as usize; 2];
    for (solver, [outcome, iterations]) in
        [SolverName::LAGRANGE, SolverName::ENERGY].iter().zip(pictures)
    {
        let Some(of) = found.outcomes(solver) else { continue };
        let one = PyDict::new(py);
        one.set_item("outcome", PyArray1::from_slice(py, &of.outcome).reshape(square)?)?;
        one.set_item("iterations", PyArray1::from_slice(py, &of.iterations).reshape(square)?)?;
        one.set_item("svg", (outcome, iterations))?;
        all.set_item(solver.as_str(), one)?;
    }
    let names = found.equilibria().iter().map(|name| printable(name)).collect();
    let axes = (found.labels().clone().map(|label| printable(&label)), found.ranges());
    Ok((all, names, axes, printable(&found.to_string())))
}
