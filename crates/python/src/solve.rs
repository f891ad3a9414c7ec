//! The hanging equilibrium.

use std::sync::Arc;

use funicular::export::{Shape, Target};
use funicular::live::Ask;
use funicular::picture::Format;
use funicular::prelude::{Simulate, Solve, Vector};
use funicular::{Error, Extremes, Lists, Page, Weakest, picture};
use model::AxialForce;
use model::system::{System, SystemEquilibrium};
use numpy::PyReadonlyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict as _, PyBytes, PyDict, PyList};

use crate::arrays::{column, numbers, rows, vectors};
use crate::printable::printable;
use crate::problem::Problem;
use crate::raise::{bad_word, internal, raise};
use crate::simulate::start;
use crate::{words, work};

/// One equilibrium in arrays, in the order of joints and members.
pub struct Arrays {
    joints_m: Vec<Vector>,
    /// Those of a row of rigid bars between two anchors alone.
    multipliers_n: Option<Vec<Vector>>,
    axial_n: Vec<f64>,
    along: Vec<AxialForce>,
    start_forces_n: Vec<Vector>,
    end_forces_n: Vec<Vector>,
    reactions_n: Vec<Vector>,
    extremes: Option<Extremes>,
    /// NaN for members without strength.
    utilisation: Option<Vec<f64>>,
    weakest: Option<Weakest>,
}

impl Arrays {
    /// Of a system; a row of rigid bars between two anchors alone has multipliers.
    pub fn new(system: &System, found: SystemEquilibrium) -> Self {
        Self {
            multipliers_n: system.as_row().and_then(|row| row.multipliers_n(&found)),
            along: found.axial_forces(system),
            extremes: Extremes::of(system, &found),
            utilisation: found
                .utilisations(system)
                .map(|used| used.into_iter().map(|part| part.unwrap_or(f64::NAN)).collect()),
            weakest: Weakest::of(system, &found),
            joints_m: found.joints_m,
            axial_n: found.axial_n,
            start_forces_n: found.start_forces_n,
            end_forces_n: found.end_forces_n,
            reactions_n: found.reactions_n,
        }
    }

    /// As a dictionary of arrays, which take over the memory.
    pub fn dict(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("joints_m", rows(py, self.joints_m)?)?;
        let multipliers =
            self.multipliers_n.map(|multipliers| rows(py, multipliers)).transpose()?;
        dict.set_item("multipliers_n", multipliers)?;
        dict.set_item("axial_n", column(py, self.axial_n))?;
        let along = |of: fn(&AxialForce) -> f64| column(py, self.along.iter().map(of).collect());
        dict.set_item("axial_from_n", along(|axial| axial.from_n))?;
        dict.set_item("axial_to_n", along(|axial| axial.to_n))?;
        dict.set_item("axial_max_n", along(AxialForce::largest_n))?;
        dict.set_item("start_forces_n", rows(py, self.start_forces_n)?)?;
        dict.set_item("end_forces_n", rows(py, self.end_forces_n)?)?;
        dict.set_item("reactions_n", rows(py, self.reactions_n)?)?;
        dict.set_item("utilisation", self.utilisation.map(|used| column(py, used)))?;
        let weakest =
            self.weakest.map(|Weakest { bar, utilisation, safety, safety_wanted, .. }| {
                let numbers = [
                    ("utilisation", utilisation),
                    ("safety", safety),
                    ("safety_wanted", safety_wanted),
                ];
                let dict = numbers.into_py_dict(py)?;
                dict.set_item("number", bar)?;
                Ok::<_, PyErr>(dict)
            });
        dict.set_item("weakest", weakest.transpose()?)?;
        dict.set_item("is_strong", self.weakest.map(|weakest| weakest.suffices()))?;
        let extremes = self.extremes.as_ref();
        dict.set_item("sag_m", extremes.and_then(|all| all.sag_m))?;
        let size =
            |of: fn(&Extremes) -> Option<(usize, f64)>| extremes.and_then(of).map(|(_, n)| n);
        dict.set_item("largest_tension_n", size(|all| all.tension_n))?;
        dict.set_item("largest_compression_n", size(|all| all.compression_n))?;
        Ok(dict)
    }
}

