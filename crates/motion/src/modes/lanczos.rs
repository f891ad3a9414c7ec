//! Lanczos' method with full orthogonalisation. It ends where the Krylov space is exhausted, as with
//! many equal pendulums.

use matrices::dense::eigen;
use nalgebra::DMatrix;

/// A linear map.
pub(super) type Map<'a> = &'a dyn Fn(&[f64]) -> Vec<f64>;

/// Steps beyond two for each eigenvalue wanted or known: what the first ones take to settle.
const STEPS_BEYOND: usize = 60;

/// Steps between two looks at what is converged.
const LOOK: usize = 8;

/// Residual relative to the largest eigenvalue: some fifty rounding errors.
const CONVERGED: f64 = 1e-14;

/// Eigenvalues below this, relative to the largest, are those of what moves no mass: zero.
const NOTHING: f64 = 1e-13;

/// Eigenvalues and eigenvectors, of length one in a metric, of an operator that is symmetric in it
/// and has no large negative eigenvalues: largest first, those of the `count` largest that have
/// converged. With another number of eigenpairs `known` (and taken out of the operator) it begins
/// elsewhere.
pub(super) fn largest(
    operator: Map<'_>,
    metric: Map<'_>,
    size: usize,
    [count, known]: [usize; 2],
) -> Vec<(f64, Vec<f64>)> {
    let most = (2 * (count + known) + STEPS_BEYOND).min(size);
    let mut first = start(size, known);
    let length = across(&mut first, &[], metric);
    divide(&mut first, length);
    let mut basis = vec![first];
    let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    loop {
        let last = &basis[basis.len() - 1];
        let mut next = operator(last);
        let weighed = metric(&next);
        diagonal.push(dot(last, &weighed));
        let before = dot(&next, &weighed).sqrt();
        let length = across(&mut next, &basis, metric);
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

/// Take out of a vector what is along others of length one, twice; the length of what is left.
pub(super) fn across(w: &mut [f64], others: &[Vec<f64>], metric: Map<'_>) -> f64 {
    for _ in 0..2 {
        let weighed = metric(w);
        for q in others {
            let part = dot(q, &weighed);
            w.iter_mut().zip(q).for_each(|(x, q)| *x -= part * q);
        }
    }
    dot(w, &metric(w)).sqrt()
}

/// The converged ones of the `count` largest eigenpairs of the tridiagonal matrix.
fn converged(diagonal: &[f64], beside: &[f64], last: f64, count: usize) -> Vec<(f64, Vec<f64>)> {
    let steps = diagonal.len();
    let tridiagonal = DMatrix::from_fn(steps, steps, |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    });
    let Some((values, vectors)) = eigen(&tridiagonal) else { return Vec::new() };
    let scale = values[0].abs().max(values[steps - 1].abs());
    let pairs = values.iter().zip(vectors.as_slice().chunks_exact(steps)).rev().take(count);
    let told = pairs.filter(|(value, vector)| {
        last * vector[steps - 1].abs() <= CONVERGED * scale && **value > NOTHING * scale
    });
    told.map(|(value, vector)| (*value, vector.to_vec())).collect()
}

pub(super) fn combined(basis: &[Vec<f64>], parts: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; basis[0].len()];
    for (q, part) in basis.iter().zip(parts) {
        sum.iter_mut().zip(q).for_each(|(x, q)| *x += part * q);
    }
    sum
}

/// A vector with parts in every direction, the same whenever it is asked for: a Weyl sequence
/// of the golden ratio.
fn start(size: usize, known: usize) -> Vec<f64> {
    let (step, turn) = (0.618_033_988_749_894_9, 0.381_966_011_250_105_2);
    let at = |k: usize| (k as f64).mul_add(step, (known as f64) * turn);
    (0..size).map(|k| at(k) - at(k).floor() - 0.5).collect()
}

pub(super) fn divide(w: &mut [f64], by: f64) {
    for x in w {
        *x /= by;
    }
}

pub(crate) fn length(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

/// The product of two vectors.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever their unit, the largest are found, with their axes.
    #[test]
    fn eigenvalues_of_any_size() {
        for unit in [1e-20, 1.0, 1e20] {
            // In the metric of 1, 2, 3.., in which it is symmetric.
            let by = |w: &[f64], of: &dyn Fn(f64) -> f64| -> Vec<f64> {
                w.iter().zip(0..40).map(|(w, k)| w * of(f64::from(k))).collect()
            };
            let operator = |w: &[f64]| by(w, &|k| unit * k);
            let found = largest(&operator, &|w| by(w, &|k| 1.0 + k), 40, [3, 0]);
            assert_eq!(found.len(), 3, "{unit}");
            for ((value, axis), k) in found.iter().zip([39.0, 38.0, 37.0]) {
                assert!((value / unit - k).abs() < 1e-11, "{value} {k}");
                let parts = operator(axis).into_iter().zip(axis);
                let off = parts.fold(0.0, |most: f64, (a, x)| most.max((a - value * x).abs()));
                assert!(off < 1e-11 * unit, "{off}");
            }
        }
    }
}
