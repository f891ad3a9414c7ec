//! Symmetric matrices of size two to four: solve, eigenvalues.
//!
//! Everything that couples the bars is this small: the closure has three rows, the turn about
//! vertical anchors one more. Jacobi's method finds small eigenvalues beside large ones to all their digits, which the methods
//! of linear algebra libraries do not.

#![expect(clippy::needless_range_loop, reason = "row and column numbers, as in the formulas")]

use crate::thresholds::LOST;

/// The largest size: three rows of closure and one of the turn.
pub(crate) const MOST: usize = 4;

/// A column of up to [`MOST`] numbers; entries beyond the size are zero.
pub(crate) type Column = [f64; MOST];

/// A symmetric matrix of the given size, full storage.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Symmetric {
    pub(crate) size: usize,
    pub(crate) entry: [Column; MOST],
}

/// Sweeps of Jacobi's method; a 4 x 4 matrix needs five to seven.
const JACOBI_SWEEPS: usize = 30;

impl Symmetric {
    pub(crate) fn zero(size: usize) -> Self {
        Self { size, entry: [[0.0; MOST]; MOST] }
    }

    /// Make the direction of the unit column `e` a null vector: `(I - e eᵀ) A (I - e eᵀ)`.
    pub(crate) fn without(&mut self, e: Column) {
        let n = self.size;
        let ae: Column = std::array::from_fn(|i| (0..n).map(|k| self.entry[i][k] * e[k]).sum());
        let eae: f64 = (0..n).map(|k| e[k] * ae[k]).sum();
        for i in 0..n {
            for k in 0..n {
                self.entry[i][k] += eae * e[i] * e[k] - e[i] * ae[k] - ae[i] * e[k];
            }
        }
    }

