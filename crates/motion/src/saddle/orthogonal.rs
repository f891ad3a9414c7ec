//! Elimination of one joint by reflections, for rows that nearly depend on each other.
//!
//! With `A = L Lᵀ`, `W̃ = L⁻¹ W` and the roots of what the children left,
//!
//! $$ \begin{bmatrix} \tilde W \\\\ S^{1/2} \end{bmatrix} = \begin{bmatrix} Q_1 & Q_2 \\\\ \cdot & \cdot
//!    \end{bmatrix} \begin{bmatrix} U \\\\ 0 \end{bmatrix} : \quad T = U^T U, \quad
//!    H = L^{-T} Q_1 U^{-T}, \quad P = F F^T, \quad F = L^{-T} Q_2 . $$
//!
//! Nothing is subtracted from `A⁻¹`: where rows are dependent up to an angle `δ`, `T` formed by
//! products has lost the digits of `δ²`, and the `s = dᵀ P d` of the next joint those of `δ⁴`; here
//! `√s = |Fᵀ d|` loses those of `δ` alone (the square-root form of G. J. Bierman, *Factorization
//! Methods for Discrete Sequential Estimation*, 1977).

use matrices::dense::{Cholesky, inverse, product, qr};
use model::Vector;
use nalgebra::DMatrix;

use super::forest::Symmetric;
use numerics::vector::dot;

/// Least diagonal of `U` relative to its column: below it is rounding.
const LEAST_DIAGONAL: f64 = 1e-13;

/// What the elimination of a joint leaves.
pub(super) struct Eliminated {
    /// Columns of `F`.
    pub f: [Vector; 3],
    /// Columns of `H`.
    pub h: Vec<Vector>,
    /// `T⁻¹`, by rows.
    pub t_inverse: Vec<f64>,
}

impl Eliminated {
    /// `P = F Fᵀ`.
    pub(super) fn p(&self) -> Symmetric {
        let f = &self.f;
        let sum = |i: usize, j: usize| f.iter().map(|c| c[i] * c[j]).sum();
        [sum(0, 0), sum(0, 1), sum(0, 2), sum(1, 1), sum(1, 2), sum(2, 2)]
    }

    /// `|Fᵀ d|`, the root of what is left on a row.
    pub(super) fn root(&self, d: Vector) -> f64 {
        let [x, y, z] = self.f.map(|column| dot(column, d));
        x.hypot(y).hypot(z)
    }
}

/// Eliminate a joint with the inertia `a`, the columns `w` of its rows and the roots of what its
/// children left on them; the relative diagonal that fails otherwise, zero where `a` does.
pub(super) fn eliminate(a: Symmetric, w: &[Vector], roots: &[f64]) -> Result<Eliminated, f64> {
    let [xx, xy, xz, yy, yz, zz] = a;
    let a = DMatrix::from_row_slice(3, 3, &[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
    let l = Cholesky::new(&a).ok_or(0.0)?;
    let m = w.len();
    let mut stacked =
        l.solve(DMatrix::from_column_slice(3, m, w.as_flattened())).resize_vertically(3 + m, 0.0);
    for (k, root) in roots.iter().enumerate() {
        stacked[(3 + k, k)] = *root;
    }
    // The rows of Q that belong to the joint, as columns.
    let [u, q] = qr(stacked, DMatrix::identity(3 + m, 3));
    for k in 0..m {
        let whole = u.column(k).iter().map(|x| x * x).sum::<f64>().sqrt();
        let below = u[(k, k)].abs();
        if below.is_nan() || below <= LEAST_DIAGONAL * whole {
            return Err(if whole > 0.0 { below / whole } else { 0.0 });
        }
    }
    let inverse = inverse(&u).ok_or(0.0)?;
    let (q, across) = (q.transpose(), inverse.transpose());
    let scaled = product(&q.columns(0, m).into_owned(), &across);
    let [f, h] = [q.columns(m, 3).into_owned(), scaled].map(|right| l.solve_transposed(right));
    Ok(Eliminated {
        f: std::array::from_fn(|k| [0, 1, 2].map(|i| f[(i, k)])),
        h: h.as_slice().as_chunks().0.to_vec(),
        t_inverse: product(&inverse, &across).as_slice().to_vec(),
    })
}

#[cfg(test)]
mod tests {
    use super::eliminate;

    /// Without rows `P` is the inverse of the inertia: here of a full matrix with the determinant 35.
    #[test]
    fn a_joint_without_rows_leaves_its_inverse() {
        let a = [[4.0, 2.0, 1.0], [2.0, 5.0, -1.0], [1.0, -1.0, 3.0]];
        let left = eliminate([4.0, 2.0, 1.0, 5.0, -1.0, 3.0], &[], &[]).map_err(|x| x.to_string());
        let [xx, xy, xz, yy, yz, zz] = left.unwrap().p();
        // Its columns, which are its rows.
        let p = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        for (i, row) in a.iter().enumerate() {
            for (k, column) in p.iter().enumerate() {
                let product: f64 = row.iter().zip(column).map(|(a, b)| a * b).sum();
                assert!(
                    (product - f64::from(u8::from(i == k))).abs() < 1e-15,
                    "{i} {k}: {product}"
                );
            }
        }
    }

    /// With rows, by the formulas that it spares: `T = Wᵀ A⁻¹ W + S`, `H = A⁻¹ W T⁻¹` and
    /// `P = A⁻¹ - H Wᵀ A⁻¹`, every number of another size.
    #[test]
    fn rows_leave_what_the_products_say() {
        use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector3};
        let a = Matrix3::new(4.0, 2.0, 1.0, 2.0, 5.0, -1.0, 1.0, -1.0, 3.0);
        let rows = [[1.0, 0.5, -2.0], [0.25, 3.0, 1.5]];
        let roots = [0.5, 1.75];
        let left = eliminate([4.0, 2.0, 1.0, 5.0, -1.0, 3.0], &rows, &roots);
        let left = left.map_err(|x| x.to_string()).unwrap();
        let w = Matrix3x2::from_columns(&rows.map(Vector3::from));
        let inverse = a.try_inverse().unwrap();
        let t = w.transpose() * inverse * w
            + Matrix2::from_diagonal(&roots.map(|root| root * root).into());
        let t_inverse = t.try_inverse().unwrap();
        let h = inverse * w * t_inverse;
        let p = inverse - h * w.transpose() * inverse;
        let near = |found: f64, wanted: f64| {
            assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
        };
        for i in 0..2 {
            for j in 0..2 {
                near(left.t_inverse[2 * i + j], t_inverse[(i, j)]);
            }
            for k in 0..3 {
                near(left.h[i][k], h[(k, i)]);
            }
        }
        let places = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
        for (found, place) in left.p().into_iter().zip(places) {
            near(found, p[place]);
        }
        let d = Vector3::new(0.5, -1.0, 2.0);
        near(left.root(d.into()), (d.transpose() * p * d)[0].sqrt());
        // Rows that depend on each other, to rounding, are refused.
        assert!(
            eliminate(
                [1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
                &[[1.0, 2.0, 3.0], [2.0, 4.0, 6.0]],
                &[0.0; 2]
            )
            .is_err()
        );
    }
}
