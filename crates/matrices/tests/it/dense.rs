//! Ranks and spectra known beforehand, and what kernels and solutions are to be orthogonal to.

use matrices::dense::{
    Cholesky, Kernels, Lu, across, apply, complex_eigenvalues, eigen, eigen_of_three, eigenvalues,
    inverse, least_squares, product, projected, qr, singular_values, solve_three,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const ZERO: f64 = 1e-11;
const SMALL: f64 = 1e-13;

fn any(random: &mut ChaCha8Rng, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.random_range(-1.0..1.0))
}

/// A product of reflections.
fn orthogonal(random: &mut ChaCha8Rng, size: usize) -> DMatrix<f64> {
    (0..4).fold(DMatrix::identity(size, size), |product, _| {
        let normal = any(random, size, 1);
        &product - &product * &normal * normal.transpose() * (2.0 / normal.norm_squared())
    })
}

/// The largest magnitude, 0 of no entries.
fn most(matrix: &DMatrix<f64>) -> f64 {
    matrix.iter().fold(0.0, |most, x| if x.abs() <= most { most } else { x.abs() })
}

fn orthonormal(columns: &DMatrix<f64>) -> bool {
    let count = columns.ncols();
    most(&(columns.tr_mul(columns) - DMatrix::identity(count, count))) <= SMALL
}

/// Check kernels of a matrix of this rank, and the least squares with them.
fn check(random: &mut ChaCha8Rng, matrix: &DMatrix<f64>, rank: usize) {
    let (m, n) = matrix.shape();
    let kernels = Kernels::new(matrix, ZERO).unwrap();
    let Kernels { rank: found, gap, largest, .. } = kernels;
    let (right, left) = (kernels.right(), kernels.left());
    assert_eq!(found, rank, "{matrix} {gap:?}");
    assert_eq!((right.shape(), left.shape()), ((n, n - rank), (m, m - rank)));
    assert!(orthonormal(&right) && orthonormal(&left), "{matrix}");
    let small = SMALL * largest;
    assert!(most(&(matrix * &right)) <= small && most(&matrix.tr_mul(&left)) <= small, "{matrix}");
    let values = singular_values(matrix).unwrap();
    assert!(values.len() == m.min(n) && values.is_sorted_by(|a, b| a >= b && *b >= 0.0));
    let part = |k: usize| values[k] / values[0];
    let expected = [
        if rank == 0 { 1.0 } else { part(rank - 1) },
        if rank == m.min(n) || largest <= 0.0 { 0.0 } else { part(rank) },
    ];
    assert!((0..2).all(|k| (gap[k] - expected[k]).abs() <= 1e-15), "{gap:?} {expected:?}");
    let wanted = DVector::from_fn(m, |_, _| random.random_range(-1.0..1.0));
    let x = least_squares(matrix, &wanted, ZERO).unwrap();
    let residual = matrix * &x - &wanted;
    let scale = largest * (largest * x.norm() + wanted.norm());
    assert!(matrix.tr_mul(&residual).norm() <= SMALL * scale, "{matrix}");
    assert!(right.tr_mul(&x).norm() <= SMALL / gap[0] * x.norm(), "{matrix}");
    // What the matrix reaches is reached.
    let wanted = matrix * DVector::from_fn(n, |_, _| random.random_range(-1.0..1.0));
    let x = least_squares(matrix, &wanted, ZERO).unwrap();
    assert!((matrix * &x - &wanted).norm() <= small * (x.norm() + 1.0), "{matrix}");
}

/// The rank of a matrix of integers, by elimination without fractions (E. H. Bareiss, Math. Comp.
/// 22 (1968) 565).
fn exact_rank(matrix: &DMatrix<i128>) -> usize {
    let (mut a, mut before, mut rank) = (matrix.clone(), 1, 0);
    for column in 0..a.ncols() {
        let Some(row) = (rank..a.nrows()).find(|row| a[(*row, column)] != 0) else { continue };
        a.swap_rows(row, rank);
        let pivot = a[(rank, column)];
        for i in rank + 1..a.nrows() {
            let by = a[(i, column)];
            for j in column..a.ncols() {
                let minor = pivot * a[(i, j)] - by * a[(rank, j)];
                assert_eq!(minor % before, 0);
                a[(i, j)] = minor / before;
            }
        }
        (before, rank) = (pivot, rank + 1);
    }
    rank
}

