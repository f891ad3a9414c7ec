//! Rank, kernels, least squares, factors, inverses and eigenvalues of small dense matrices, with `nalgebra`.
//!
//! Nothing here is generic, not even a product: what is generic is compiled again in each crate that uses it.
//!
//! Kernels come of orthogonal triangularisation with exchanges of columns, at a rank that singular values decide. The
//! singular *vectors* of nalgebra 0.34 are not used: of one random matrix in four hundred without full rank (one in
//! forty with the tolerance that gives its singular values all their digits) they do not give the matrix back.

use std::collections::HashSet;
use std::ops::Range;

use nalgebra::linalg::{ColPivQR, SymmetricEigen};
use nalgebra::{DMatrix, DVector, Dyn, Matrix3, Vector3};

/// Iterations for each row, a multiple of the two or three that are usual. Without a bound nalgebra never ends on a
/// NaN.
const ITERATIONS: usize = 100;

/// Columns that are eliminated one by one before those after them take them together.
const PANEL: usize = 32;

/// Sets of one-sided springs that are looked at, times the cube of the rows; at least and at most so many.
const ONE_SIDED: usize = 200_000_000;
const ONE_SIDED_LEAST: usize = 16;
const ONE_SIDED_MOST: usize = 4096;

/// Most one-sided springs that [`falls_one_sided`] is asked of: its work grows with their cube, 3 s here.
pub const MOST_OPEN: usize = 600;

/// A fall of less than this, over the stiffness of the springs, is rounding.
const ONE_SIDED_ZERO: f64 = 1e-9;

/// Flexibilities below this count as this: of springs that can hardly stretch.
const STIFFEST: f64 = 1e-6;

/// Eigenvalues of a form that falls are moved apart by this part of the lowest.
const APART: f64 = 1e-6;

/// The rank of a matrix, and its kernels.
#[derive(Debug, Clone)]
pub struct Kernels<'a> {
    matrix: &'a DMatrix<f64>,
    /// Singular values that count.
    pub rank: usize,
    /// The smallest of them and the largest other one, over the largest: 1 and 0 where there is none.
    pub gap: [f64; 2],
    /// The largest singular value, or the scale where that is more.
    pub largest: f64,
}

impl<'a> Kernels<'a> {
    /// Those of a matrix whose singular values below `zero` times the largest count as zero; `None` where an entry is
    /// not finite.
    pub fn new(matrix: &'a DMatrix<f64>, zero: f64) -> Option<Self> {
        Self::at_scale(matrix, zero, 0.0)
    }

    /// The same below `zero` times the largest or the scale of the entries, whichever is larger: rows of unit vectors
    /// of which nothing but rounding is left have no rank.
    pub fn at_scale(matrix: &'a DMatrix<f64>, zero: f64, scale: f64) -> Option<Self> {
        let values = singular_values(matrix)?;
        let largest = values.first().copied().unwrap_or(0.0);
        let most = largest.max(scale).max(f64::MIN_POSITIVE);
        let rank = values.iter().filter(|value| **value > zero * most).count();
        let counted = if rank > 0 { values[rank - 1] / most } else { 1.0 };
        let gap = [counted, values.get(rank).map_or(0.0, |value| value / most)];
        Some(Self { matrix, rank, gap, largest: largest.max(scale) })
    }

    /// An orthonormal basis, by columns, of what the matrix takes to zero.
    pub fn right(&self) -> DMatrix<f64> {
        complement(&self.matrix.transpose(), self.rank)
    }

    /// The same of its transpose.
    pub fn left(&self) -> DMatrix<f64> {
        complement(self.matrix, self.rank)
    }
}

/// An orthonormal basis, by columns, of what is orthogonal to all columns of a matrix of this rank.
///
/// Where the matrix is of a higher rank, what is orthogonal to the first of its columns by size of their pivots: of a
/// square matrix that is all but singular the vector that it all but takes to zero from the left.
pub fn complement(matrix: &DMatrix<f64>, rank: usize) -> DMatrix<f64> {
    let size = matrix.nrows();
    if rank == 0 || rank == size {
        return DMatrix::identity(size, size - rank);
    }
    square(matrix).q().columns(rank, size - rank).into_owned()
}

/// The same at a rank of pivots above `zero` times the largest.
pub fn across(columns: &DMatrix<f64>, zero: f64) -> DMatrix<f64> {
    let size = columns.nrows();
    if columns.is_empty() {
        return DMatrix::identity(size, size);
    }
    let factors = square(columns);
    let rank = rank(&factors.r(), zero);
    factors.q().columns(rank, size - rank).into_owned()
}

