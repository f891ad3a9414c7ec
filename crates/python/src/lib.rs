//! The native half of the Python package `funicular`: what `funicular._native` holds.
//!
//! The other half, in Python, checks shapes and types, and makes objects of what comes from here.
//! Each function takes arrays of doubles and words, works without the interpreter lock on the
//! threads of the package (`work`), and gives back arrays and, for all that is no array, one text
//! of JSON with the keys of `funicular --json`. Errors of the library become exceptions of the
//! package with their numbers (`raise`).

mod arrays;
mod arrow;
mod basins;
mod batch;
mod census;
mod judge;
mod modes;
mod nets;
mod printable;
mod problem;
mod raise;
mod reproduce;
mod simulate;
mod solve;
mod store;
mod study;
mod sweep;
mod told;
mod trace;
mod words;
mod work;

use pyo3::prelude::*;

/// The module `funicular._native`.
///
/// # Errors
///
/// When the interpreter cannot hold it.
#[pymodule(gil_used = false)]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<problem::Problem>()?;
    module.add_function(wrap_pyfunction!(work::set_threads, module)?)?;
    module.add_function(wrap_pyfunction!(work::get_threads, module)?)?;
    module.add_function(wrap_pyfunction!(work::limit_work, module)?)?;
    module.add_function(wrap_pyfunction!(solve::solve, module)?)?;
    module.add_function(wrap_pyfunction!(solve::solve_text, module)?)?;
    module.add_function(wrap_pyfunction!(solve::losses, module)?)?;
    module.add_function(wrap_pyfunction!(solve::load_cases, module)?)?;
    module.add_function(wrap_pyfunction!(solve::page, module)?)?;
    module.add_function(wrap_pyfunction!(solve::live_page, module)?)?;
    module.add_function(wrap_pyfunction!(solve::live_answer, module)?)?;
    module.add_function(wrap_pyfunction!(solve::tolerances, module)?)?;
    module.add_function(wrap_pyfunction!(solve::export, module)?)?;
    module.add_function(wrap_pyfunction!(solve::draw, module)?)?;
    module.add_function(wrap_pyfunction!(batch::solve_many, module)?)?;
    module.add_function(wrap_pyfunction!(nets::solve_nets, module)?)?;
    module.add_function(wrap_pyfunction!(basins::basins, module)?)?;
    module.add_function(wrap_pyfunction!(census::census, module)?)?;
    module.add_function(wrap_pyfunction!(trace::trace, module)?)?;
    module.add_function(wrap_pyfunction!(study::study, module)?)?;
    module.add_function(wrap_pyfunction!(study::derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(study::pullback, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep, module)?)?;
    module.add_function(wrap_pyfunction!(store::sweep_write, module)?)?;
    module.add_function(wrap_pyfunction!(store::sweep_merge, module)?)?;
    module.add_function(wrap_pyfunction!(simulate::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(simulate::save_motion, module)?)?;
    module.add_function(wrap_pyfunction!(modes::modes, module)?)?;
    module.add_function(wrap_pyfunction!(judge::judge, module)?)?;
    module.add_function(wrap_pyfunction!(reproduce::reproduce, module)?)?;
    module.add_function(wrap_pyfunction!(arrow::arrow_stream, module)?)?;
    Ok(())
}
