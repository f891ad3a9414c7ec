//! The stiffness less a shift, bordered by the constraints, and its sparse factorisation.
//!
//! $$ \begin{bmatrix} K - \sigma M + \gamma R^T R & R^T \\\\ R & 0 \end{bmatrix} $$
//!
//! has, with `m` independent rows, `m` negative eigenvalues and one more for each `ω² < σ`
//! (Sylvester's law of inertia; N. I. M. Gould, Math. Programming 32 (1985) 90-99): the signs of
//! the pivots count the modes below a shift. `γ` changes nothing where `R y = 0`; with it the block
//! is definite for shifts below all `ω²`, as the elimination without pivoting asks for. The rows of
//! the constraints are eliminated after their joints.

use matrices::sparse::{self, Ldlt, Pivots};

use super::stiffness::{Entries, Entry};

/// A pivot that is less than this, with all diagonals of the order of one, is none: a constraint
/// that depends on others, or a shift on an eigenvalue.
const NO_PIVOT: f64 = 1e-11;

/// `γ` in units of the diagonal of `K − σM` around a row: enough to lift what the forces of the bar
/// take away.
const LIFT: f64 = 10.0;

/// Corrections of a solution by what is left over.
const REFINEMENTS: usize = 2;

pub(super) struct Shifted {
    /// Places of the coordinates and of the rows in the order of elimination.
    coordinate_at: Vec<usize>,
    /// Scale of each unknown: all diagonals become of the order of one.
    scale: Vec<f64>,
    matrix: sparse::Entries,
    factor: Ldlt,
    /// Number of constraints that do not depend on others.
    pub independent: usize,
    /// Number of `ω²` below the shift; none where the shift is on one of them.
    pub below: Option<usize>,
}

impl Shifted {
    /// Factorise; none when memory does not suffice or a number overflows.
    pub(super) fn new(entries: &Entries, axes: usize, shift: f64) -> Option<Self> {
        let order = Order::new(entries, axes);
        let unknowns = order.unknowns;
        let (scale, triplets) = order.triplets(entries, shift);
        let matrix = sparse::Entries::new(unknowns, &triplets);
        // The unknowns are in their order already.
        let same: Vec<usize> = (0..unknowns).collect();
        let mut factor = Ldlt::new(&matrix.starts, &matrix.rows, &same)?;
        let no_pivots = Pivots::Replaced { least: NO_PIVOT, instead: NO_PIVOT.recip() };
        if !factor.factorise(&matrix.values, no_pivots) {
            return None;
        }
        let mut is_row = vec![true; unknowns];
        for &at in &order.coordinate_at {
            is_row[at] = false;
        }
        let mut found = Self {
            coordinate_at: order.coordinate_at,
            scale,
            matrix,
            factor,
            independent: 0,
            below: None,
        };
        found.count(&is_row);
        Some(found)
    }

    /// Count the signs of the pivots.
    fn count(&mut self, is_row: &[bool]) {
        let (mut negative, mut dependent, mut on_a_mode) = (0, 0, false);
        for (pivot, &is_row) in self.factor.pivots().iter().zip(is_row) {
            if pivot.abs() >= 0.5 / NO_PIVOT {
                dependent += usize::from(is_row);
                on_a_mode |= !is_row;
            } else {
                negative += usize::from(*pivot < 0.0);
            }
        }
        let rows = is_row.iter().filter(|&&row| row).count();
        self.independent = rows - dependent;
        self.below = negative.checked_sub(self.independent).filter(|_| !on_a_mode);
    }

    /// The displacements `y` with `K y − σ M y + Rᵀ μ = f` and `R y = 0`.
    pub(super) fn solve(&self, f: &[f64]) -> Vec<f64> {
        let unknowns = self.scale.len();
        let mut right = vec![0.0; unknowns];
        for (f, &at) in f.iter().zip(&self.coordinate_at) {
            right[at] = f * self.scale[at];
        }
        let mut x = vec![0.0; unknowns];
        let mut left = right.clone();
        for _ in 0..=REFINEMENTS {
            self.factor.solve(&mut left);
            for (x, by) in x.iter_mut().zip(&left) {
                *x += by;
            }
            left.copy_from_slice(&right);
            self.subtract_product(&x, &mut left);
        }
        let y = self.coordinate_at.iter().map(|&at| x[at] * self.scale[at]);
        y.collect()
    }

    /// Take the matrix times `x` from `left`.
    fn subtract_product(&self, x: &[f64], left: &mut [f64]) {
        for (row, column, at) in self.matrix.places() {
            let value = self.matrix.values[at];
            left[row] -= value * x[column];
            if row != column {
                left[column] -= value * x[row];
            }
        }
    }
}

/// The order of elimination: joints as they are stored, each with the rows that are complete with
/// it.
struct Order {
    unknowns: usize,
    coordinate_at: Vec<usize>,
    /// Of each row, empty ones have none.
    row_at: Vec<Option<usize>>,
}

