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

use model::Vector;

use super::forest::Symmetric;
use numerics::vector::{add_times, dot, times};

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
/// children left on them; the relative diagonal (or pivot of `a`) that fails otherwise.
pub(super) fn eliminate(a: Symmetric, w: &[Vector], roots: &[f64]) -> Result<Eliminated, f64> {
    let l = cholesky(a)?;
    let m = w.len();
    // Columns to reflect: those of the rows, then the unit vectors of the joint, which become the
    // rows of Q.
    let mut columns: Vec<Vec<f64>> = Vec::with_capacity(m + 3);
    for (k, (&w, &root)) in w.iter().zip(roots).enumerate() {
        let mut column = vec![0.0; 3 + m];
        column[..3].copy_from_slice(&forwards(l, w));
        column[3 + k] = root;
        columns.push(column);
    }
    for axis in 0..3 {
        let mut unit = vec![0.0; 3 + m];
        unit[axis] = 1.0;
        columns.push(unit);
    }
    for k in 0..m {
        reflect(&mut columns, k)?;
    }
    let q = &columns[m..];
    let backwards = |k: usize| backwards(l, [q[0][k], q[1][k], q[2][k]]);
    let mut h: Vec<Vector> = (0..m).map(backwards).collect();
    // The inverse of U, by columns.
    let mut inverse = vec![vec![0.0; m]; m];
    for k in (0..m).rev() {
        let diagonal = columns[k][k];
        for j in k + 1..m {
            h[k] = add_times(h[k], -columns[j][k], h[j]);
        }
        h[k] = times(1.0 / diagonal, h[k]);
        inverse[k][k] = 1.0 / diagonal;
        for i in (0..k).rev() {
            let sum: f64 = (i + 1..=k).map(|j| columns[j][i] * inverse[k][j]).sum();
            inverse[k][i] = -sum / columns[i][i];
        }
    }
    let mut t_inverse = vec![0.0; m * m];
    for i in 0..m {
        for j in 0..m {
            t_inverse[i * m + j] = inverse.iter().map(|column| column[i] * column[j]).sum();
        }
    }
    Ok(Eliminated { f: [backwards(m), backwards(m + 1), backwards(m + 2)], h, t_inverse })
}

/// Reflect column `k` onto its first `k + 1` entries, and all later columns with it.
fn reflect(columns: &mut [Vec<f64>], k: usize) -> Result<(), f64> {
    let (whole, below) = (norm(&columns[k]), norm(&columns[k][k..]));
    if below.is_nan() || below <= LEAST_DIAGONAL * whole {
        return Err(if whole > 0.0 { below / whole } else { 0.0 });
    }
    let mut mirror = columns[k][k..].to_vec();
    mirror[0] += below.copysign(mirror[0]);
    let size: f64 = mirror.iter().map(|x| x * x).sum();
    for column in &mut columns[k..] {
        let along: f64 = column[k..].iter().zip(&mirror).map(|(x, v)| x * v).sum();
        let part = 2.0 * along / size;
        column[k..].iter_mut().zip(&mirror).for_each(|(x, v)| *x -= part * v);
    }
    Ok(())
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// `A = L Lᵀ`: xx, yx, yy, zx, zy, zz of `L`.
fn cholesky([xx, xy, xz, yy, yz, zz]: Symmetric) -> Result<Symmetric, f64> {
    let root = |pivot: f64| if pivot > 0.0 { Ok(pivot.sqrt()) } else { Err(pivot) };
    let a = root(xx)?;
    let (b, d) = (xy / a, xz / a);
    let c = root(yy - b * b)?;
    let e = (yz - b * d) / c;
    Ok([a, b, c, d, e, root(zz - d * d - e * e)?])
}

/// `L⁻¹ v`.
fn forwards([a, b, c, d, e, f]: Symmetric, v: Vector) -> Vector {
    let x = v[0] / a;
    let y = (v[1] - b * x) / c;
    [x, y, (v[2] - d * x - e * y) / f]
}

/// `L⁻ᵀ v`.
fn backwards([a, b, c, d, e, f]: Symmetric, v: Vector) -> Vector {
    let z = v[2] / f;
    let y = (v[1] - e * z) / c;
    [(v[0] - b * y - d * z) / a, y, z]
}

#[cfg(test)]
mod tests {
    use super::{eliminate, reflect};

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

    /// What is left of a column is told as a part of it: 1e-20 of 2.
    #[test]
    fn a_column_that_depends_on_others_is_told() {
        let found = reflect(&mut [vec![1.0, 0.0, 0.0], vec![2.0, 1e-20, 0.0]], 1);
        assert!((found.unwrap_err() / 5e-21 - 1.0).abs() < 1e-15);
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