/// Factors of which the orthogonal one is square, by columns of zeros.
fn square(matrix: &DMatrix<f64>) -> ColPivQR<f64, Dyn, Dyn> {
    let columns = matrix.ncols().max(matrix.nrows());
    (matrix / unit(matrix)).resize_horizontally(columns, 0.0).col_piv_qr()
}

/// Pivots above `zero` times the largest.
fn rank(upper: &DMatrix<f64>, zero: f64) -> usize {
    let pivot = |k: usize| upper[(k, k)].abs();
    (0..upper.nrows()).take_while(|k| pivot(*k) > zero * pivot(0)).count()
}

/// Singular values, the largest first; `None` where an entry is not finite.
pub fn singular_values(matrix: &DMatrix<f64>) -> Option<Vec<f64>> {
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    let steps = ITERATIONS * matrix.nrows().max(matrix.ncols());
    let finite = finite(matrix)?.clone();
    Some(finite.try_svd(false, false, f64::EPSILON, steps)?.singular_values.as_slice().to_vec())
}

/// The shortest of the vectors that leave the least of `right`, by a rank of pivots above `zero` times the largest;
/// `None` where an entry of either is not finite.
pub fn least_squares(
    matrix: &DMatrix<f64>,
    right: &DVector<f64>,
    zero: f64,
) -> Option<DVector<f64>> {
    if !right.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    if matrix.is_empty() {
        return Some(DVector::zeros(matrix.ncols()));
    }
    let unit = unit(finite(matrix)?);
    let factors = (matrix / unit).col_piv_qr();
    let upper = factors.r();
    let rank = rank(&upper, zero);
    if rank == 0 {
        return Some(DVector::zeros(matrix.ncols()));
    }
    let wanted = factors.q().columns(0, rank).tr_mul(right) / unit;
    // R = T^T Z^T over the rows that count: the shortest is Z T^-T of what is wanted.
    let across = upper.rows(0, rank).transpose().qr();
    let short = across.r().tr_solve_upper_triangular(&wanted)?;
    let mut found = across.q() * short;
    factors.p().inv_permute_rows(&mut found);
    Some(found)
}

/// A power of two near the largest entry: squares of entries over it are in range.
fn unit(matrix: &DMatrix<f64>) -> f64 {
    let largest = matrix.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
    if largest > 0.0 { largest.log2().floor().exp2() } else { 1.0 }
}

/// The inverse of a square matrix, by elimination with exchanges of rows, some columns at a time; `None` where an entry
/// is not finite, or a pivot vanishes.
///
/// # Panics
///
/// When the matrix is not square.
pub fn inverse(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let size = matrix.nrows();
    assert_eq!(size, matrix.ncols(), "a square matrix");
    let (mut factors, mut found) = (finite(matrix)?.clone(), DMatrix::identity(size, size));
    let panels = (0..size).step_by(PANEL).map(|first| (first, PANEL.min(size - first)));
    let mut exchanges = Vec::with_capacity(size);
    let panel = |factors: &DMatrix<f64>, first: usize, width: usize| {
        factors.view((first, first), (size - first, width)).clone_owned()
    };
    for (first, width) in panels.clone() {
        triangular(&mut factors, first..first + width, &mut exchanges)?;
        let panel = panel(&factors, first, width);
        take_off(&panel, &mut factors, first, first + width..size);
    }
    // The inverse of a triangle is one.
    for (first, width) in panels.clone() {
        take_off(&panel(&factors, first, width), &mut found, first, 0..first + width);
    }
    for (first, width) in panels.rev() {
        let mut rows = found.rows(first, width).clone_owned();
        factors.view((first, first), (width, width)).solve_upper_triangular_mut(&mut rows);
        found.rows_mut(first, width).copy_from(&rows);
        let above = factors.view((0, first), (first, width));
        found.rows_mut(0, first).gemm(-1.0, &above, &rows, 1.0);
    }
    for (row, other) in exchanges.into_iter().rev() {
        found.swap_columns(row, other);
    }
    Some(found)
}

/// Factors of a square matrix by elimination with exchanges of rows.
#[derive(Debug, Clone)]
pub struct Lu {
    factors: DMatrix<f64>,
    exchanges: Vec<(usize, usize)>,
}

