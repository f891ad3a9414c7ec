//! Answers from elsewhere.

use std::sync::Arc;

use funicular::judge::{ForeignAnswer, Judge};
use funicular::picture::Seen;
use funicular::prelude::Vector;
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;

use crate::arrays::{numbers, vectors};
use crate::problem::Problem;
use crate::work;

/// What `funicular judge --json` prints, whether the answer is confirmed and whether refuted, the
/// judgement as a page and as text, and whether all is as strong as wanted.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "arrays, one for each quantity")]
pub fn judge<'py>(
    py: Python<'py>,
    problem: &Problem,
    joints_m: PyReadonlyArrayDyn<'py, f64>,
    axial_n: Option<PyReadonlyArrayDyn<'py, f64>>,
    reactions_n: Option<Vec<(String, Vector)>>,
    source: String,
    tolerance: Option<f64>,
    threads: usize,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, bool, bool, String, String, Option<bool>)> {
    let joints = vectors(&joints_m)?;
    let axial = axial_n.as_ref().map(numbers).transpose()?;
    let of = Arc::clone(&problem.of);
    let judge = tolerance.map_or_else(Judge::new, |tolerance| Judge::new().tolerance(tolerance));
    work::answer(py, threads, progress, move |watch| {
        let system = of.system();
        let mut answer = ForeignAnswer::in_order(&system, source, joints, axial)?;
        if let Some(reactions) = reactions_n {
            answer = answer.with_reactions(&system, reactions)?;
        }
        let judged = judge.run_watched(&of, &answer, &|what| watch.tell(what, 0, 0))?;
        let judgement = judged.judgement();
        let (confirmed, refuted) = (judgement.is_confirmed(), judgement.is_refuted());
        let (text, said) = work::told(&judged);
        Ok((text, confirmed, refuted, judged.html(&[], Seen::Best), said, judged.is_strong()))
    })
}
