//! Small dense matrices: approximate inverses in double precision, and products with intervals.

use matrices::dense::inverse;
use nalgebra::DMatrix;
use numerics::Interval;

use crate::boxes::arithmetic::{product, sum};

/// Row after row.
#[derive(Debug, Clone)]
pub(in crate::net) struct Dense<T> {
    pub(in crate::net) rows: usize,
    pub(in crate::net) columns: usize,
    entries: Vec<T>,
}

impl<T: Copy> Dense<T> {
    pub(in crate::net) fn filled(rows: usize, columns: usize, entry: T) -> Self {
        Self { rows, columns, entries: vec![entry; rows * columns] }
    }

    pub(in crate::net) fn at(&self, row: usize, column: usize) -> T {
        self.entries[row * self.columns + column]
    }

    pub(in crate::net) fn set(&mut self, row: usize, column: usize, entry: T) {
        self.entries[row * self.columns + column] = entry;
    }

    pub(in crate::net) fn row(&self, row: usize) -> &[T] {
        &self.entries[row * self.columns..(row + 1) * self.columns]
    }
}

impl Dense<Interval> {
    pub(in crate::net) fn middle(&self) -> Dense<f64> {
        let entries = self.entries.iter().map(|entry| entry.mid()).collect();
        Dense { rows: self.rows, columns: self.columns, entries }
    }

    pub(in crate::net) fn add(&mut self, row: usize, column: usize, entry: Interval) {
        let before = self.at(row, column);
        self.set(row, column, sum(before, entry));
    }

    /// Add the first of these numbers to a column, from a row on.
    pub(in crate::net) fn add_to_column(
        &mut self,
        [row, column]: [usize; 2],
        parts: impl Iterator<Item = Interval>,
    ) {
        for (k, part) in parts.enumerate() {
            self.add(row + k, column, part);
        }
    }
}

impl Dense<f64> {
    /// The inverse of a square matrix; nothing where a pivot vanishes.
    pub(in crate::net) fn inverse(&self) -> Option<Self> {
        // Row after row it is its transpose by columns, and so is the inverse.
        let found = inverse(&DMatrix::from_column_slice(self.columns, self.rows, &self.entries))?;
        let entries = found.as_slice().to_vec();
        entries.iter().all(|entry| entry.is_finite()).then_some(Self { entries, ..*self })
    }

    /// An approximate left inverse of a matrix of full column rank, `(A^T A)^-1 A^T`.
    pub(in crate::net) fn left_inverse(&self) -> Option<Self> {
        let mut normal = Self::filled(self.columns, self.columns, 0.0);
        for i in 0..self.columns {
            for j in 0..self.columns {
                normal.set(i, j, (0..self.rows).map(|k| self.at(k, i) * self.at(k, j)).sum());
            }
        }
        let inverse = normal.inverse()?;
        let mut left = Self::filled(self.columns, self.rows, 0.0);
        for i in 0..self.columns {
            for k in 0..self.rows {
                left.set(i, k, (0..self.columns).map(|j| inverse.at(i, j) * self.at(k, j)).sum());
            }
        }
        Some(left)
    }

    /// The projection that takes out the columns of A, `I − A Y` with the left inverse Y.
    pub(in crate::net) fn complement(&self, left_inverse: &Self) -> Self {
        let mut rest = Self::filled(self.rows, self.rows, 0.0);
        for i in 0..self.rows {
            for j in 0..self.rows {
                let taken: f64 =
                    (0..self.columns).map(|k| self.at(i, k) * left_inverse.at(k, j)).sum();
                rest.set(i, j, f64::from(u8::from(i == j)) - taken);
            }
        }
        rest
    }

    /// The product with a vector of intervals.
    pub(in crate::net) fn times(&self, vector: &[Interval]) -> Vec<Interval> {
        (0..self.rows)
            .map(|row| {
                let terms = self.row(row).iter().zip(vector);
                terms.fold(Interval::ZERO, |all, (c, x)| sum(all, product(Interval::point(*c), *x)))
            })
            .collect()
    }

    /// The product with a matrix of intervals.
    pub(in crate::net) fn times_matrix(&self, other: &Dense<Interval>) -> Dense<Interval> {
        let mut all = Dense::filled(self.rows, other.columns, Interval::ZERO);
        for row in 0..self.rows {
            for (k, factor) in self.row(row).iter().enumerate().filter(|(_, c)| c.abs() > 0.0) {
                for column in 0..other.columns {
                    let term = product(Interval::point(*factor), other.at(k, column));
                    all.add(row, column, term);
                }
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverses_of_known_matrices() {
        let mut matrix = Dense::filled(2, 2, 0.0);
        for (k, entry) in [0.0, 2.0, 4.0, 6.0].into_iter().enumerate() {
            matrix.set(k / 2, k % 2, entry);
        }
        // [[0, 2], [4, 6]]^-1 = [[-6, 2], [4, 0]] / 8.
        let inverse = matrix.inverse().unwrap();
        assert_eq!([inverse.row(0), inverse.row(1)], [[-0.75, 0.25], [0.5, 0.0]]);
        assert!(Dense::filled(2, 2, 1.0).inverse().is_none());
        // The column (3, 4): the left inverse (3, 4)/25, and what is left is along (4, -3).
        let mut column = Dense::filled(2, 1, 3.0);
        column.set(1, 0, 4.0);
        let left = column.left_inverse().unwrap();
        assert!((left.at(0, 0) - 0.12).abs() < 1e-16 && (left.at(0, 1) - 0.16).abs() < 1e-16);
        let rest = column.complement(&left);
        assert!((rest.at(0, 0) - 0.64).abs() < 1e-15 && (rest.at(0, 1) + 0.48).abs() < 1e-15);
    }
}