impl Lu {
    /// `None` where an entry is not finite, or a pivot vanishes.
    ///
    /// # Panics
    ///
    /// When the matrix is not square.
    pub fn new(matrix: &DMatrix<f64>) -> Option<Self> {
        let size = matrix.nrows();
        assert_eq!(size, matrix.ncols(), "a square matrix");
        let (mut factors, mut exchanges) = (finite(matrix)?.clone(), Vec::with_capacity(size));
        triangular(&mut factors, 0..size, &mut exchanges)?;
        Some(Self { factors, exchanges })
    }

    /// What the matrix takes to `right`.
    pub fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        let (size, factors, mut found) = (right.len(), &self.factors, right.clone());
        self.exchanges.iter().for_each(|(row, other)| found.as_mut_slice().swap(*row, *other));
        for k in 0..size {
            (k + 1..size).for_each(|i| found[i] -= factors[(i, k)] * found[k]);
        }
        for k in (0..size).rev() {
            found[k] /= factors[(k, k)];
            (0..k).for_each(|i| found[i] -= factors[(i, k)] * found[k]);
        }
        found
    }

    /// The determinant.
    pub fn determinant(&self) -> f64 {
        let turns = self.exchanges.iter().filter(|(row, other)| row != other).count();
        self.factors.diagonal().product() * if turns % 2 == 0 { 1.0 } else { -1.0 }
    }
}

/// The lower triangle `L` of a positive definite matrix `L L^T`.
#[derive(Debug, Clone)]
pub struct Cholesky(DMatrix<f64>);

impl Cholesky {
    /// Of its lower triangle; `None` where it is not positive definite.
    pub fn new(matrix: &DMatrix<f64>) -> Option<Self> {
        Some(Self(matrix.clone().cholesky()?.unpack()))
    }

    /// `L^-1` times a matrix.
    pub fn solve(&self, mut right: DMatrix<f64>) -> DMatrix<f64> {
        self.0.solve_lower_triangular_mut(&mut right);
        right
    }

    /// `L^-T` times a matrix.
    pub fn solve_transposed(&self, mut right: DMatrix<f64>) -> DMatrix<f64> {
        self.0.tr_solve_lower_triangular_mut(&mut right);
        right
    }
}

/// What a positive definite matrix of three rows takes to `right`; `None` where it is not positive definite.
pub fn solve_three(matrix: &[[f64; 3]; 3], right: [f64; 3]) -> Option<[f64; 3]> {
    let (mut l, mut x) = (*matrix, right);
    for i in 0..3 {
        for j in 0..=i {
            let sum = (0..j).fold(l[i][j], |sum, k| sum - l[i][k] * l[j][k]);
            if i == j && (sum.is_nan() || sum <= 0.0) {
                return None;
            }
            l[i][j] = if i == j { sum.sqrt() } else { sum / l[j][j] };
        }
        x[i] = (0..i).fold(x[i], |sum, k| sum - l[i][k] * x[k]) / l[i][i];
    }
    for i in (0..3).rev() {
        x[i] = (i + 1..3).fold(x[i], |sum, k| sum - l[k][i] * x[k]) / l[i][i];
    }
    Some(x)
}

/// The triangle `R` of a matrix `Q R` with at least as many rows as columns, and `Q^T` times another one.
pub fn qr(matrix: DMatrix<f64>, mut other: DMatrix<f64>) -> [DMatrix<f64>; 2] {
    if matrix.is_empty() {
        return [DMatrix::zeros(0, 0), other];
    }
    let factors = matrix.qr();
    factors.q_tr_mul(&mut other);
    [factors.unpack_r(), other]
}

/// The product of two matrices.
///
/// # Panics
///
/// When they do not fit.
pub fn product(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    left * right
}

/// A matrix times a vector.
///
/// # Panics
///
/// When they do not fit.
pub fn apply(matrix: &DMatrix<f64>, vector: &DVector<f64>) -> DVector<f64> {
    matrix * vector
}

/// The matrix `B^T A B` of a form in a basis by columns.
///
/// # Panics
///
/// When they do not fit.
pub fn projected(matrix: &DMatrix<f64>, basis: &DMatrix<f64>) -> DMatrix<f64> {
    basis.transpose() * matrix * basis
}

/// Solve with the triangle, with ones on its diagonal, at the head of some columns of a factor, in the rows from `first` on
/// of a matrix, and take what is below the triangle off the rows below.
fn take_off(panel: &DMatrix<f64>, matrix: &mut DMatrix<f64>, first: usize, columns: Range<usize>) {
    let (width, below, from) = (panel.ncols(), panel.nrows() - panel.ncols(), columns.start);
    let mut rows = matrix.view((first, from), (width, columns.len())).clone_owned();
    panel.rows(0, width).solve_lower_triangular_with_diag_mut(&mut rows, 1.0);
    matrix.view_mut((first, from), rows.shape()).copy_from(&rows);
    let mut rest = matrix.view_mut((first + width, from), (below, columns.len()));
    rest.gemm(-1.0, &panel.rows(width, below), &rows, 1.0);
}

