//! Newton's method on the equations, in double precision: from an answer to the zero next to it. No
//! proof.

use model::NoBox;
use nalgebra::DMatrix;
use numerics::Interval;

use super::equations::{Entry, Equations};
use super::inverse::Inverse;

/// Steps from an answer that is good to some digits; quadratic convergence needs three.
const STEPS: usize = 8;

/// A step that has not fallen to this part of the last one is at the level of rounding.
pub(super) const FALLS: f64 = 0.5;

/// An answer further from the zero than this, in units of the system's length and force, was none.
pub(super) const REACH: f64 = 1e-3;

/// A point at which the equations hold as far as double precision allows.
pub(crate) struct Refined {
    pub(super) at: Vec<f64>,
    /// Approximate inverse of the derivative there.
    pub(super) inverse: Inverse,
}

/// Refine an answer.
/// [`NoBox::Singular`] when the derivative is singular, [`NoBox::NotConverged`] when the steps lead
/// away.
pub(crate) fn refine(equations: &Equations, start: &[f64]) -> Result<Refined, NoBox> {
    refine_within(REACH, equations, start)
}

/// Refine a guess that may be so far from the zero.
/// As [`refine`].
pub(super) fn refine_within(
    reach: f64,
    equations: &Equations,
    start: &[f64],
) -> Result<Refined, NoBox> {
    let mut at = start.to_vec();
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let point: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
        let inverse =
            Inverse::of(equations.size, &equations.slope(&point)).ok_or(NoBox::Singular)?;
        let step: Vec<f64> =
            inverse.apply(&equations.value(&point)?).iter().map(|part| part.mid()).collect();
        let next: Vec<f64> = at.iter().zip(&step).map(|(x, step)| x - step).collect();
        let size = step.iter().map(|step| step.abs()).fold(0.0, f64::max);
        if far(reach, next.iter().copied(), start) {
            return Err(NoBox::NotConverged);
        }
        // At the level of rounding the steps stop shrinking.
        if size >= FALLS * last || size <= 0.0 {
            return Ok(Refined { at, inverse });
        }
        at = next;
        last = size;
    }
    Err(NoBox::NotConverged)
}

/// Whether a point is further than this from where it started.
pub(super) fn far(reach: f64, at: impl Iterator<Item = f64>, start: &[f64]) -> bool {
    at.zip(start).any(|(x, from)| {
        let distance = (x - from).abs();
        distance.is_nan() || distance > reach * (1.0 + from.abs())
    })
}

/// The middle of a matrix of intervals.
pub(super) fn dense(size: usize, entries: &[Entry]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(size, size);
    for (row, column, value) in entries {
        matrix[(*row, *column)] += value.mid();
    }
    matrix
}
