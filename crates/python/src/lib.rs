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
/// When the interpreter cannot hold it.
#[pymodule(gil_used = false)]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<problem::Problem>()?;
    macro_rules! functions {
        ($($function:path,)*) => {
            $(module.add_function(wrap_pyfunction!($function, module)?)?;)*
        };
    }
    functions! {
        work::set_threads, work::get_threads, work::limit_work, solve::solve, solve::solve_text,
        solve::losses, solve::load_cases, solve::page, solve::live_page, solve::live_answer,
        solve::tolerances, solve::export, solve::draw, batch::solve_many, nets::solve_nets,
        basins::basins, census::census, trace::trace, study::study, study::derivatives,
        study::pullback, sweep::sweep, store::sweep_write, store::sweep_merge, simulate::simulate,
        simulate::save_motion, modes::modes, judge::judge, reproduce::reproduce,
        arrow::arrow_stream,
    }
    Ok(())
}
