//! One structure with other numbers: once, or many times.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use funicular::prelude::{
    Joint, Member, Solve, SolveAnswer, Support, SystemEquilibrium, UseCensus, Vector,
};
use funicular::{Error, JointField, Number};
use model::AxialForce;
use model::system::System;
use numpy::{PyArrayMethods as _, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::arrays::{column, numbers};
use crate::batch::{NO_RUNG, number};
use crate::problem::Problem;
use crate::raise::{internal, parts, raise};
use crate::told::Told;
use crate::{words, work};

/// The paths of the numbers that a name of an array stands for, in the order of the array; an empty
/// one where the system has no such number.
fn paths(system: &System, name: &str) -> Option<Vec<String>> {
    let bars = |field: &str| {
        (1..=system.members().len()).map(|bar| format!("bars.{bar}.{field}")).collect()
    };
    // What acts at an anchor goes into the ground, and what is free has no place to hold it.
    let joint = |k: usize, field| match (system.joints()[k].support.is_fixed(), field) {
        (true, JointField::Place(_)) | (false, JointField::Mass | JointField::Force(_)) => {
            Number::Joint(system.joints()[k].name.to_string(), field).to_string()
        }
        _ => String::new(),
    };
    let all = 0..system.joints().len();
    let axes = |field: fn(usize) -> JointField| {
        all.clone().flat_map(|k| [0, 1, 2].map(|axis| joint(k, field(axis)))).collect()
    };
    Some(match name {
        "lengths" => bars("length_m"),
        "masses" => bars("mass_kg"),
        "stiffnesses" => bars("stiffness_n"),
        "joint_masses" => all.clone().map(|k| joint(k, JointField::Mass)).collect(),
        "forces" => axes(JointField::Force),
        "anchors" => axes(JointField::Place),
        _ => return None,
    })
}

/// The numbers of a system under the name of an array, NaN where it has none.
pub fn values(system: &System, name: &str) -> Option<Vec<f64>> {
    let of = |number: fn(&Member) -> f64| system.members().iter().map(number).collect();
    let at = |number: fn(&Joint) -> Vector| system.joints().iter().flat_map(number).collect();
    Some(match name {
        "lengths" => of(|member| member.body.length_m()),
        "masses" => of(|member| member.body.mass_kg()),
        "stiffnesses" => of(|member| member.stiffness_n.unwrap_or(f64::NAN)),
        "joint_masses" => system.joints().iter().map(|joint| joint.mass_kg).collect(),
        "forces" => at(|joint| joint.force_n),
        "anchors" => at(|joint| match joint.support {
            Support::Fixed { at_m } => at_m,
            _ => [f64::NAN; 3],
        }),
        _ => return None,
    })
}

/// Arrays by their names, a row of each for each problem.
struct Rows {
    all: Vec<(Vec<String>, Vec<f64>)>,
}

impl Rows {
    fn of(
        system: &System,
        arrays: Vec<(String, PyReadonlyArrayDyn<'_, f64>)>,
        count: usize,
    ) -> PyResult<Self> {
        let one = |(name, array): (String, PyReadonlyArrayDyn<'_, f64>)| {
            let paths = paths(system, &name).ok_or_else(|| internal(&format!("no {name}")))?;
            let values = numbers(&array)?;
            if values.len() != count * paths.len() {
                return Err(internal(&format!("{name}: {} numbers", values.len())));
            }
            Ok((paths, values))
        };
        Ok(Self { all: arrays.into_iter().map(one).collect::<PyResult<_>>()? })
    }

    fn problem(&self, base: &funicular::Problem, row: usize) -> Result<funicular::Problem, Error> {
        let mut numbers: Vec<(&str, f64)> = Vec::new();
        for (paths, values) in &self.all {
            let values = &values[row * paths.len()..];
            let named = paths.iter().map(String::as_str).zip(values.iter().copied());
            // What is not a number leaves the number of the system.
            numbers.extend(named.filter(|(path, value)| !path.is_empty() && !value.is_nan()));
        }
        base.with(&numbers)
    }
}

/// One problem with other numbers.
pub fn with_numbers(
    py: Python<'_>,
    problem: &Problem,
    arrays: Vec<(String, PyReadonlyArrayDyn<'_, f64>)>,
) -> PyResult<funicular::Problem> {
    let rows = Rows::of(&problem.system(), arrays, 1)?;
    py.detach(|| rows.problem(&problem.of, 0)).map_err(|error| raise(&error))
}

/// The hanging equilibria of one structure with other numbers: arrays with an entry for each, NaN
/// where there is none, and why.
#[pyfunction]
pub fn solve_nets<'py>(
    py: Python<'py>,
    problem: &Problem,
    count: usize,
    arrays: Vec<(String, PyReadonlyArrayDyn<'py, f64>)>,
    solver: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let system = problem.system();
    let (joints, members) = (system.joints().len(), system.members().len());
    let rows = Rows::of(&system, arrays, count)?;
    let solve = Solve::new().solvers(words::solvers(solver)?).census(UseCensus::Never);
    let of = Arc::clone(&problem.of);
    let all = work::run(py, threads, progress.as_ref(), move |watch| {
        let done = AtomicUsize::new(0);
        let one = |row: usize| {
            watch.go_on();
            let found = rows.problem(&of, row).and_then(|problem| solve.run_here(&problem));
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            watch.tell("systems", done as u64, count as u64);
            let first = |answer: SolveAnswer| {
                let (system, mut equilibria) = answer.into_parts();
                let first = equilibria.remove(0);
                let along = first.axial_forces(&system);
                (first, along.iter().map(AxialForce::largest_n).collect::<Vec<_>>())
            };
            found.map(first).map_err(|error| Told::of(&error))
        };
        (0..count).into_par_iter().map(one).collect::<Vec<_>>()
    })?;
    let first = |k: usize| all[k].as_ref().ok().map(|(found, _)| found);
    let table = |of: fn(&SystemEquilibrium) -> &[Vector]| {
        let row = |k| first(k).map_or_else(|| vec![[f64::NAN; 3]; joints], |e| of(e).to_vec());
        column(py, (0..count).flat_map(row).flatten().collect()).reshape([count, joints, 3])
    };
    let each = |of: fn(&SystemEquilibrium) -> f64| {
        column(py, (0..count).map(|k| first(k).map_or(f64::NAN, of)).collect())
    };
    let axial = |k| first(k).map_or_else(|| vec![f64::NAN; members], |e| e.axial_n.clone());
    let largest = |k: usize| {
        all[k].as_ref().map_or_else(|_| vec![f64::NAN; members], |found| found.1.clone())
    };
    let rung = |k| first(k).and_then(|e| e.evidence.rung()).map_or(NO_RUNG, number);
    let dict = PyDict::new(py);
    dict.set_item("joints_m", table(|e| &e.joints_m)?)?;
    dict.set_item("reactions_n", table(|e| &e.reactions_n)?)?;
    let shape = [count, members];
    dict.set_item("axial_n", column(py, (0..count).flat_map(axial).collect()).reshape(shape)?)?;
    dict.set_item(
        "axial_max_n",
        column(py, (0..count).flat_map(largest).collect()).reshape(shape)?,
    )?;
    dict.set_item("energy_j", each(|e| e.energy_j))?;
    dict.set_item("residual", each(|e| e.evidence.residual))?;
    dict.set_item("rung", numpy::PyArray1::from_vec(py, (0..count).map(rung).collect()))?;
    let failures = all.iter().enumerate().filter_map(|(k, found)| Some((k, found.as_ref().err()?)));
    let failures = failures.map(|(k, told)| Ok((k, parts(py, told)?)));
    dict.set_item("failures", failures.collect::<PyResult<Vec<_>>>()?)?;
    Ok(dict)
}
