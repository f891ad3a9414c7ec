//! Lanczos' method with full orthogonalisation.
//!
//! Not the partial eigensolver of `faer`: that does not end where the Krylov space is exhausted, as
//! with many equal pendulums.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// A symmetric operator without large negative eigenvalues.
pub(super) trait Operator {
    /// Number of coordinates.
    fn size(&self) -> usize;

    /// The operator on a vector.
    fn apply(&self, w: &[f64]) -> Vec<f64>;
}

/// Steps beyond two for each eigenvalue wanted or known: what the first ones take to settle.
const STEPS_BEYOND: usize = 60;

/// Steps between two looks at what is converged.
const LOOK: usize = 8;

/// Residual relative to the largest eigenvalue: some fifty rounding errors.
const CONVERGED: f64 = 1e-14;

/// Eigenvalues below this, relative to the largest, are those of what moves no mass: zero.
const NOTHING: f64 = 1e-13;

/// Eigenvalues and unit eigenvectors, largest first: those of the `count` largest that have
/// converged. With another number of eigenpairs `known` (and taken out of the operator) it begins
/// elsewhere.
pub(super) fn largest(
    operator: &impl Operator,
    count: usize,
    known: usize,
) -> Vec<(f64, Vec<f64>)> {
    let size = operator.size();
    let most = (2 * (count + known) + STEPS_BEYOND).min(size);
    let mut basis: Vec<Vec<f64>> = vec![start(size, known)];
    let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    loop {
        let steps = diagonal.len();
        let mut next = operator.apply(&basis[steps]);
        diagonal.push(dot(&basis[steps], &next));
        let before = dot(&next, &next).sqrt();
        for _ in 0..2 {
            for q in &basis {
                let part = dot(q, &next);
                next.iter_mut().zip(q).for_each(|(x, q)| *x -= part * q);
            }
        }
        let length = dot(&next, &next).sqrt();
        let steps = diagonal.len();
        let is_exhausted = length <= f64::EPSILON * before || length.is_nan();
        let ended = is_exhausted || steps == most;
        if ended || (steps >= count && steps % LOOK == 0) {
            let last = if is_exhausted { 0.0 } else { length };
            let found = converged(&diagonal, &beside, last, count);
            if ended || found.len() == count {
                return found.iter().map(|(theta, s)| (*theta, combined(&basis, s))).collect();
            }
        }
        divide(&mut next, length);
        beside.push(length);
        basis.push(next);
    }
}

/// The converged ones of the `count` largest eigenpairs of the tridiagonal matrix.
fn converged(
    diagonal: &[f64],
    beside: &[f64],
    last: f64,
    count: usize,
) -> Vec<(f64, DVector<f64>)> {
    let steps = diagonal.len();
    let tridiagonal = DMatrix::from_fn(steps, steps, |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    });
    let eigen = SymmetricEigen::new(tridiagonal);
    let mut order: Vec<usize> = (0..steps).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let scale = eigen.eigenvalues.amax();
    let told = order.into_iter().take(count).filter(|&k| {
        let residual = last * eigen.eigenvectors[(steps - 1, k)].abs();
        residual <= CONVERGED * scale && eigen.eigenvalues[k] > NOTHING * scale
    });
    told.map(|k| (eigen.eigenvalues[k], eigen.eigenvectors.column(k).into_owned())).collect()
}

fn combined(basis: &[Vec<f64>], parts: &DVector<f64>) -> Vec<f64> {
    let mut sum = vec![0.0; basis[0].len()];
    for (q, part) in basis.iter().zip(parts.iter()) {
        sum.iter_mut().zip(q).for_each(|(x, q)| *x += part * q);
    }
    sum
}

/// A unit vector with parts in every direction, the same whenever it is asked for: a Weyl sequence
/// of the golden ratio.
fn start(size: usize, known: usize) -> Vec<f64> {
    let (step, turn) = (0.618_033_988_749_894_9, 0.381_966_011_250_105_2);
    let at = |k: usize| (k as f64).mul_add(step, (known as f64) * turn);
    let mut w: Vec<f64> = (0..size).map(|k| at(k) - at(k).floor() - 0.5).collect();
    let length = dot(&w, &w).sqrt();
    divide(&mut w, length);
    w
}

/// Divide a vector.
pub(super) fn divide(w: &mut [f64], by: f64) {
    for x in w {
        *x /= by;
    }
}

/// The product of two vectors.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Diagonal(Vec<f64>);

    impl Operator for Diagonal {
        fn size(&self) -> usize {
            self.0.len()
        }

        fn apply(&self, w: &[f64]) -> Vec<f64> {
            w.iter().zip(&self.0).map(|(w, d)| w * d).collect()
        }
    }

    /// Whatever their unit, the largest are found, with their axes.
    #[test]
    fn eigenvalues_of_any_size() {
        for unit in [1e-20, 1.0, 1e20] {
            let operator = Diagonal((0..40).map(|k| unit * f64::from(k)).collect());
            let found = largest(&operator, 3, 0);
            assert_eq!(found.len(), 3, "{unit}");
            for ((value, axis), k) in found.iter().zip([39.0, 38.0, 37.0]) {
                assert!((value / unit - k).abs() < 1e-11, "{value} {k}");
                let parts = operator.apply(axis).into_iter().zip(axis);
                let off = parts.fold(0.0, |most: f64, (a, x)| most.max((a - value * x).abs()));
                assert!(off < 1e-11 * unit, "{off}");
            }
        }
    }
}
