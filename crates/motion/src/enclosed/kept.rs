//! Displacements that keep the lengths exactly, next to approximate ones.
//!
//! With `S = R R̃ᵀ` and an approximate inverse `C`: if `‖I − C S‖ ≤ β < 1`, the rows of `R` are
//! independent, and `S W = R X̃` has one solution with `|W − C R X̃| ≤ β/(1 − β) ‖C R X̃‖`, column by
//! column. `X = X̃ − R̃ᵀ W` has `R X = 0`.

use nalgebra::DMatrix;
use numerics::Interval;

use super::pencil::Pencil;
use super::{NotEnclosed, less_unit, norm};

/// `X`, a column for each column of `X̃`.
pub(super) fn displacements(
    pencil: &Pencil,
    about: &DMatrix<f64>,
) -> Result<DMatrix<Interval>, NotEnclosed> {
    let rows = &pencil.rows;
    let mut kept = about.map(Interval::point);
    if rows.is_empty() {
        return Ok(kept);
    }
    let mut middle = DMatrix::<f64>::zeros(rows.len(), 3 * pencil.moving);
    for (i, row) in rows.iter().enumerate() {
        for (k, value) in row {
            middle[(i, *k)] = value.mid();
        }
    }
    let times = |columns: &DMatrix<f64>| {
        DMatrix::from_fn(rows.len(), columns.ncols(), |i, j| {
            rows[i].iter().map(|(k, value)| *value * Interval::point(columns[(*k, j)])).sum()
        })
    };
    let squared: DMatrix<Interval> = times(&middle.transpose());
    let dependent = |norm: f64| NotEnclosed::Dependent { norm };
    let inverse =
        squared.map(Interval::mid).try_inverse().ok_or_else(|| dependent(f64::INFINITY))?;
    let inverse = inverse.map(Interval::point);
    let beta = norm(&less_unit(product(&inverse, &squared)));
    if beta.is_nan() || beta >= 1.0 {
        return Err(dependent(beta));
    }
    let mut multipliers = product(&inverse, &times(about));
    let gain = Interval::point(beta) / (Interval::ONE - Interval::point(beta));
    for mut column in multipliers.column_iter_mut() {
        let largest = column.iter().map(|w| w.mag()).fold(0.0, numerics::vector::worse);
        let off = (gain * Interval::point(largest)).hi();
        column.apply(|w| *w = *w + Interval::new(-off, off));
    }
    for (i, row) in rows.iter().enumerate() {
        for (k, value) in row {
            for j in 0..kept.ncols() {
                let part = Interval::point(value.mid()) * multipliers[(i, j)];
                kept[(*k, j)] = kept[(*k, j)] - part;
            }
        }
    }
    Ok(kept)
}

fn product(a: &DMatrix<Interval>, b: &DMatrix<Interval>) -> DMatrix<Interval> {
    DMatrix::from_fn(a.nrows(), b.ncols(), |i, j| {
        (0..a.ncols()).map(|k| a[(i, k)] * b[(k, j)]).sum()
    })
}
