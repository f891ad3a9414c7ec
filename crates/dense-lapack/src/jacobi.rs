//! Eigenvalues and singular values by plane rotations.
//!
//! *Symmetric matrices*: rotations from both sides annihilate one off-diagonal pair after the
//! other, $V^T A V \to \mathrm{diag}(\lambda)$. *All others*: rotations from the right make the
//! columns orthogonal, $A V = U\,\mathrm{diag}(s)$. Jacobi's method is slower than the reduction to
//! a tridiagonal or bidiagonal form, by a factor that does not matter below a hundred columns, and
//! accurate where it counts: the late iterations of an interior point method hand over matrices
//! whose columns differ by many orders of magnitude.
//!
//! nalgebra 0.34's own decompositions were tried first. On some matrices of this crate's tests the
//! factors of its singular value decomposition multiply back to the matrix only within 2e-5, in
//! double precision, and its eigenvectors in single precision are orthonormal only within 8e-4.
//!
//! # References
//!
//! C. G. J. Jacobi, J. reine angew. Math. 30 (1846) 51-94, doi:10.1515/crll.1846.30.51; M. R.
//! Hestenes, J. SIAM 6 (1958) 51-90, doi:10.1137/0106005 (one-sided); J. Demmel, K. Veselić, SIAM
//! J. Matrix Anal. Appl. 13 (1992) 1204-1245, doi:10.1137/0613074 (accuracy).

use nalgebra::{DMatrix, DVector};

use crate::raw::Scalar;

/// Sweeps over all pairs of columns before the iteration is given up. Convergence is quadratic; the
/// tests need no more than 10.
const MAX_SWEEPS: usize = 60;

/// Symmetric A = V diag(values) Vᵀ, values ascending.
pub(crate) struct Eigen<T: Scalar> {
    pub(crate) values: DVector<T>,
    pub(crate) vectors: DMatrix<T>,
}

/// Thin factors A = U diag(values) Vᵀ, values descending.
pub(crate) struct Singular<T: Scalar> {
    pub(crate) u: DMatrix<T>,
    pub(crate) values: DVector<T>,
    pub(crate) vt: DMatrix<T>,
}

/// Eigenvalues and vectors of a symmetric matrix; `None` when the entries are not finite or the
/// sweeps do not suffice.
pub(crate) fn eigen<T: Scalar>(mut a: DMatrix<T>) -> Option<Eigen<T>> {
    let scale = normalise(&mut a)?;
    let mut v = DMatrix::identity(a.nrows(), a.nrows());
    repeat(|| eigen_sweep(&mut a, &mut v))?;
    let diagonal = a.diagonal();
    let mut order = descending(&diagonal);
    order.reverse();
    Some(Eigen {
        values: DVector::from_fn(order.len(), |j, _| diagonal[order[j]] * scale),
        vectors: v.select_columns(&order),
    })
}

/// Singular value decomposition; `None` when the entries are not finite or the sweeps do not
/// suffice.
pub(crate) fn singular<T: Scalar>(a: &DMatrix<T>) -> Option<Singular<T>> {
    if a.nrows() < a.ncols() {
        let Singular { u, values, vt } = tall(a.transpose())?;
        return Some(Singular { u: vt.transpose(), values, vt: u.transpose() });
    }
    tall(a.clone())
}

/// [`singular`] for at least as many rows as columns.
fn tall<T: Scalar>(mut a: DMatrix<T>) -> Option<Singular<T>> {
    let scale = normalise(&mut a)?;
    let mut v = DMatrix::identity(a.ncols(), a.ncols());
    repeat(|| singular_sweep(&mut a, &mut v))?;
    let norms = DVector::from_iterator(a.ncols(), a.column_iter().map(|column| column.norm()));
    let order = descending(&norms);
    let mut u = DMatrix::zeros(a.nrows(), a.ncols());
    for (j, &k) in order.iter().enumerate() {
        if norms[k] > noise() {
            u.set_column(j, &(a.column(k) / norms[k]));
        } else {
            complete(&mut u, j);
        }
    }
    Some(Singular {
        u,
        values: DVector::from_fn(order.len(), |j, _| norms[order[j]] * scale),
        vt: v.select_columns(&order).transpose(),
    })
}

/// Scale the largest entry to 1, so that squares do not overflow and, where it matters, do not
/// underflow; `None` when an entry is not finite.
fn normalise<T: Scalar>(a: &mut DMatrix<T>) -> Option<T> {
    if !a.iter().all(T::is_finite) {
        return None;
    }
    let scale = if a.is_empty() { T::zero() } else { a.amax() };
    if scale.is_zero() {
        return Some(T::one());
    }
    *a /= scale;
    Some(scale)
}