    /// Solve by Cholesky; `None` when the matrix is not safely positive definite.
    pub(crate) fn solve(&self, rhs: Column) -> Option<Column> {
        let n = self.size;
        let mut f = self.entry;
        let mut x = rhs;
        for j in 0..n {
            let mut pivot = f[j][j];
            for k in 0..j {
                pivot -= f[j][k] * f[j][k];
            }
            if pivot.is_nan() || pivot <= LOST * self.entry[j][j] {
                return None;
            }
            let root = pivot.sqrt();
            f[j][j] = root;
            for i in j + 1..n {
                let mut s = f[i][j];
                for k in 0..j {
                    s -= f[i][k] * f[j][k];
                }
                f[i][j] = s / root;
            }
        }
        for i in 0..n {
            for k in 0..i {
                x[i] -= f[i][k] * x[k];
            }
            x[i] /= f[i][i];
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                x[i] -= f[k][i] * x[k];
            }
            x[i] /= f[i][i];
        }
        Some(x)
    }

    /// Eigenvalues and orthonormal eigenvectors by Jacobi's method.
    pub(crate) fn eigen(&self) -> Eigen {
        let n = self.size;
        let mut a = self.entry;
        let mut v = [[0.0; MOST]; MOST];
        for (k, row) in v.iter_mut().enumerate() {
            row[k] = 1.0;
        }
        for _ in 0..JACOBI_SWEEPS {
            let mut rotated = false;
            for p in 0..n {
                for q in p + 1..n {
                    // Far below the rounding of both diagonals the entry is nothing.
                    if a[p][q].abs() <= 0.01 * f64::EPSILON * (a[p][p] * a[q][q]).abs().sqrt() {
                        continue;
                    }
                    let Some((c, s)) = rotation(a[p][p], a[q][q], a[p][q]) else { continue };
                    rotated = true;
                    for row in a.iter_mut().take(n) {
                        (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                    }
                    for k in 0..n {
                        (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
                    }
                    a[p][q] = 0.0;
                    a[q][p] = 0.0;
                    for row in v.iter_mut().take(n) {
                        (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                    }
                }
            }
            if !rotated {
                break;
            }
        }
        let mut value = [0.0; MOST];
        let mut vector = [[0.0; MOST]; MOST];
        for k in 0..n {
            value[k] = a[k][k];
            for i in 0..n {
                vector[k][i] = v[i][k];
            }
        }
        Eigen { size: n, value, vector }
    }
}

/// Cosine and sine of the rotation that makes the off-diagonal entry zero.
fn rotation(app: f64, aqq: f64, apq: f64) -> Option<(f64, f64)> {
    let theta = (aqq - app) / (2.0 * apq);
    if theta.is_nan() || apq == 0.0 {
        return None;
    }
    let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
    let c = 1.0 / t.hypot(1.0);
    Some((c, t * c))
}

/// Eigenvalues `value[k]` with unit eigenvectors `vector[k]`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Eigen {
    pub(crate) size: usize,
    pub(crate) value: Column,
    pub(crate) vector: [Column; MOST],
}

impl Eigen {
    /// The largest magnitude of an eigenvalue.
    pub(crate) fn largest(&self) -> f64 {
        self.value.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// Least-squares solution of least norm; eigenvalues below `part` of the largest count as zero.
    pub(crate) fn solve(&self, rhs: Column, part: f64) -> Column {
        let floor = part * self.largest();
        let mut x = [0.0; MOST];
        for k in 0..self.size {
            if self.value[k].abs() > floor {
                let v = self.vector[k];
                let along: f64 = (0..self.size).map(|i| v[i] * rhs[i]).sum::<f64>() / self.value[k];
                for i in 0..self.size {
                    x[i] += along * v[i];
                }
            }
        }
        x
    }

    /// How many eigenvalues are above `part` of the largest, and how many are below minus that.
    pub(crate) fn signs(&self, part: f64) -> (usize, usize) {
        let floor = part * self.largest();
        let value = &self.value[..self.size];
        (
            value.iter().filter(|x| **x > floor).count(),
            value.iter().filter(|x| **x < -floor).count(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Symmetric {
        Symmetric {
            size: 4,
            entry: [
                [4.0, 1.0, -2.0, 0.5],
                [1.0, 3.0, 0.0, 1.0],
                [-2.0, 0.0, 5.0, -1.0],
                [0.5, 1.0, -1.0, 2.0],
            ],
        }
    }

    fn product(a: &Symmetric, x: Column) -> Column {
        std::array::from_fn(|i| (0..a.size).map(|k| a.entry[i][k] * x[k]).sum())
    }

    fn distance(a: Column, b: Column) -> f64 {
        (0..MOST).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn cholesky_and_eigenvectors_solve_alike() {
        let a = example();
        let x = [1.0, -2.0, 3.0, -4.0];
        let b = product(&a, x);
        assert!(distance(a.solve(b).unwrap(), x) < 1e-14);
        assert!(distance(a.eigen().solve(b, 1e-15), x) < 1e-14);
    }

    #[test]
    fn eigenpairs_hold() {
        let mut a = example();
        a.entry[0][0] = -3.0;
        let eigen = a.eigen();
        for k in 0..4 {
            let left = product(&a, eigen.vector[k]);
            let right = eigen.vector[k].map(|x| x * eigen.value[k]);
            assert!(distance(left, right) < 1e-14);
        }
        let trace: f64 = eigen.value.iter().sum();
        assert!((trace - 7.0).abs() < 1e-14);
        assert_eq!(eigen.signs(1e-15), (3, 1));
    }

    #[test]
    fn a_direction_taken_out_is_a_null_vector_and_the_rest_stays() {
        let mut a = example();
        let e = [0.5, -0.5, 0.5, -0.5];
        a.without(e);
        assert!(distance(product(&a, e), [0.0; MOST]) < 1e-14);
        let x = [1.0, 1.0, 1.0, 1.0];
        let y = product(&example(), x);
        let along: f64 = (0..MOST).map(|k| e[k] * y[k]).sum();
        let expected = std::array::from_fn(|k| y[k] - along * e[k]);
        assert!(distance(product(&a, x), expected) < 1e-14);
    }

    #[test]
    fn a_singular_matrix_is_refused_by_one_and_solved_by_the_other() {
        let mut a = Symmetric::zero(3);
        a.entry[0][0] = 2.0;
        a.entry[1][1] = 1.0;
        assert!(a.solve([2.0, 3.0, 0.0, 0.0]).is_none());
        assert!(
            distance(a.eigen().solve([2.0, 3.0, 7.0, 0.0], 1e-15), [1.0, 3.0, 0.0, 0.0]) < 1e-15
        );
        assert_eq!(a.eigen().signs(1e-15), (2, 0));
    }

    /// By a pivot of 1e-14 of its entry it is known; by one of 1e-15 it is lost. Powers of two
    /// change no digit.
    #[test]
    fn a_lost_pivot_is_lost_in_every_unit() {
        for scale in [1.0, 2.0_f64.powi(40), 2.0_f64.powi(-40)] {
            for (pivot, kept) in [(1e-14, true), (1e-15, false), (-1e-14, false), (f64::NAN, false)]
            {
                let mut a = Symmetric::zero(2);
                a.entry[0][..2].copy_from_slice(&[scale, scale]);
                a.entry[1][..2].copy_from_slice(&[scale, scale * (1.0 + pivot)]);
                assert_eq!(a.solve([scale, scale, 0.0, 0.0]).is_some(), kept, "{scale} {pivot}");
            }
            let mut a = example();
            a.entry = a.entry.map(|row| row.map(|x| scale * x));
            let (found, expected) =
                (a.solve([scale; 4]).unwrap(), example().solve([1.0; 4]).unwrap());
            assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
        }
    }

    #[test]
    fn nothing_has_no_sign() {
        assert_eq!(Symmetric::zero(3).eigen().signs(1e-15), (0, 0));
    }

    /// Signs are counted above a part of the largest: of 1000 and 1e-3 above 1, of 0.1 above 1e-4.
    #[test]
    fn signs_are_counted_above_a_part_of_the_largest() {
        for (diagonal, signs) in [
            ([1000.0, 0.5, -0.5, -2.0], (1, 1)),
            ([-1000.0, 1.5, 0.5, -0.5], (1, 1)),
            ([0.1, 0.5e-4, -0.5e-4, -2e-4], (1, 1)),
            ([0.1, 2e-4, -0.5e-4, -2e-4], (2, 1)),
        ] {
            let mut matrix = Symmetric::zero(4);
            for (k, value) in diagonal.into_iter().enumerate() {
                matrix.entry[k][k] = value;
            }
            assert_eq!(matrix.eigen().signs(1e-3), signs, "{diagonal:?}");
        }
    }
}