/// A text of JSON, and the arrays of all equilibria.
pub type Told<'py> = (String, Bound<'py, PyList>);

/// The same for Python.
pub fn told(py: Python<'_>, text: String, all: Vec<Arrays>) -> PyResult<Told<'_>> {
    let all: Vec<_> = all.into_iter().map(|arrays| arrays.dict(py)).collect::<PyResult<_>>()?;
    Ok((text, PyList::new(py, all)?))
}

/// The summary as `funicular solve --summary --json` prints it, and the arrays of the equilibria,
/// one for each solver that has an answer.
#[pyfunction]
pub fn solve<'py>(
    py: Python<'py>,
    problem: &Problem,
    solver: &str,
    equations: &str,
    census: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Told<'py>> {
    let solve = solver_of(solver, equations, census)?;
    let of = Arc::clone(&problem.of);
    let (text, all) = work::answer(py, threads, progress, move |watch| {
        let found = solve.run_watched(&of, &|what| watch.tell(what, 0, 0))?;
        let text = work::json(&found.json(Lists::None));
        let (system, equilibria) = found.into_parts();
        let arrays = equilibria.into_iter().map(|found| Arrays::new(&system, found));
        Ok((text, arrays.collect()))
    })?;
    told(py, text, all)
}

/// What `funicular solve` prints. It is solved again: tables take longer than short chains, and most
/// answers are not printed.
#[pyfunction]
pub fn solve_text(
    py: Python<'_>,
    problem: &Problem,
    solver: &str,
    equations: &str,
    census: &str,
) -> PyResult<String> {
    let solve = solver_of(solver, equations, census)?;
    let of = Arc::clone(&problem.of);
    work::answer(py, 0, None, move |_| Ok(printable(&solve.run(&of)?.to_string())))
}

/// The loss of each member in turn: as JSON, as text, and whether the system survives it.
#[pyfunction]
pub fn losses<'py>(
    py: Python<'py>,
    problem: &Problem,
    solver: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, String, bool)> {
    let solve = Solve::new().solvers(words::solvers(solver)?);
    let of = Arc::clone(&problem.of);
    work::answer(py, threads, progress, move |watch| {
        let found = solve.without_each_watched(&of, &|| watch.tell("losses", 0, 0))?;
        let (text, said) = work::told(&found);
        Ok((text, said, found.survives()))
    })
}

/// Each load case: as JSON, as text, and whether the system is as strong as wanted in all.
#[pyfunction]
pub fn load_cases<'py>(
    py: Python<'py>,
    problem: &Problem,
    solver: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, String, Option<bool>)> {
    let solve = Solve::new().solvers(words::solvers(solver)?);
    let of = Arc::clone(&problem.of);
    work::answer(py, threads, progress, move |watch| {
        let found = solve.load_cases_watched(&of, &|| watch.tell("load cases", 0, 0))?;
        let (text, said) = work::told(&found);
        Ok((text, said, found.is_strong()))
    })
}

/// A page to look at a system; `vary` says over what its shapes are shown, `motion` where a motion begins, how long
/// it is, s, and its damping, 1/s.
#[pyfunction]
pub fn page<'py>(
    py: Python<'py>,
    problem: &Problem,
    vary: Vec<String>,
    motion: Option<(String, f64, f64)>,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<String> {
    let of = Arc::clone(&problem.of);
    let mut page = Page::new();
    if let Some((word, time_s, damping_1_s)) = motion {
        let released = Simulate::new().start(start(&word, None)?);
        page = page.simulate(released.time_s(time_s).damping_1_s(damping_1_s));
    }
    work::answer(py, threads, progress, move |watch| {
        watch.tell("equilibria, modes and what moves", 0, 0);
        let page = vary.iter().try_fold(page, |page, text| page.vary(text))?;
        Ok(page.run(&of)?.html().to_owned())
    })
}

