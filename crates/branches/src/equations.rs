//! The equations of equilibrium along a path, with derivatives.

use matrices::dense::{Lu, complement};
use nalgebra::{DMatrix, DVector};

use crate::path::{Path, PlanarChain};

/// Half the step of the difference quotient by the position. Only the direction in which a curve is
/// predicted depends on it, and that the corrector makes good.
const POSITION_STEP: f64 = 1e-6;

/// Newton steps of a correction: quadratic convergence needs fewer, from near by.
const CORRECTIONS: usize = 12;

/// A correction smaller than this is the last: angles and pulls are of order one.
const CORRECTED: f64 = 1e-13;

/// A point with a residual above this is no equilibrium.
pub(crate) const RESIDUAL: f64 = 1e-11;

/// Rounding of one equation, whose parts are of order one.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// What the equations leave at `y`: n moments, two of the closure, and the size of the pull.
pub(crate) fn residual(plane: &PlanarChain, y: &DVector<f64>) -> DVector<f64> {
    let n = plane.length.len();
    let [h, v, w] = [y[n], y[n + 1], y[n + 2]];
    let mut f = DVector::zeros(n + 3);
    f[n] = -plane.span[0];
    f[n + 1] = -plane.span[1];
    for i in 0..n {
        let (sin, cos) = y[i].sin_cos();
        f[i] = h * cos + (v + w * plane.weight[i]) * sin;
        f[n] += plane.length[i] * sin;
        f[n + 1] -= plane.length[i] * cos;
    }
    f[n + 2] = h * h + v * v + w * w - 1.0;
    f
}

/// The residual's derivatives by the n + 3 unknowns, and in the last column by the position; one
/// row is left free.
fn jacobian(path: &Path<'_>, plane: &PlanarChain, y: &DVector<f64>) -> DMatrix<f64> {
    let n = plane.length.len();
    let [h, v, w] = [y[n], y[n + 1], y[n + 2]];
    let mut j = DMatrix::zeros(n + 4, n + 4);
    for i in 0..n {
        let (sin, cos) = y[i].sin_cos();
        let vertical = v + w * plane.weight[i];
        j[(i, i)] = vertical * cos - h * sin;
        j[(i, n)] = cos;
        j[(i, n + 1)] = sin;
        j[(i, n + 2)] = plane.weight[i] * sin;
        j[(n, i)] = plane.length[i] * cos;
        j[(n + 1, i)] = plane.length[i] * sin;
    }
    for (k, part) in [h, v, w].into_iter().enumerate() {
        j[(n + 2, n + k)] = 2.0 * part;
    }
    let position = y[n + 3];
    let ahead = residual(&path.plane(position + POSITION_STEP), y);
    let behind = residual(&path.plane(position - POSITION_STEP), y);
    for (row, slope) in ((ahead - behind) / (2.0 * POSITION_STEP)).iter().enumerate() {
        j[(row, n + 3)] = *slope;
    }
    j
}

/// Solve the equations with one more, `row · (y − y₀) = offset`, from `y₀` on; `None` if that
/// fails.
pub(crate) fn correct(
    path: &Path<'_>,
    mut y: DVector<f64>,
    row: &DVector<f64>,
) -> Option<DVector<f64>> {
    let n = path.bars();
    let start = y.clone();
    let mut best = f64::INFINITY;
    for _ in 0..CORRECTIONS {
        let plane = path.plane(y[n + 3]);
        let f = residual(&plane, &y);
        let mut j = jacobian(path, &plane, &y);
        j.row_mut(n + 3).copy_from(&row.transpose());
        let mut right = f.push(row.dot(&(&y - &start)));
        right.neg_mut();
        let step = Lu::new(&j)?.solve(&right);
        let size = step.amax();
        y += step;
        if !size.is_finite() {
            return None;
        }
        // Done, or as near as rounding lets it come.
        if size <= CORRECTED || (size >= best && best <= CORRECTED.sqrt()) {
            break;
        }
        best = size;
    }
    let left = residual(&path.plane(y[n + 3]), &y).amax();
    (left <= RESIDUAL).then_some(y)
}

/// The unit tangent of a curve, and on which side of the curve it is.
#[derive(Debug, Clone)]
pub(crate) struct Tangent {
    pub(crate) t: DVector<f64>,
    /// Sign of the determinant of the derivatives with t as their last row. Along one curve it
    /// changes where another crosses, and nowhere else: not in folds, not where the chain is
    /// straight.
    pub(crate) side: f64,
}

/// The unit tangent of the curve at `y`, on the side of `along`.
pub(crate) fn tangent(path: &Path<'_>, y: &DVector<f64>, along: &DVector<f64>) -> Option<Tangent> {
    let n = path.bars();
    let mut j = jacobian(path, &path.plane(y[n + 3]), y);
    j.row_mut(n + 3).copy_from(&along.transpose());
    let mut right = DVector::zeros(n + 4);
    right[n + 3] = 1.0;
    let factors = Lu::new(&j)?;
    let t = factors.solve(&right);
    let size = t.norm();
    // `along` in the last row has the sign that t has there: t is on its side.
    let side = factors.determinant().signum();
    (size.is_finite() && size > 0.0).then(|| Tangent { t: t / size, side })
}

/// How far the position of a fold may be off, by rounding: with the left null vector ψ of the
/// derivatives by the unknowns, an error r of the residual moves the fold by ψ·r / ψ·∂F/∂position.
/// Where another curve meets the fold, the divisor vanishes.
pub(crate) fn fold_error(path: &Path<'_>, y: &DVector<f64>) -> f64 {
    let n = path.bars();
    let j = jacobian(path, &path.plane(y[n + 3]), y);
    let by_unknowns = j.view((0, 0), (n + 3, n + 3)).into_owned();
    let left = complement(&by_unknowns, n + 2);
    let psi = left.as_slice();
    let slope: f64 = (0..n + 3).map(|k| psi[k] * j[(k, n + 3)]).sum();
    let rounding = ROUNDING * psi.iter().map(|part| part.abs()).sum::<f64>();
    // Twice: of two folds that touch, the slope falls to nothing on the way.
    let error = 2.0 * rounding / slope.abs();
    if error.is_nan() { f64::INFINITY } else { error.max(f64::EPSILON) }
}

/// The direction in which only the position changes.
pub(crate) fn position_axis(bars: usize) -> DVector<f64> {
    let mut axis = DVector::zeros(bars + 4);
    axis[bars + 3] = 1.0;
    axis
}
