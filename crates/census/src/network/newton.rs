//! Newton's method on the equations, in double precision: from an answer to the zero next to it. No
//! proof.

use faer::Mat;
use faer::linalg::solvers::DenseSolveCore;
use model::NoBox;
use numerics::Interval;

use super::equations::Entry;
use super::krawczyk::Zeros;

/// Steps from an answer that is good to some digits; quadratic convergence needs three.
const STEPS: usize = 8;

/// An answer further from the zero than this, in units of the system's length and force, was none.
const REACH: f64 = 1e-3;

/// A point at which the equations hold as far as double precision allows.
pub(super) struct Refined {
    pub(super) at: Vec<f64>,
    /// Approximate inverse of the derivative there.
    pub(super) inverse: Mat<f64>,
}

/// Refine an answer.
///
/// # Errors
///
/// [`NoBox::Singular`] when the derivative is singular, [`NoBox::NotConverged`] when the steps lead
/// away.
pub(super) fn refine(equations: &impl Zeros, start: &[f64]) -> Result<Refined, NoBox> {
    let mut at = start.to_vec();
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let point: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
        let inverse = inverse(equations.size(), &equations.slope(&point)).ok_or(NoBox::Singular)?;
        let value = equations.value(&point)?;
        let value = Mat::from_fn(equations.size(), 1, |row, _| value[row].mid());
        let step = &inverse * value;
        let next: Vec<f64> = at.iter().enumerate().map(|(k, x)| x - step[(k, 0)]).collect();
        let size = (0..at.len()).map(|k| step[(k, 0)].abs()).fold(0.0, f64::max);
        let away = next.iter().zip(start).any(|(x, from)| {
            let distance = (x - from).abs();
            distance.is_nan() || distance > REACH * (1.0 + from.abs())
        });
        if away {
            return Err(NoBox::NotConverged);
        }
        // At the level of rounding the steps stop shrinking.
        if size >= 0.5 * last || size <= 0.0 {
            return Ok(Refined { at, inverse });
        }
        at = next;
        last = size;
    }
    Err(NoBox::NotConverged)
}

/// The inverse of the middle of a matrix of intervals, if double precision has one.
pub(super) fn inverse(size: usize, entries: &[Entry]) -> Option<Mat<f64>> {
    let inverse = dense(size, entries).partial_piv_lu().inverse();
    let finite = inverse.col_iter().all(|column| column.iter().all(|x| x.is_finite()));
    finite.then_some(inverse)
}

/// The middle of a matrix of intervals.
pub(super) fn dense(size: usize, entries: &[Entry]) -> Mat<f64> {
    let mut matrix = Mat::zeros(size, size);
    for (row, column, value) in entries {
        matrix[(*row, *column)] += value.mid();
    }
    matrix
}