impl Order {
    fn new(entries: &Entries, axes: usize) -> Self {
        let rows = entries.rows.iter().map(|entry| entry.0 + 1).max().unwrap_or(0);
        let mut last: Vec<Option<usize>> = vec![None; rows];
        for &(row, column, value) in &entries.rows {
            if value.abs() > 0.0 {
                last[row] = last[row].max(Some(column / axes));
            }
        }
        let mut complete: Vec<Vec<usize>> = vec![Vec::new(); entries.size / axes];
        for (row, slot) in last.iter().enumerate() {
            if let Some(slot) = slot {
                complete[*slot].push(row);
            }
        }
        let mut found = Self { unknowns: 0, coordinate_at: Vec::new(), row_at: vec![None; rows] };
        for list in &complete {
            for _ in 0..axes {
                found.coordinate_at.push(found.unknowns);
                found.unknowns += 1;
            }
            for &row in list {
                found.row_at[row] = Some(found.unknowns);
                found.unknowns += 1;
            }
        }
        found
    }

    /// The scales, and the entries on and below the diagonal, scaled.
    fn triplets(&self, entries: &Entries, shift: f64) -> (Vec<f64>, Vec<Entry>) {
        let mut all: Vec<Entry> = Vec::new();
        let mut around = vec![0.0; entries.size];
        for &(row, column, value) in &entries.stiffness {
            all.push((self.coordinate_at[row], self.coordinate_at[column], value));
            if row == column {
                around[row] += value.abs();
            }
        }
        for &(row, column, value) in &entries.inertia {
            all.push((self.coordinate_at[row], self.coordinate_at[column], -shift * value));
            if row == column {
                around[row] += (shift * value).abs();
            }
        }
        // Row by row: the entries of one stand together.
        for row in entries.rows.chunk_by(|a, b| a.0 == b.0) {
            let Some(at) = self.row_at[row[0].0] else { continue };
            let lift = LIFT * row.iter().map(|entry| around[entry.1]).fold(0.0, f64::max);
            for &(_, column, value) in row {
                all.push((at, self.coordinate_at[column], value));
                for &(_, other, by) in row {
                    let (i, j) = (self.coordinate_at[column], self.coordinate_at[other]);
                    all.push((i, j, lift * value * by));
                }
            }
        }
        let scale = self.scale(&all);
        let mut triplets = Vec::with_capacity(all.len());
        for (row, column, value) in all {
            // A row of the constraints stands below its coordinates.
            if row >= column {
                triplets.push((row, column, value * scale[row] * scale[column]));
            }
        }
        triplets.extend(self.row_at.iter().flatten().map(|&at| (at, at, 0.0)));
        (scale, triplets)
    }

    fn scale(&self, all: &[Entry]) -> Vec<f64> {
        let root = |x: f64| if x > 0.0 && x.is_finite() { 1.0 / x.sqrt() } else { 1.0 };
        let mut diagonal = vec![0.0; self.unknowns];
        for &(row, column, value) in all {
            if row == column {
                diagonal[row] += value;
            }
        }
        let mut scale: Vec<f64> = diagonal.iter().map(|d: &f64| root(d.abs())).collect();
        let mut of_rows = vec![0.0; self.unknowns];
        let mut is_row = vec![false; self.unknowns];
        for &at in self.row_at.iter().flatten() {
            is_row[at] = true;
        }
        for &(row, column, value) in all {
            if is_row[row] {
                of_rows[row] += (value * scale[column]).powi(2);
            }
        }
        for at in self.row_at.iter().flatten() {
            scale[*at] = root(of_rows[*at]);
        }
        scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two coordinates of a joint with `R = (3, 4)` and one of the next. Along `(4, -3)`, across `R`, the first joint has
    /// `(16 a + 9 b)/25`, the second `c`, of stiffness and inertia. The shifts take one diagonal to zero, which the
    /// elimination meets first, then the other; `R` bears what is left.
    #[test]
    fn a_diagonal_of_zero_is_lifted() {
        let (stiffness, inertia) = ([-6.0, 20.0, 9.0], [2.0, 5.0, 3.0]);
        let entries = Entries {
            size: 4,
            inertia: (0..3).map(|k| (k, k, inertia[k])).chain([(3, 3, 1.0)]).collect(),
            // In two parts, as of two members.
            stiffness: (0..3)
                .flat_map(|k| [(k, k, 0.75 * stiffness[k]), (k, k, 0.25 * stiffness[k])])
                .chain([(3, 3, 50.0)])
                .collect(),
            // The second one says the same as the first.
            rows: vec![(0, 0, 3.0), (0, 1, 4.0), (1, 0, 6.0), (1, 1, 8.0)],
        };
        let along = |of: [f64; 3]| (16.0 * of[0] + 9.0 * of[1]) / 25.0;
        // ω² are 3.36/3.08 = 1.09, 3 and 50.
        for (shift, below) in [(-3.0, 0), (1.0, 0), (2.0, 1), (4.0, 2), (51.0, 3)] {
            let shifted = Shifted::new(&entries, 2, shift).unwrap();
            assert_eq!((shifted.independent, shifted.below), (1, Some(below)), "{shift}");
            let y = shifted.solve(&[1.0, 0.5, 2.0, -1.0]);
            // The force along (4, -3)/5 is (4 - 1.5)/5.
            let first = 0.5 / (along(stiffness) - shift * along(inertia));
            let wanted =
                [0.8 * first, -0.6 * first, 2.0 / (9.0 - 3.0 * shift), -1.0 / (50.0 - shift)];
            for (found, wanted) in y.iter().zip(wanted) {
                assert!(
                    (found - wanted).abs() < 1e-10 * wanted.abs().max(0.1),
                    "{shift}: {y:?} {wanted}"
                );
            }
        }
    }
}