/// What is left of a number of size 1 that cancelled, and then cancelled again: a column this short
/// is rounding, and its direction means nothing.
fn noise<T: Scalar>() -> T {
    T::default_epsilon() * T::default_epsilon()
}

/// Sweep until nothing was left to do.
fn repeat(mut sweep: impl FnMut() -> bool) -> Option<()> {
    (0..MAX_SWEEPS).find(|_| sweep()).map(|_| ())
}

/// Places of the values, largest first.
fn descending<T: Scalar>(values: &DVector<T>) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[j].partial_cmp(&values[i]).unwrap_or(std::cmp::Ordering::Equal));
    order
}

/// Cosine and tangent of the smaller angle that diagonalises [[α, γ], [γ, β]], γ not zero.
fn rotation<T: Scalar>(alpha: T, gamma: T, beta: T) -> (T, T) {
    let zeta = (beta - alpha) / (gamma + gamma);
    let t = T::one().copysign(zeta) / (zeta.abs() + zeta.hypot(T::one()));
    (T::one() / t.hypot(T::one()), t)
}

/// Columns p and q ← (c (p − t q), c (t p + q)).
fn rotate_columns<T: Scalar>(m: &mut DMatrix<T>, p: usize, q: usize, (c, t): (T, T)) {
    for i in 0..m.nrows() {
        let (x, y) = (m[(i, p)], m[(i, q)]);
        m[(i, p)] = c * (x - t * y);
        m[(i, q)] = c * (t * x + y);
    }
}

/// Rows p and q ← (c (p − t q), c (t p + q)).
fn rotate_rows<T: Scalar>(m: &mut DMatrix<T>, p: usize, q: usize, (c, t): (T, T)) {
    for j in 0..m.ncols() {
        let (x, y) = (m[(p, j)], m[(q, j)]);
        m[(p, j)] = c * (x - t * y);
        m[(q, j)] = c * (t * x + y);
    }
}

/// Annihilate every off-diagonal pair once; whether all were negligible already.
fn eigen_sweep<T: Scalar>(a: &mut DMatrix<T>, v: &mut DMatrix<T>) -> bool {
    let mut diagonal = true;
    for q in 1..a.ncols() {
        for p in 0..q {
            let (alpha, gamma, beta) = (a[(p, p)], a[(p, q)], a[(q, q)]);
            let size = (alpha.abs().sqrt() * beta.abs().sqrt()).max(noise());
            if gamma.abs() <= T::default_epsilon() * size {
                continue;
            }
            diagonal = false;
            let turn = rotation(alpha, gamma, beta);
            rotate_columns(a, p, q, turn);
            rotate_rows(a, p, q, turn);
            // Exactly, what the rotation makes up to rounding.
            a[(p, q)] = T::zero();
            a[(q, p)] = T::zero();
            rotate_columns(v, p, q, turn);
        }
    }
    diagonal
}

/// Make every pair of columns orthogonal once; whether all were already.
fn singular_sweep<T: Scalar>(a: &mut DMatrix<T>, v: &mut DMatrix<T>) -> bool {
    let mut orthogonal = true;
    // The scalar product of two orthogonal columns is off by the rounding of its terms.
    let rows: T = nalgebra::convert(a.nrows() as f64);
    let tolerance = T::default_epsilon() * rows.sqrt();
    for q in 1..a.ncols() {
        for p in 0..q {
            let (ap, aq) = (a.column(p), a.column(q));
            let (alpha, beta, gamma) = (ap.norm_squared(), aq.norm_squared(), ap.dot(&aq));
            let (short, long) = (alpha.min(beta).sqrt(), alpha.max(beta).sqrt());
            if short <= noise() || gamma.abs() <= tolerance * short * long {
                continue;
            }
            orthogonal = false;
            let turn = rotation(alpha, gamma, beta);
            rotate_columns(a, p, q, turn);
            rotate_columns(v, p, q, turn);
        }
    }
    orthogonal
}

/// Column `j` becomes a unit vector orthogonal to the columns before it.
fn complete<T: Scalar>(u: &mut DMatrix<T>, j: usize) {
    let m = u.nrows();
    // The squared lengths of what is left of the m unit vectors sum to m - j, so one of them is at
    // least 1 / m; a quarter of that leaves room for rounding.
    let enough: T = nalgebra::convert(0.25 / m as f64);
    for k in 0..m {
        let mut rest = DVector::zeros(m);
        rest[k] = T::one();
        // Twice is enough (Kahan and Parlett).
        for _ in 0..2 {
            for i in 0..j {
                let along = u.column(i).dot(&rest);
                rest -= u.column(i) * along;
            }
        }
        if rest.norm_squared() >= enough {
            u.set_column(j, &rest.normalize());
            return;
        }
    }
}