/// Eliminate some columns, with exchanges of whole rows; `None` where a pivot vanishes.
fn triangular(
    matrix: &mut DMatrix<f64>,
    columns: Range<usize>,
    exchanges: &mut Vec<(usize, usize)>,
) -> Option<()> {
    for column in columns.clone() {
        let below = matrix.nrows() - column;
        let pivot = column + matrix.view((column, column), (below, 1)).icamax_full().0;
        matrix.swap_rows(column, pivot);
        exchanges.push((column, pivot));
        let rows = matrix.nrows();
        let (before, after) = matrix.as_mut_slice().split_at_mut((column + 1) * rows);
        let values = &mut before[column * rows..];
        let pivot = values[column];
        if pivot.abs() <= 0.0 {
            return None;
        }
        values[column + 1..].iter_mut().for_each(|value| *value /= pivot);
        for other in after.chunks_exact_mut(rows).take(columns.end - column - 1) {
            let by = other[column];
            for (x, l) in other[column + 1..].iter_mut().zip(&values[column + 1..]) {
                *x -= l * by;
            }
        }
    }
    Some(())
}

/// Eigenvalues of a symmetric matrix, ascending; `None` where an entry is not finite.
pub fn eigenvalues(symmetric: &DMatrix<f64>) -> Option<Vec<f64>> {
    if symmetric.is_empty() {
        return Some(Vec::new());
    }
    let values = finite(symmetric)?.symmetric_eigenvalues();
    let mut values = values.as_slice().to_vec();
    values.sort_unstable_by(f64::total_cmp);
    Some(values)
}

/// Eigenvalues of a symmetric matrix, ascending, and its eigenvectors by columns; `None` where an entry is not finite.
pub fn eigen(symmetric: &DMatrix<f64>) -> Option<(Vec<f64>, DMatrix<f64>)> {
    if symmetric.is_empty() {
        return Some((Vec::new(), symmetric.clone()));
    }
    let steps = ITERATIONS * symmetric.nrows();
    let found = SymmetricEigen::try_new(finite(symmetric)?.clone(), f64::EPSILON, steps)?;
    let mut order: Vec<usize> = (0..symmetric.nrows()).collect();
    order.sort_unstable_by(|a, b| found.eigenvalues[*a].total_cmp(&found.eigenvalues[*b]));
    let values = order.iter().map(|k| found.eigenvalues[*k]).collect();
    Some((values, found.eigenvectors.select_columns(&order)))
}

/// The same of three rows.
pub fn eigen_of_three(symmetric: &Matrix3<f64>) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let (values, vectors) = eigen(&DMatrix::from_column_slice(3, 3, symmetric.as_slice()))?;
    Some((Vector3::from_column_slice(&values), Matrix3::from_column_slice(vectors.as_slice())))
}

