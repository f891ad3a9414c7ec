//! Displacements that keep the lengths exactly, next to approximate ones.
//!
//! With `S = R R̃ᵀ` and an approximate inverse `C`: if `‖I − C S‖ ≤ β < 1`, the rows of `R` are
//! independent, and `S W = R X̃` has one solution with `|W − C R X̃| ≤ β/(1 − β) ‖C R X̃‖`, column by
//! column. `X = X̃ − R̃ᵀ W` has `R X = 0`.

use nalgebra::DMatrix;
use numerics::Interval;

use super::pencil::Row;
use super::{NotEnclosed, less_unit, norm};

/// `X`, a column for each column of `X̃`.
pub(super) fn displacements(
    rows: &[Row],
    about: &DMatrix<f64>,
) -> Result<DMatrix<Interval>, NotEnclosed> {
    let mut kept = about.map(Interval::point);
    if rows.is_empty() {
        return Ok(kept);
    }
    let mut middle = DMatrix::<f64>::zeros(rows.len(), about.nrows());
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
    let inverse = matrices::dense::inverse(&squared.map(Interval::mid));
    let inverse = inverse.ok_or_else(|| dependent(f64::INFINITY))?.map(Interval::point);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// `R = (r, 1)` with r from 0.8 to 1.2, `R̃ = (1, 1)`: `S = r + 1`, `C = 1/2`, `β = 1/10`. Of (0, 1) the multiplier
    /// is 1/2 and off by a ninth of it at most, as it is for r = 0.8: `(-1, r)/(r + 1)` keeps the length. Of (2, 0) it
    /// is within r, from 0.8 to 1.2, and a ninth of 1.2.
    #[test]
    fn displacements_keep_all_lengths_of_a_box() {
        let rows = [vec![(0, Interval::new(0.8, 1.2)), (1, Interval::ONE)]];
        let kept = displacements(&rows, &DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 1.0, 0.0]));
        let kept = kept.unwrap();
        let off = 1.2 / 9.0;
        for (at, [lo, hi]) in [
            ((0, 0), [-5.0 / 9.0, -4.0 / 9.0]),
            ((1, 0), [4.0 / 9.0, 5.0 / 9.0]),
            ((0, 1), [0.8 - off, 1.2 + off]),
            ((1, 1), [-1.2 - off, -0.8 + off]),
        ] {
            let found = kept[at];
            assert!(found.lo() <= lo && found.hi() >= hi, "{at:?}: {found:?}");
            assert!(lo - found.lo() < 1e-14 && found.hi() - hi < 1e-14, "{at:?}: {found:?}");
        }
        let twice = [rows[0].clone(), rows[0].clone()];
        let refused = displacements(&twice, &DMatrix::zeros(2, 1));
        assert!(matches!(refused, Err(NotEnclosed::Dependent { .. })), "{refused:?}");
    }
}
