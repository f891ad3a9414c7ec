//! Small dense matrices: approximate inverses in double precision, and products with intervals.

use matrices::dense::inverse;
use nalgebra::DMatrix;
use numerics::Interval;

use crate::boxes::arithmetic::{product, sum};

pub(in crate::net) type Dense = DMatrix<Interval>;

pub(in crate::net) fn zeros(rows: usize, columns: usize) -> Dense {
    DMatrix::from_element(rows, columns, Interval::ZERO)
}

pub(in crate::net) fn add(matrix: &mut Dense, at: (usize, usize), entry: Interval) {
    matrix[at] = sum(matrix[at], entry);
}

/// Add these numbers to a column, from a row on.
pub(super) fn add_to_column(matrix: &mut Dense, (row, column): (usize, usize), parts: &[Interval]) {
    for (k, part) in parts.iter().enumerate() {
        add(matrix, (row + k, column), *part);
    }
}

/// The inverse of the middle; nothing where a pivot vanishes.
pub(in crate::net) fn inverse_of_middle(matrix: &Dense) -> Option<DMatrix<f64>> {
    inverted(&matrix.map(Interval::mid))
}

fn inverted(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let found = inverse(&matrix.transpose())?.transpose();
    found.iter().all(|entry| entry.is_finite()).then_some(found)
}

/// An approximate left inverse of a matrix of full column rank, `(A^T A)^-1 A^T`.
pub(super) fn left_inverse(a: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let (rows, columns) = a.shape();
    let normal = |i, j| (0..rows).map(|k| a[(k, i)] * a[(k, j)]).sum();
    let inverse = inverted(&DMatrix::from_fn(columns, columns, normal))?;
    let left = |i, k| (0..columns).map(|j| inverse[(i, j)] * a[(k, j)]).sum();
    Some(DMatrix::from_fn(columns, rows, left))
}

/// The projection that takes out the columns of A, `I − A Y` with the left inverse Y.
pub(super) fn complement(a: &DMatrix<f64>, left_inverse: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(a.nrows(), a.nrows(), |i, j| {
        let taken: f64 = (0..a.ncols()).map(|k| a[(i, k)] * left_inverse[(k, j)]).sum();
        f64::from(u8::from(i == j)) - taken
    })
}

pub(in crate::net) fn times(matrix: &DMatrix<f64>, vector: &[Interval]) -> Vec<Interval> {
    let dot = |row: usize| {
        let row = matrix.row(row);
        let terms = row.iter().zip(vector).map(|(c, x)| product(Interval::point(*c), *x));
        terms.fold(Interval::ZERO, sum)
    };
    (0..matrix.nrows()).map(dot).collect()
}

pub(in crate::net) fn times_matrix(matrix: &DMatrix<f64>, other: &Dense) -> Dense {
    let columns = other.column_iter().flat_map(|column| times(matrix, column.as_slice()));
    DMatrix::from_iterator(matrix.nrows(), other.ncols(), columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverses_of_known_matrices() {
        let inverse = inverted(&DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 4.0, 6.0])).unwrap();
        assert_eq!(inverse, DMatrix::from_row_slice(2, 2, &[-0.75, 0.25, 0.5, 0.0]));
        assert!(inverted(&DMatrix::from_element(2, 2, 1.0)).is_none());
        // The column (3, 4): the left inverse (3, 4)/25, and what is left is along (4, -3).
        let column = DMatrix::from_row_slice(2, 1, &[3.0, 4.0]);
        let left = left_inverse(&column).unwrap();
        assert!((left[(0, 0)] - 0.12).abs() < 1e-16 && (left[(0, 1)] - 0.16).abs() < 1e-16);
        let rest = complement(&column, &left);
        assert!((rest[(0, 0)] - 0.64).abs() < 1e-15 && (rest[(0, 1)] + 0.48).abs() < 1e-15);
    }
}