/// The least value found on the unit sphere of `v·A v + Σ max(0, r·v)²`, `r` the rows: a quadratic form with springs that
/// resist on one side alone. Zero where the form never falls.
///
/// Where it is least, `v` is an eigenvector of the form with those springs that resist there, and its value the eigenvalue. All
/// sets of springs are looked at where that is no work; of many those that the eigenvectors of others lead to.
///
/// ```
/// use matrices::dense::least_one_sided;
/// use nalgebra::DMatrix;
/// // A post that falls to all sides, and springs against it at these angles, in degrees.
/// let post = -DMatrix::<f64>::identity(2, 2);
/// let held = |angles: &[f64]| {
///     let rows = DMatrix::from_fn(angles.len(), 2, |row, axis| {
///         let angle = angles[row].to_radians();
///         2.0 * if axis == 0 { angle.cos() } else { angle.sin() }
///     });
///     least_one_sided(&post, &rows)
/// };
/// assert!(held(&[0.0, 90.0, 180.0, 270.0]) >= 0.0 && held(&[0.0, 120.0, 240.0]) >= 0.0);
/// // Nothing holds it at 265 degrees; and two springs 160 degrees apart are too weak for what is between them.
/// assert!((held(&[0.0, 1.0, 3.0, 165.0]) + 1.0).abs() < 1e-5);
/// assert!(held(&[0.0, 90.0, 170.0]) < -0.9 && held(&[0.0, 100.0, 260.0]) < 0.0);
/// ```
pub fn least_one_sided(form: &DMatrix<f64>, rows: &DMatrix<f64>) -> f64 {
    let (size, springs) = (form.nrows(), rows.nrows());
    let lowest = eigenvalues(form).and_then(|values| values.first().copied()).unwrap_or(0.0);
    if lowest >= 0.0 {
        return 0.0;
    }
    // Of eigenvectors with one eigenvalue there may be others that fewer springs feel.
    let apart = |k: usize| APART * lowest * (k as f64 * std::f64::consts::SQRT_2).fract();
    let apart = form + DMatrix::from_diagonal(&DVector::from_fn(size, |k, _| apart(k)));
    let most = (ONE_SIDED / size.pow(3)).clamp(ONE_SIDED_LEAST, ONE_SIDED_MOST);
    let mut sets: Vec<Vec<bool>> = if springs < 20 && 1 << springs <= most {
        (0..1_usize << springs)
            .map(|set| (0..springs).map(|k| set >> k & 1 == 1).collect())
            .collect()
    } else {
        let singles = (0..springs).map(|one| (0..springs).map(|k| k == one).collect());
        let ends = [false, true].map(|all| vec![all; springs]).into_iter();
        ends.chain(singles.take(most / 2)).collect()
    };
    let mut seen: HashSet<Vec<bool>> = sets.iter().cloned().collect();
    let (mut least, mut next) = (0.0_f64, 0);
    while next < sets.len().min(most) {
        let resist: Vec<usize> = (0..springs).filter(|k| sets[next][*k]).collect();
        let resist = rows.select_rows(&resist);
        let with = &apart + resist.tr_mul(&resist);
        next += 1;
        // What holds from everywhere is seen faster than by its eigenvectors.
        let holds = springs > 0 && next > 1 && with.clone().cholesky().is_some();
        let Some((values, vectors)) = (!holds).then(|| eigen(&with)).flatten() else { continue };
        let falling = values.iter().take_while(|value| **value < 0.0).count();
        for v in vectors.column_iter().take(falling) {
            let (of_form, stretch) = (v.dot(&(form * v)), rows * v);
            for sign in [1.0, -1.0] {
                let stretch = stretch.map(|stretch| (sign * stretch).max(0.0));
                least = least.min(of_form + stretch.norm_squared());
                let set: Vec<bool> = stretch.iter().map(|stretch| *stretch > 0.0).collect();
                if seen.insert(set.clone()) {
                    sets.push(set);
                }
            }
        }
    }
    least
}

/// Whether `v·A v + Σ max(0, r·v)²` is negative somewhere, from the flexibility `F = R (A + RᵀR)⁻¹ Rᵀ`, `R` of the rows `r`,
/// where the form with all springs is positive definite: of all `v` with the stretches `s = R v` it is least
/// `s·(F⁻¹ - 1) s + Σ max(0, s)²`.
///
/// ```
/// use matrices::dense::falls_one_sided;
/// use nalgebra::dmatrix;
/// // The form -v², and springs of stiffness 2 on one side, and on both.
/// assert!(falls_one_sided(&dmatrix![2.0]));
/// assert!(!falls_one_sided(&(dmatrix![2.0, -2.0; -2.0, 2.0] / 3.0)));
/// ```
pub fn falls_one_sided(flexibility: &DMatrix<f64>) -> bool {
    let size = flexibility.nrows();
    let Some((values, vectors)) = eigen(&((flexibility + flexibility.transpose()) / 2.0)) else {
        return true;
    };
    let stiffness = values.iter().map(|value| value.max(STIFFEST).recip() - 1.0);
    let form = &vectors * DMatrix::from_diagonal(&DVector::from_iterator(size, stiffness));
    least_one_sided(&(form * vectors.transpose()), &DMatrix::identity(size, size)) < -ONE_SIDED_ZERO
}

/// Real and imaginary parts of the eigenvalues of a square matrix; `None` where an entry is not finite.
///
/// # Panics
///
/// When the matrix is not square.
pub fn complex_eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<[f64; 2]>> {
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    let values = finite(matrix)?.complex_eigenvalues();
    Some(values.iter().map(|value| [value.re, value.im]).collect())
}

/// The matrix, if all of it is finite.
fn finite(matrix: &DMatrix<f64>) -> Option<&DMatrix<f64>> {
    matrix.iter().all(|entry| entry.is_finite()).then_some(matrix)
}
