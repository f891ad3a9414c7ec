//! Linear buckling: where the stiffness at the start, with forces extrapolated, is singular.
//!
//! With $J_0$ at the start and its derivative $J'$ by the forces as they change along the path there, at
//! the places of the start,
//!
//! $$ (J_0 + t J')\\,\phi = 0, \qquad -J_0^{-1} J' \phi = \phi / t . $$
//!
//! The largest positive eigenvalue $1/t$ of this operator is found in a Krylov space (Arnoldi).

use matrices::dense::{complement, complex_eigenvalues};
use nalgebra::{DMatrix, DVector};

use super::bordered::Row;
use super::here::Here;
use super::singular::without_symmetry;
use super::walk::begin;
use super::{Equations, NoPath};

/// Dimension of the Krylov space at most.
const DIMENSION: usize = 48;
/// Step of the difference for $J'$, as a part of the range.
const STEP: f64 = 1e-4;
/// An eigenvalue is one to this part of it.
const CONVERGED: f64 = 1e-6;
/// Imaginary parts below this are rounding; so are eigenvalues below it, of the largest.
const REAL: f64 = 1e-7;

/// The parameter $t > 0$ at which the stiffness at the equilibrium at $t = 0$ next to `start` is first
/// singular, if places stay there and forces grow with $t$ as they begin to: the estimate of linear buckling.
/// Nothing where it is singular nowhere, or the iteration does not converge.
///
/// # Errors
///
/// [`NoPath`] where no path begins.
pub fn linear_buckling<Q: Equations>(
    equations: &mut Q,
    start: &DVector<f64>,
) -> Result<Option<f64>, NoPath<Q::Error>> {
    let (space, here) = begin(equations, start)?;
    let mut slope = Row { y: &here.tangent.y / here.tangent.t, t: 1.0 };
    slope.y.rows_mut(0, space.metric.places).fill(0.0);
    let mut operator = |v: &DVector<f64>| change(space.equations, &here, &slope, v);
    let Some(basis) = arnoldi(&mut operator, here.y.len()).map_err(NoPath::Numbers)? else {
        return Ok(None);
    };
    Ok(largest(&basis).map(f64::recip))
}

/// A vector, where there is one.
type Applied<E> = Result<Option<DVector<f64>>, E>;

/// $-J_0^{-1} J' v$.
fn change<Q: Equations>(
    equations: &mut Q,
    here: &Here,
    slope: &Row,
    v: &DVector<f64>,
) -> Applied<Q::Error> {
    let mut at = |step: f64| -> Applied<Q::Error> {
        let factor = equations.factorise(&(&here.y + &slope.y * step), here.t + step)?;
        Ok(factor.map(|_| equations.apply(v)))
    };
    let (Some(before), Some(after)) = (at(-STEP)?, at(STEP)?) else { return Ok(None) };
    if equations.factorise(&here.y, here.t)?.is_none() {
        return Ok(None);
    }
    Ok(Some(equations.solve(&((before - after) / (2.0 * STEP)))))
}

/// The operator in an orthonormal basis of its Krylov space, one row more than columns; nothing
/// where it vanishes.
fn arnoldi<E>(
    operator: &mut dyn FnMut(&DVector<f64>) -> Applied<E>,
    size: usize,
) -> Result<Option<DMatrix<f64>>, E> {
    // What the operator makes of anything is where its eigenvectors are.
    let Some(first) = operator(&without_symmetry(size))? else { return Ok(None) };
    let norm = first.norm();
    if norm.is_nan() || norm <= 0.0 {
        return Ok(None);
    }
    let most = DIMENSION.min(size);
    let mut basis = vec![first / norm];
    let mut small = DMatrix::zeros(most + 1, most);
    for column in 0..most {
        let Some(mut next) = operator(&basis[column])? else { return Ok(None) };
        let size = next.norm();
        // Twice is enough.
        for _ in 0..2 {
            for (row, one) in basis.iter().enumerate() {
                let part = one.dot(&next);
                small[(row, column)] += part;
                next.axpy(-part, one, 1.0);
            }
        }
        let left = next.norm();
        if left.is_nan() || left <= REAL * size {
            let all = column + 1;
            return Ok(Some(small.view((0, 0), (all + 1, all)).into_owned()));
        }
        small[(column + 1, column)] = left;
        basis.push(next / left);
    }
    Ok(Some(small))
}

/// The largest positive eigenvalue, if it has converged.
fn largest(small: &DMatrix<f64>) -> Option<f64> {
    let size = small.ncols();
    let square = small.view((0, 0), (size, size)).into_owned();
    let values = complex_eigenvalues(&square)?;
    let most = values.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
    let real = values.iter().filter(|[re, im]| im.abs() <= REAL * most && *re > REAL * most);
    let value = real.map(|[re, _]| *re).max_by(f64::total_cmp)?;
    let mut shifted = square.transpose();
    (0..size).for_each(|k| shifted[(k, k)] -= value);
    let vector = complement(&shifted, size - 1);
    let left = small[(size, size - 1)] * vector[size - 1].abs();
    (left <= CONVERGED * value).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The eigenvector of 2 has a thousandth in the last row: a rest of a thousandth counts as a millionth, in any unit.
    #[test]
    fn an_eigenvalue_converges_as_its_last_component() {
        for unit in [1e-6, 1.0] {
            let of = |rest: f64| {
                let small = [2.0, 1e-3, 1e-3, 1.0, 0.0, rest].map(|x| unit * x);
                largest(&DMatrix::from_row_slice(3, 2, &small))
            };
            assert!((of(1e-3).unwrap() / unit - 2.000_001).abs() < 1e-11);
            assert_eq!(of(3e-3), None);
        }
    }
}