#[test]
fn kernels_of_known_rank() {
    let random = &mut ChaCha8Rng::seed_from_u64(1);
    for (m, n) in [(0, 0), (0, 4), (3, 0), (1, 1), (1, 6), (7, 1), (5, 5), (40, 3), (4, 60)] {
        check(random, &DMatrix::zeros(m, n), 0);
    }
    for _ in 0..300 {
        let [m, n] = [(); 2].map(|()| random.random_range(1..=24));
        let rank = random.random_range(0..=m.min(n).min(6));
        // Singular values over four decades, the matrix over many.
        let values = DVector::from_fn(rank, |_, _| 10_f64.powf(random.random_range(-4.0..0.0)));
        let [left, right] = [m, n].map(|size| orthogonal(random, size));
        let size = 10_f64.powi(random.random_range(-140..140));
        let product = left.columns(0, rank) * DMatrix::from_diagonal(&values);
        check(random, &(product * right.columns(0, rank).transpose() * size), rank);
        // Rows and columns of thin factors over three decades each.
        let mut thin = any(random, m, rank.min(2)) * any(random, rank.min(2), n);
        let mut scale = || 10_f64.powf(random.random_range(-1.5..1.5));
        thin.row_iter_mut().for_each(|mut row| row *= scale());
        thin.column_iter_mut().for_each(|mut column| column *= scale());
        check(random, &thin, rank.min(2));
    }
}

#[test]
fn kernels_of_integers() {
    let random = &mut ChaCha8Rng::seed_from_u64(2);
    let mut lacking = 0;
    for _ in 0..1500 {
        let [m, n] = [(); 2].map(|()| random.random_range(1..=11));
        let some = random.random_range(0.1..1.0);
        let mut entry = || if random.random_bool(some) { random.random_range(-1..=1) } else { 0 };
        let matrix = DMatrix::from_fn(m, n, |_, _| entry());
        let rank = exact_rank(&matrix.map(i128::from));
        lacking += usize::from(rank < m.min(n));
        check(random, &matrix.map(f64::from), rank);
    }
    assert!(lacking > 300, "{lacking}");
}

#[test]
fn a_column_of_three_and_four() {
    let matrix = DMatrix::from_row_slice(2, 2, &[3.0, 0.0, 4.0, 0.0]);
    let values = singular_values(&matrix).unwrap();
    assert!((values[0] - 5.0).abs() <= 2e-15 && values[1].abs() <= 2e-15);
    let kernels = Kernels::new(&matrix, ZERO).unwrap();
    let Kernels { rank, gap, largest, .. } = kernels;
    let (right, left) = (kernels.right(), kernels.left());
    assert!(rank == 1 && (gap[0] - 1.0).abs() <= 1e-15 && gap[1] <= 1e-15);
    assert!((largest - 5.0).abs() <= 2e-15);
    assert!((right[1].abs() - 1.0).abs() <= 1e-15 && right[0].abs() <= 1e-15);
    assert!((left[0].abs() - 0.8).abs() <= 1e-15 && (left[0] * 3.0 + left[1] * 4.0).abs() <= 2e-15);
    let found = least_squares(&matrix, &DVector::from_vec(vec![4.0, -3.0]), ZERO).unwrap();
    assert!(found.norm() <= 1e-15);
    let found = least_squares(&matrix, &DVector::from_vec(vec![6.0, 8.0]), ZERO).unwrap();
    assert!((found[0] - 2.0).abs() <= 2e-15 && found[1].abs() <= 1e-15);
    // What counts lies above the limit: 1e-3 does for one, not for the other.
    let matrix = DMatrix::from_diagonal(&DVector::from_vec(vec![2.0, 2e-3]));
    for (zero, rank, gap) in [(1e-4, 2, [1e-3, 0.0]), (1e-2, 1, [1.0, 1e-3])] {
        let found = Kernels::new(&matrix, zero).unwrap();
        assert!(found.rank == rank && (0..2).all(|k| (found.gap[k] - gap[k]).abs() <= 1e-15));
    }
    let wanted = DVector::from_vec(vec![2.0, 2.0]);
    let found = [1e-4, 1e-2].map(|zero| least_squares(&matrix, &wanted, zero).unwrap()[1]);
    assert!((found[0] - 1e3).abs() <= 1e-9 && found[1].abs() <= 1e-15);
}

