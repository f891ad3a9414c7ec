//! The equilibrium over numbers of the file, and its derivatives by them.

use std::sync::Arc;

use funicular::prelude::{Derivatives, Study};
use funicular::{Combine, Error, Parameters};
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{column, numbers, rows, vectors};
use crate::problem::Problem;
use crate::{words, work};

/// What `funicular study --json` prints, the same as CSV, and a figure of each path as SVG; whether a
/// check failed, whether all is decided, and the
/// tables.
type Told = (String, String, Vec<String>, bool, bool, String);

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
    work::answer(py, threads, progress, move |watch| {
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
        let (text, said) = work::told(&found);
        let csv = String::from_utf8_lossy(&csv).into_owned();
        Ok((text, csv, figures, found.check_failed(), found.is_decided(), said))
    })
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
    work::answer(py, threads, progress, move |watch| {
        watch.tell("derivatives", 0, 0);
        let derivatives = Derivatives::new().run(&of)?;
        Ok(match (number, by) {
            (Some(number), _) => work::json(&derivatives.gradient(&number)?),
            (None, Some(by)) => work::json(&derivatives.change(&by)?),
            (None, None) => work::json(&derivatives.anchor_stiffness()?),
        })
    })
}

/// The equilibrium by `lagrange` in arrays; and of a function of joints and axial forces, whose
/// derivatives by them are given, the derivatives by lengths, masses, stiffnesses, forces on joints
/// and places of anchors.
#[pyfunction]
pub fn pullback<'py>(
    py: Python<'py>,
    problem: &Problem,
    by_joints: Option<PyReadonlyArrayDyn<'py, f64>>,
    by_axial: Option<PyReadonlyArrayDyn<'py, f64>>,
    threads: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let by = match (&by_joints, &by_axial) {
        (Some(joints), Some(axial)) => Some((vectors(joints)?, numbers(axial)?)),
        _ => None,
    };
    let of = Arc::clone(&problem.of);
    let (joints_m, axial_n, energy_j, gradient) = work::answer(py, threads, None, move |_| {
        let found = Derivatives::new().run(&of)?;
        let gradient = by.map(|(joints, axial)| found.pullback(&joints, &axial)).transpose()?;
        let at = found.equilibrium();
        Ok((at.joints_m.clone(), at.axial_n.clone(), at.energy_j, gradient))
    })?;
    let dict = PyDict::new(py);
    dict.set_item("joints_m", rows(py, joints_m)?)?;
    dict.set_item("axial_n", column(py, axial_n))?;
    dict.set_item("energy_j", energy_j)?;
    if let Some(gradient) = gradient {
        dict.set_item("lengths", column(py, gradient.by_length))?;
        dict.set_item("masses", column(py, gradient.by_mass))?;
        dict.set_item("stiffnesses", column(py, gradient.by_stiffness))?;
        dict.set_item("forces", rows(py, gradient.by_force)?)?;
        dict.set_item("anchors", rows(py, gradient.by_anchor)?)?;
    }
    Ok(dict)
}
