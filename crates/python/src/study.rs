//! The equilibrium over numbers of the file, and its derivatives by them.

use std::sync::Arc;

use funicular::prelude::{Derivatives, Study};
use funicular::{Combine, Error, Parameters};
use pyo3::prelude::*;

use crate::problem::Problem;
use crate::raise::{raise, unwritten};
use crate::{words, work};

/// What `funicular study --json` prints, the same as CSV, and a figure of each path as SVG; whether a
/// check failed, and whether all is decided.
type Told = (String, String, Vec<String>, bool, bool);

/// The equilibrium over numbers of the file, with `numbers` shown besides.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "settings of one call")]
pub fn study<'py>(
    py: Python<'py>,
    problem: &Problem,
    vary: Vec<String>,
    zip: bool,
    numbers: Vec<String>,
    solver: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Told> {
    let of = Arc::clone(&problem.of);
    let solvers = words::solvers(solver)?;
    let found = work::run(py, threads, progress.as_ref(), move |watch| {
        let combine = if zip { Combine::Zip } else { Combine::Product };
        let parameters = Ok::<_, Error>(Parameters::new().combine(combine));
        let parameters = vary.iter().fold(parameters, |all, text| all?.vary(text))?;
        let study = Study::new().over(parameters).solvers(solvers);
        let study = numbers.into_iter().fold(study, Study::of);
        let found = study.run_watched(&of, &|| watch.tell("points", 0, 0))?;
        let mut csv = vec![];
        // A vector takes all that is written.
        let _ = found.write_csv(&mut csv);
        let figures = (1..=found.paths()).map(|path| found.figure(path)).collect();
        let verdict = (found.check_failed(), found.is_decided());
        Ok((serde_json::to_string(&found), csv, figures, verdict))
    })?;
    let (text, csv, figures, (failed, decided)) = found.map_err(|error: Error| raise(&error))?;
    let text = text.map_err(|error| unwritten(&error))?;
    Ok((text, String::from_utf8_lossy(&csv).into_owned(), figures, failed, decided))
}

/// As JSON: the gradient of one number, the change by one parameter, or the stiffness of the anchors.
#[pyfunction]
pub fn derivatives<'py>(
    py: Python<'py>,
    problem: &Problem,
    number: Option<String>,
    by: Option<String>,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<String> {
    let of = Arc::clone(&problem.of);
    let found = work::run(py, threads, progress.as_ref(), move |watch| {
        watch.tell("derivatives", 0, 0);
        let derivatives = Derivatives::new().run(&of)?;
        Ok::<_, Error>(match (number, by) {
            (Some(number), _) => serde_json::to_string(&derivatives.gradient(&number)?),
            (None, Some(by)) => serde_json::to_string(&derivatives.change(&by)?),
            (None, None) => serde_json::to_string(&derivatives.anchor_stiffness()?),
        })
    })?;
    let text = found.map_err(|error: Error| raise(&error))?;
    text.map_err(|error| unwritten(&error))
}