#[test]
fn spectra_known_beforehand() {
    let random = &mut ChaCha8Rng::seed_from_u64(3);
    for size in (0..30).chain([60]).flat_map(|size| [size; 4]) {
        // Several are equal, or zero.
        let scale = 10_f64.powi(random.random_range(-140..140));
        let mut known: Vec<f64> =
            (0..size).map(|_| scale * f64::from(random.random_range(-3_i8..=3))).collect();
        let diagonal = DMatrix::from_diagonal(&known.clone().into());
        let [basis, other] = [(); 2].map(|()| orthogonal(random, size));
        let symmetric = &basis * &diagonal * basis.transpose();
        let symmetric = 0.5 * (&symmetric + symmetric.transpose());
        let near = |a: &[f64], b: &[f64]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SMALL * scale)
        };
        known.sort_by(f64::total_cmp);
        assert!(near(&eigenvalues(&symmetric).unwrap(), &known), "{symmetric}");
        let (values, vectors) = eigen(&symmetric).unwrap();
        assert!(near(&values, &known) && values.is_sorted() && orthonormal(&vectors));
        let off = &symmetric * &vectors - &vectors * DMatrix::from_diagonal(&values.into());
        assert!(most(&off) <= SMALL * scale, "{symmetric}");
        let mut known: Vec<f64> = known.iter().map(|x| x.abs()).collect();
        known.sort_by(|a, b| b.total_cmp(a));
        assert!(near(&singular_values(&(basis * diagonal * other)).unwrap(), &known));
    }
}

#[test]
fn what_is_not_finite_gives_nothing() {
    let random = &mut ChaCha8Rng::seed_from_u64(4);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for size in [1, 2, 3, 8] {
            let right = DVector::from_element(size, 1.0);
            for (i, j) in [(0, 0), (size - 1, 0), (size - 1, size - 1)] {
                let mut matrix = any(random, size, size);
                matrix[(i, j)] = bad;
                matrix[(j, i)] = bad;
                assert!(eigen(&matrix).is_none() && eigenvalues(&matrix).is_none());
                assert!(
                    Kernels::new(&matrix, ZERO).is_none() && singular_values(&matrix).is_none()
                );
                assert!(least_squares(&matrix, &right, ZERO).is_none());
            }
            let matrix = any(random, size, size);
            assert!(least_squares(&matrix, &(right * bad), ZERO).is_none());
        }
    }
}

/// Of products of orthogonal matrices with a diagonal between, whose inverse is known; rows are exchanged throughout.
#[test]
fn inverses_of_known_matrices() {
    let random = &mut ChaCha8Rng::seed_from_u64(11);
    for size in [0, 1, 2, 3, 7, 31, 32, 33, 64, 65, 150] {
        let [left, right] = [(); 2].map(|()| orthogonal(random, size));
        let values =
            DVector::from_fn(size, |k, _| (if k % 2 == 0 { 4.0 } else { -0.1 }) + 0.01 * k as f64);
        let matrix = &left * DMatrix::from_diagonal(&values) * right.transpose();
        let wanted = &right * DMatrix::from_diagonal(&values.map(f64::recip)) * left.transpose();
        let off =
            (inverse(&matrix).unwrap() - wanted).iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let least = values.iter().fold(f64::INFINITY, |least, x| least.min(x.abs()));
        assert!(off <= 1e-13 / (least * least), "{size}: {off:e}");
    }
    let swap = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 4.0, 0.0]);
    assert_eq!(inverse(&swap).unwrap(), DMatrix::from_row_slice(2, 2, &[0.0, 0.25, 0.5, 0.0]));
    assert_eq!(inverse(&DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0])), None);
    assert_eq!(inverse(&DMatrix::from_element(2, 2, f64::NAN)), None);
}

