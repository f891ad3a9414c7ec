//! The equations with one row and one column more, regular where their matrix alone is not.

use nalgebra::DVector;

use super::Equations;

/// Corrections by what is left: with an exact factor one brings it to rounding.
const CORRECTIONS: usize = 8;
/// What is left of the right-hand side when a solution is as good as it gets.
const ROUNDING: f64 = 1e-14;

/// One more row: $c \cdot y + d\\,t$.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) y: DVector<f64>,
    pub(super) t: f64,
}

impl Row {
    /// The parameter alone.
    pub(super) fn parameter(size: usize) -> Self {
        Self { y: DVector::zeros(size), t: 1.0 }
    }

    pub(super) fn dot(&self, y: &DVector<f64>, t: f64) -> f64 {
        self.y.dot(y) + self.t * t
    }
}

/// $\begin{bmatrix} J & b \\\\ c^T & d \end{bmatrix}$ by mixed block elimination, which survives a
/// singular $J$.
pub(super) struct Bordered<'a> {
    column: &'a DVector<f64>,
    pub(super) row: &'a Row,
    /// $J^{-T} c$ and $J^{-1} b$.
    by_row: DVector<f64>,
    by_column: DVector<f64>,
    /// $d - c \cdot J^{-1} b$ from either side.
    pivots: [f64; 2],
}

impl<'a> Bordered<'a> {
    pub(super) fn new(
        equations: &mut impl Equations,
        column: &'a DVector<f64>,
        row: &'a Row,
    ) -> Self {
        // J is symmetric.
        let (by_row, by_column) = (equations.solve(&row.y), equations.solve(column));
        let pivots = [row.t - by_row.dot(column), row.t - row.y.dot(&by_column)];
        Self { column, row, by_row, by_column, pivots }
    }

    fn once(
        &self,
        equations: &mut impl Equations,
        (f, g): (&DVector<f64>, f64),
    ) -> (DVector<f64>, f64) {
        let first = (g - self.by_row.dot(f)) / self.pivots[0];
        let rest = f - self.column * first;
        let part = equations.solve(&rest);
        let second = (g - self.row.t * first - self.row.y.dot(&part)) / self.pivots[1];
        (part - &self.by_column * second, first + second)
    }

    /// The solution, and the part of the right-hand side that it leaves.
    pub(super) fn solve(
        &self,
        equations: &mut impl Equations,
        (f, g): (&DVector<f64>, f64),
    ) -> Option<(DVector<f64>, f64)> {
        let scale = f.norm().max(g.abs());
        let (mut y, mut t) = (DVector::zeros(f.len()), 0.0);
        let (mut left, mut left_g, mut last) = (f.clone(), g, f64::INFINITY);
        for _ in 0..CORRECTIONS {
            let (more, more_t) = self.once(equations, (&left, left_g));
            let (next, next_t) = (&y + more, t + more_t);
            left = f - equations.apply(&next) - self.column * next_t;
            left_g = g - self.row.dot(&next, next_t);
            let size = left.norm().max(left_g.abs());
            let helps = size < last;
            if helps {
                (y, t, last) = (next, next_t, size);
            }
            if !helps || size <= ROUNDING * scale {
                break;
            }
        }
        last.is_finite().then_some((y, t))
    }
}