/// The page of a notebook in which a system file is changed.
#[pyfunction]
pub fn live_page(py: Python<'_>, text: String) -> String {
    py.detach(|| Ask::new(text).page(true))
}

/// The answer to what the page asks.
#[pyfunction]
pub fn live_answer(py: Python<'_>, path: &str, question: &str) -> PyResult<String> {
    let found = py.detach(|| Ask::answer(path, question.as_bytes()));
    found.unwrap_or_else(|| Err(format!("no page {path:?}"))).map_err(PyValueError::new_err)
}

/// Ranges over the tolerances of a system: the answer with its ranges as JSON, and as text.
#[pyfunction]
pub fn tolerances<'py>(
    py: Python<'py>,
    problem: &Problem,
    draws: (usize, u64, String),
    solver: &str,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, String)> {
    let solve = Solve::new().solvers(words::solvers(solver)?).census(words::census("never")?);
    let of = Arc::clone(&problem.of);
    let (draws, seed, distribution) = draws;
    let distribution = words::distribution(&distribution)?;
    work::answer(py, threads, progress, move |watch| {
        watch.tell("proving ranges", 0, 0);
        Ok(work::told(&solve.tolerances_drawn(&of, draws, seed, distribution)?))
    })
}

/// What is asked, by its words.
fn solver_of(solver: &str, equations: &str, census: &str) -> PyResult<Solve> {
    Ok(Solve::new()
        .solvers(words::solvers(solver)?)
        .equations(words::equations(equations)?)
        .census(words::census(census)?))
}

/// Places, axial forces and forces of the ground as the text of a file: of the format that an ending stands for, or
/// as a picture to scale, `svg`, seen from `view`. NaN in `used` stands for a member without strength.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "arrays, one for each quantity")]
pub fn export(
    py: Python<'_>,
    problem: &Problem,
    joints_m: PyReadonlyArrayDyn<'_, f64>,
    axial_n: PyReadonlyArrayDyn<'_, f64>,
    reactions_n: PyReadonlyArrayDyn<'_, f64>,
    used: Option<PyReadonlyArrayDyn<'_, f64>>,
    ending: &str,
    view: &str,
) -> PyResult<String> {
    let (system, seen) = (problem.system(), words::seen(view)?);
    let (joints_m, reactions_n) = (&*vectors(&joints_m)?, &*vectors(&reactions_n)?);
    let (axial_n, used) = (&*numbers(&axial_n)?, used.as_ref().map(numbers).transpose()?);
    let used = used.unwrap_or_default().into_iter();
    let used: &[Option<f64>] =
        &used.map(|part| Some(part).filter(|x| !x.is_nan())).collect::<Vec<_>>();
    if joints_m.len() != system.joints().len()
        || reactions_n.len() != joints_m.len()
        || axial_n.len() != system.members().len()
    {
        return Err(internal("the arrays are not those of the system"));
    }
    if ending == "svg" {
        let draw = || picture::of_answer(&system, joints_m, axial_n, reactions_n, used, seen);
        return py.detach(draw).map_err(|error| internal(&error.to_string()));
    }
    let target = Target::of_ending(ending);
    let target = target.ok_or_else(|| bad_word("ending", ending, &Target::ENDINGS))?;
    let shape = Shape { system: &system, joints_m, axial_n, reactions_n, used, moving: None };
    py.detach(|| shape.text(target)).map_err(|error| raise(&Error::from(error)))
}

/// A drawing as the bytes of a file, of the format that an ending stands for.
#[pyfunction]
pub fn draw<'py>(py: Python<'py>, svg: &str, ending: &str) -> PyResult<Bound<'py, PyBytes>> {
    let format = Format::of_ending(ending);
    let format = format.ok_or_else(|| bad_word("ending", ending, &Format::ENDINGS))?;
    let file = py.detach(|| format.file(svg)).map_err(|error| internal(&error.to_string()))?;
    Ok(PyBytes::new(py, &file))
}