#[test]
fn factors_solve_and_give_their_matrix_back() {
    let random = &mut ChaCha8Rng::seed_from_u64(12);
    for (size, columns) in [(0, 0), (1, 1), (2, 5), (3, 1), (9, 4), (40, 40)] {
        let spread = DMatrix::from_diagonal(&DVector::from_fn(size, |k, _| 1.0 + k as f64));
        let near = |a: &DMatrix<f64>, b: &DMatrix<f64>| most(&(a - b)) <= 1e-11;
        // A reflection and a stretch: the determinant is known, and its sign.
        let [left, right] = [(); 2].map(|()| orthogonal(random, size));
        let matrix = &left * &spread * &right;
        let wanted = DVector::from_fn(size, |_, _| random.random_range(-1.0..1.0));
        let lu = Lu::new(&matrix).unwrap();
        assert!((&matrix * lu.solve(&wanted) - wanted).norm() <= 1e-12);
        let told: f64 = (1..=size).map(|k| k as f64).product();
        assert!((lu.determinant() / told - 1.0).abs() <= 1e-12, "{size}");
        // From the triangle of a definite matrix.
        let definite = &left * &spread * left.transpose();
        let factor = Cholesky::new(&definite).unwrap();
        let unit = DMatrix::identity(size, size);
        let inverse = factor.solve_transposed(factor.solve(unit.clone()));
        assert!(near(&(&definite * inverse), &unit));
        assert!(near(&factor.solve(definite.clone()).upper_triangle(), &factor.solve(definite)));
        // The rows of R are those of the matrix, turned.
        let tall = any(random, size + columns, columns);
        let [upper, turned] = qr(tall.clone(), tall.clone());
        assert!(near(&turned.rows(0, columns).into_owned(), &upper));
        assert!(most(&turned.rows(columns, size).into_owned()) <= SMALL);
        assert!(near(&upper.tr_mul(&upper), &tall.tr_mul(&tall)));
        // By their entries.
        let found = projected(&matrix, &right.columns(0, size.min(2)).into_owned());
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().filter(|(i, j)| *i.max(j) < size)
        {
            let sum: f64 = (0..size * size)
                .map(|k| right[(k / size, i)] * matrix[(k / size, k % size)] * right[(k % size, j)])
                .sum();
            assert!((found[(i, j)] - sum).abs() <= 1e-11);
        }
    }
    let turned = DMatrix::from_row_slice(2, 2, &[0.0, 2.0, 3.0, 0.0]);
    assert!((Lu::new(&turned).unwrap().determinant() + 6.0).abs() <= 1e-15);
    let found = Lu::new(&turned).unwrap().solve(&DVector::from_vec(vec![4.0, 9.0]));
    assert_eq!(found.as_slice(), [3.0, 2.0]);
    assert!(Cholesky::new(&turned).is_none());
    let lower = Cholesky::new(&DMatrix::from_row_slice(2, 2, &[4.0, 0.0, 2.0, 10.0])).unwrap();
    let right = || DMatrix::from_column_slice(2, 1, &[6.0, 9.0]);
    // L = (2, 0; 1, 3).
    assert_eq!(lower.solve(right()).as_slice(), [3.0, 2.0]);
    assert_eq!(lower.solve_transposed(right()).as_slice(), [1.5, 3.0]);
    let two = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 3.0, 4.0]);
    assert_eq!(product(&two, &turned), DMatrix::from_row_slice(2, 2, &[6.0, 2.0, 12.0, 6.0]));
    let tall = DMatrix::from_row_slice(3, 2, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(apply(&tall, &DVector::from_vec(vec![10.0, 1.0])).as_slice(), [12.0, 34.0, 56.0]);
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(Lu::new(&DMatrix::from_element(2, 2, bad)).is_none());
    }
    assert!(Lu::new(&DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0])).is_none());
}

/// Of `L L^T` with L = (2, 0, 0; 1, 3, 0; -1, 2, 1), and of diag(3, 1, 2) in other axes.
#[test]
fn three_rows() {
    let matrix = [[4.0, 2.0, -2.0], [2.0, 10.0, 5.0], [-2.0, 5.0, 6.0]];
    let right = matrix.map(|row| row[0] + 2.0 * row[1] + 3.0 * row[2]);
    let found = solve_three(&matrix, right).unwrap();
    assert!((0..3).all(|k| (found[k] - [1.0, 2.0, 3.0][k]).abs() <= 1e-14), "{found:?}");
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(solve_three(&[[1.0, 0.0, 0.0], [0.0, bad, 0.0], [0.0, 0.0, 1.0]], right), None);
    }
    let (s, c) = (0.6, 0.8);
    let turn = Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
    let symmetric = turn * Matrix3::from_diagonal(&Vector3::new(3.0, 1.0, 2.0)) * turn.transpose();
    let (values, vectors) = eigen_of_three(&symmetric).unwrap();
    for (k, (value, axis)) in [(1.0, 1), (2.0, 2), (3.0, 0)].into_iter().enumerate() {
        assert!((values[k] - value).abs() <= 1e-14);
        assert!((vectors.column(k).dot(&turn.column(axis)).abs() - 1.0).abs() <= 1e-14);
    }
    assert_eq!(eigen_of_three(&(symmetric * f64::NAN)), None);
}

/// A turn by 0.3 and a stretch by 2 and by -5, in any basis.
#[test]
fn complex_eigenvalues_known_beforehand() {
    let random = &mut ChaCha8Rng::seed_from_u64(13);
    let (sin, cos) = 0.3_f64.sin_cos();
    let entries = [2.0 * cos, -2.0 * sin, 0.0, 2.0 * sin, 2.0 * cos, 0.0, 0.0, 0.0, -5.0];
    let basis = orthogonal(random, 3);
    let matrix = &basis * DMatrix::from_row_slice(3, 3, &entries) * basis.transpose();
    let mut found = complex_eigenvalues(&matrix).unwrap();
    found.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    found[1..].sort_by(|a, b| a[1].total_cmp(&b[1]));
    let wanted = [[-5.0, 0.0], [2.0 * cos, -2.0 * sin], [2.0 * cos, 2.0 * sin]];
    for (found, wanted) in found.iter().flatten().zip(wanted.as_flattened()) {
        assert!((found - wanted).abs() <= 1e-13, "{found} {wanted}");
    }
    assert_eq!(complex_eigenvalues(&DMatrix::zeros(0, 0)), Some(Vec::new()));
    assert_eq!(complex_eigenvalues(&(matrix * f64::INFINITY)), None);
}

/// Across (3, 4) and the same with a part of (-4, 3): nothing, or what is not counted.
#[test]
fn what_is_across_columns_by_their_size() {
    for (part, count) in [(3e-6, 0), (3e-7, 1)] {
        let columns = DMatrix::from_column_slice(
            2,
            2,
            &[3.0, 4.0, 3.0 - 4.0 * part, 4.0 + 3.0 * part].map(|x| 1e200 * x),
        );
        let found = across(&columns, 1e-6);
        assert_eq!(found.ncols(), count, "{part}");
        assert!(found.iter().zip([0.8, 0.6]).all(|(x, size)| (x.abs() - size).abs() <= part));
    }
    assert_eq!(across(&DMatrix::zeros(2, 0), 1e-6), DMatrix::identity(2, 2));
    assert_eq!(across(&DMatrix::zeros(2, 3), 1e-6).ncols(), 2);
}

/// Beside unit vectors these are rounding, and by themselves of full rank.
#[test]
fn rank_counts_over_the_scale_that_is_given() {
    let rounding = DMatrix::from_row_slice(2, 2, &[1e-20, 0.0, 0.0, 1e-22]);
    let by_itself = Kernels::new(&rounding, 1e-6).unwrap();
    assert_eq!((by_itself.rank, by_itself.largest), (2, 1e-20));
    let found = Kernels::at_scale(&rounding, 1e-6, 1.0).unwrap();
    assert_eq!((found.rank, found.gap, found.largest), (0, [1.0, 1e-20], 1.0));
    assert_eq!((found.right().ncols(), found.left().ncols()), (2, 2));
}
