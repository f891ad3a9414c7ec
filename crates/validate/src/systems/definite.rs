//! A proved lower bound of the least eigenvalue of a sparse symmetric matrix, by Cholesky's
//! factorisation in floating point.
//!
//! # The bound
//!
//! Let the factorisation of $A - \sigma I$ run to its end with finite numbers, and let $L$ be what
//! it returns. Every entry was computed from
//!
//! $$ a_{ij} = \sum_{k \le j} l_{ik} l_{jk}, \qquad i \ge j, $$
//!
//! solved for $l_{ij}$. A product with a factor zero is exact, and so is adding it; hence only the
//! $m_{ij}$ terms with $l_{ik} l_{jk} \ne 0$ round. In whatever order and in whatever groups the
//! library adds them, with fused operations or without, each term and $a_{ij}$ itself pass through
//! at most $m_{ij}$ additions that round, and through at most eight operations besides: the
//! product, the root, the reciprocals of the pivots and the multiplications by these. Hence
//! $a_{ij}(1 + \theta_0) = \sum_k l_{ik} l_{jk} (1 + \theta_k)$ with all $|\theta| \le
//! \gamma_{m_{ij} + 8}$, where $\gamma_m = m u/(1 - m u)$ and $u = 2^{-53}$; divided by
//! $1 + \theta_0$,
//!
//! $$ |E_{ij}| \le \gamma_{2 m_{ij} + 16} \big(|L| |L|^T\big)_{ij}, \qquad
//!    A - \sigma I + E = L L^T \ge 0. $$
//!
//! $E$ is symmetric, so its norm is at most its largest row sum, and $m_{ij}$ is at most the number
//! $k_i$ of entries in row $i$ of $L$ that are not zero:
//!
//! $$ \lambda_{\min}(A) \ge \sigma - \max_i \gamma_{2 k_i + 16} \big(|L| (|L|^T 1)\big)_i. $$
//!
//! Two passes over the factor give that number. It knows the matrix by the longest row of its
//! factor and not by its size: in a plane net of $n$ joints a row has some $\sqrt n$ entries, in a
//! chain two. The bound by the trace, $\gamma_{n + 1}\,\mathrm{tr}(A)$, is larger by the number of
//! joints and more.
//!
//! Underflow adds at most [`TINY`] times the largest entry to each operation.
//!
//! # References
//!
//! S. M. Rump, BIT Numer. Math. 46 (2006) 433-452, doi:10.1007/s10543-006-0056-1 (definiteness by
//! floating-point Cholesky, and the count of the terms that are not zero); N. J. Higham, Accuracy
//! and Stability of Numerical Algorithms (2002), lemma 8.4 and theorem 10.3.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Par, Side, Spec};

/// Roundings of a term besides the additions.
const OTHER_ROUNDINGS: usize = 8;
/// Above the rounding of the sums over the factor themselves, of at most 2^40 positive terms.
const SUMS: f64 = 1.001;
/// An operation that underflows is off by half the smallest number at most; far above it.
const TINY: f64 = f64::MIN_POSITIVE;
/// The diagonal of a matrix lies between these: no square, no reciprocal of a pivot is out of
/// range.
const RANGE: [f64; 2] = [1e-140, 1e140];
/// First guess of the bound, in units of the longest row of the factor times the rounding of the
/// largest diagonal: 1.5 of one joint, 7 of a net of 40 x 40.
const GROWTH: f64 = 16.0;
/// The shift in units of the bound: half of it is left as a lower bound of the eigenvalues.
const TWICE: f64 = 2.0;
/// Steps of inverse iteration for a guess of the least eigenvalue, and how much of the guess is
/// tried to be proved.
const STEPS: usize = 8;
const HALF: f64 = 0.5;

/// A symmetric matrix whose entries below the diagonal are given, several at one place added up.
pub(super) struct Symmetric {
    pub size: usize,
    /// Row, column above it, value.
    pub below: Vec<(usize, usize, f64)>,
    pub diagonal: Vec<f64>,
    /// The true matrix is nowhere further from this one: a bound of the norm of the difference.
    pub uncertainty: f64,
}

impl Symmetric {
    /// A proved lower bound of the least eigenvalue, if it is proved positive; one as large as
    /// `wanted`, where the matrix allows, else of the size of the eigenvalue.
    ///
    /// The wanted shift is tried first; where it is too large the least one that rounding ought to
    /// allow, and then half of what inverse iteration with that factor takes for the eigenvalue.
    pub fn least_eigenvalue(&self, wanted: f64) -> Option<f64> {
        if self.size == 0 {
            return Some(f64::INFINITY);
        }
        let largest = self.diagonal.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        // NaN is in no range.
        if !(RANGE[0]..=RANGE[1]).contains(&largest) || self.uncertainty.is_nan() {
            return None;
        }
        let mut factor = Factor::new(self)?;
        let operations = 2 * (factor.longest_row() + OTHER_ROUNDINGS);
        let least = TWICE * (GROWTH * gamma(operations) * largest + self.uncertainty);
        if TWICE * wanted > least
            && let Some(bound) = factor.bound(self, TWICE * wanted).filter(|bound| *bound > 0.0)
        {
            return Some(bound);
        }
        let (mut shift, mut proved) = (least, factor.bound(self, least)?);
        if proved <= 0.0 {
            // Rounding is more than guessed.
            shift = TWICE * (shift - proved);
            proved = factor.bound(self, shift).filter(|bound| *bound > 0.0)?;
        }
        if proved < wanted {
            let half = HALF * (shift + factor.least_of_factored(self.size));
            let better = if half > TWICE * shift { factor.bound(self, half) } else { None };
            proved = better.map_or(proved, |better| better.max(proved));
        }
        Some(proved)
    }
}

/// `m u / (1 - m u)`, rounded up.
pub(super) fn gamma(operations: usize) -> f64 {
    let unit = 0.5 * f64::EPSILON * (operations + 2) as f64;
    unit / (1.0 - unit)
}

/// The factor of a shifted matrix.
struct Factor {
    matrix: SparseColMat<usize, f64>,
    /// Where the diagonal stands in the values of the matrix.
    diagonal: Vec<usize>,
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
}

impl Factor {
    /// The order of elimination, approximate minimum degree, and the pattern of the factor;
    /// nothing without memory for it.
    fn new(matrix: &Symmetric) -> Option<Self> {
        let size = matrix.size;
        let entries =
            matrix.below.iter().map(|&(row, column, value)| Triplet::new(row, column, value));
        let diagonal = (0..size).map(|k| Triplet::new(k, k, 0.0));
        let entries: Vec<_> = entries.chain(diagonal).collect();
        let matrix = SparseColMat::try_new_from_triplets(size, size, &entries).ok()?;
        drop(entries);
        let symbolic = factorize_symbolic_cholesky(
            matrix.symbolic(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .ok()?;
        let scratch = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let memory = MemBuffer::try_new(scratch).ok()?;
        // Below the diagonal nothing comes before it in its column.
        let diagonal = matrix.symbolic().col_ptr()[..size].to_vec();
        let values = vec![0.0; symbolic.len_val()];
        Some(Self { matrix, diagonal, symbolic, values, memory })
    }

    /// A lower bound of the least eigenvalue by the factorisation of the matrix less `shift`;
    /// nothing where that does not run to its end.
    fn bound(&mut self, matrix: &Symmetric, shift: f64) -> Option<f64> {
        let values = self.matrix.val_mut();
        for (&at, entry) in self.diagonal.iter().zip(&matrix.diagonal) {
            values[at] = entry - shift;
        }
        let done = self.symbolic.factorize_numeric_llt(
            &mut self.values,
            self.matrix.as_ref(),
            Side::Lower,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        done.ok()?;
        let largest = matrix.diagonal.iter().fold(shift, |most, d| most.max(d.abs()));
        // Of the entries on the diagonal, and of the difference that is returned.
        let subtracted = 3.0 * gamma(1) * (largest + shift);
        let error = self.error()? + subtracted + matrix.uncertainty;
        Some(shift - error).filter(|bound| bound.is_finite())
    }

    /// A guess of the least eigenvalue of the matrix that was factorised last, from above: the norm
    /// of a vector over that of the solution with it.
    fn least_of_factored(&mut self, size: usize) -> f64 {
        // The lowest mode of a matrix of pulling members has one sign.
        let mut vector: Vec<f64> =
            (0..size).map(|k| 1.0 + (0.618_034 * k as f64).fract()).collect();
        let mut length = f64::NAN;
        for _ in 0..STEPS {
            let before = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            for x in &mut vector {
                *x /= before;
            }
            LltRef::<usize, f64>::new(&self.symbolic, &self.values).solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(&mut vector, size, 1),
                Par::Seq,
                MemStack::new(&mut self.memory),
            );
            length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        }
        length.recip()
    }

    /// The bound of the norm of $E$; nothing where an entry of the factor is not finite.
    fn error(&self) -> Option<f64> {
        let size = self.diagonal.len();
        let (mut lengths, mut columns) = (vec![0_usize; size], vec![0.0_f64; size]);
        let mut largest = 1.0_f64;
        self.entries(|row, column, entry| {
            let entry = entry.abs();
            lengths[row] += usize::from(entry > 0.0);
            columns[column] += entry;
            largest = largest.max(entry);
        });
        // A sum over an entry that is not finite is none.
        if !columns.iter().all(|sum| sum.is_finite()) {
            return None;
        }
        let mut rows = vec![0.0_f64; size];
        self.entries(|row, column, entry| rows[row] += entry.abs() * columns[column]);
        let of_row = |(sum, length): (&f64, &usize)| {
            let operations = 2 * (length + OTHER_ROUNDINGS);
            SUMS * gamma(operations) * sum + operations as f64 * size as f64 * TINY * largest
        };
        let error = rows.iter().zip(&lengths).map(of_row).fold(0.0, f64::max);
        error.is_finite().then_some(error)
    }

    /// The most entries in a row of the factor, padding included.
    fn longest_row(&self) -> usize {
        let mut lengths = vec![0_usize; self.diagonal.len()];
        self.entries(|row, _, _| lengths[row] += 1);
        lengths.into_iter().max().unwrap_or(0)
    }

    /// Row, column and value of every entry of the factor, in the order of elimination.
    fn entries(&self, mut visit: impl FnMut(usize, usize, f64)) {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(pattern) => {
                let (starts, rows) = (pattern.col_ptr(), pattern.row_idx());
                for column in 0..pattern.ncols() {
                    let own = starts[column]..starts[column + 1];
                    for (&row, &value) in rows[own.clone()].iter().zip(&self.values[own]) {
                        visit(row, column, value);
                    }
                }
            }
            SymbolicCholeskyRaw::Supernodal(pattern) => {
                let factor = SupernodalLltRef::<usize, f64>::new(pattern, &self.values);
                for number in 0..pattern.n_supernodes() {
                    let node = factor.supernode(number);
                    let (start, block) = (node.start(), node.val());
                    let width = block.ncols();
                    for k in 0..width {
                        let values = block.col(k);
                        for row in k..width {
                            visit(start + row, start + k, values[row]);
                        }
                        for (below, &row) in node.pattern().iter().enumerate() {
                            visit(row, start + k, values[width + below]);
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use faer::Mat;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// Joints of a grid with `-1` between neighbours and `diagonal` at each.
    fn grid(wide: usize, high: usize, diagonal: f64) -> Symmetric {
        let mut below = Vec::new();
        for k in 0..wide * high {
            if k % wide > 0 {
                below.push((k, k - 1, -1.0));
            }
            if k >= wide {
                below.push((k, k - wide, -1.0));
            }
        }
        let size = wide * high;
        Symmetric { size, below, diagonal: vec![diagonal; size], uncertainty: 0.0 }
    }

    /// What the entries beside the diagonal take off it: `2 cos` of the first mode each way.
    fn taken(wide: usize, high: usize) -> f64 {
        [wide, high].iter().map(|n| 2.0 * (PI / (n + 1) as f64).cos()).sum()
    }

    fn supernodal(matrix: &Symmetric) -> bool {
        let factor = Factor::new(matrix).unwrap();
        matches!(factor.symbolic.raw(), SymbolicCholeskyRaw::Supernodal(_))
    }

    /// A chain and a net, by both kinds of factors, on both sides of zero: the closed form of the
    /// least eigenvalue is right to the rounding of the diagonal.
    #[test]
    fn nearly_singular_matrices_are_told_from_nearly_definite_ones() {
        for (wide, high) in [(100_000, 1), (150, 150)] {
            // A row of joints has no neighbours across.
            let taken =
                if high == 1 { 2.0 * (PI / (wide + 1) as f64).cos() } else { taken(wide, high) };
            assert_eq!(supernodal(&grid(wide, high, taken)), high > 1);
            for over in [1e-3, 1e-6, 1e-9, 3e-11] {
                let matrix = grid(wide, high, taken + over);
                let bound = matrix.least_eigenvalue(over / 4.0).unwrap();
                assert!(bound > 0.0 && bound <= over + 1e-14, "{wide} x {high}, {over}: {bound}");
                let beyond = grid(wide, high, taken - over);
                assert_eq!(beyond.least_eigenvalue(0.0), None, "{wide} x {high}, {over}");
                assert_eq!(beyond.least_eigenvalue(over), None, "{wide} x {high}, {over}");
            }
        }
    }

    /// The bound by the trace, 1e-16 times the size times the sum of the diagonal, is 2e-6 here.
    #[test]
    fn rounding_is_known_by_the_rows_of_the_factor() {
        let matrix = grid(100_000, 1, 2.0 + 1e-9);
        let mut factor = Factor::new(&matrix).unwrap();
        let shift = 1e-9;
        let bound = factor.bound(&matrix, shift).unwrap();
        assert!(shift - bound < 1e-13, "{:e}", shift - bound);
    }

    #[test]
    fn what_is_wanted_is_given_where_there_is_as_much() {
        let (wide, high) = (40, 40);
        let matrix = grid(wide, high, taken(wide, high) + 1e-3);
        assert!(matrix.least_eigenvalue(4e-4).unwrap() >= 4e-4);
        for more in [9e-4, 1.0, f64::INFINITY] {
            let bound = matrix.least_eigenvalue(more).unwrap();
            assert!(bound > 4e-4 && bound < 1e-3, "{bound}");
        }
        assert!(matrix.least_eigenvalue(f64::NAN).unwrap() > 0.0);
    }

    /// Dense eigenvalues are right to some 1e-13 of the largest entry.
    #[test]
    fn the_bound_is_below_the_eigenvalues_of_random_matrices() {
        let mut random = ChaCha8Rng::seed_from_u64(2006);
        let (mut proved, mut refused) = (0, 0);
        for _ in 0..300 {
            let size = random.random_range(1..30);
            let mut dense = Mat::<f64>::zeros(size, size);
            let (mut below, mut diagonal) = (Vec::new(), Vec::new());
            for row in 0..size {
                for column in 0..row {
                    if random.random_bool(0.3) {
                        let value = random.random_range(-1.0..1.0);
                        below.push((row, column, value));
                        (dense[(row, column)], dense[(column, row)]) = (value, value);
                    }
                }
                diagonal.push(random.random_range(0.0..4.0));
                dense[(row, row)] = diagonal[row];
            }
            let least = dense.self_adjoint_eigenvalues(Side::Lower).unwrap()[0];
            let matrix = Symmetric { size, below, diagonal, uncertainty: 0.0 };
            let bound = matrix.least_eigenvalue(least / 4.0);
            if least > 1e-9 {
                assert!(bound.is_some_and(|bound| bound >= least / 4.0 && bound <= least + 1e-13));
                proved += 1;
            } else if least < -1e-9 {
                assert_eq!(bound, None, "{least}");
                refused += 1;
            }
        }
        assert!(proved > 50 && refused > 50, "{proved}, {refused}");
    }

    /// All entries one and a thousandth more on the diagonal, of 64 joints: the first column of the
    /// factor is of ones, so that the sums over its rows are some 64, four times the guess, and the
    /// shift is taken again from them.
    #[test]
    fn rounding_that_is_more_than_guessed_is_outrun() {
        let size = 64;
        let pairs = (0..size).flat_map(|row| (0..row).map(move |column| (row, column, 1.0)));
        let diagonal = vec![1.001; size];
        let matrix = Symmetric { size, below: pairs.collect(), diagonal, uncertainty: 0.0 };
        let bound = matrix.least_eigenvalue(0.0).unwrap();
        assert!(bound > 0.0 && bound < 1e-10, "{bound}");
    }

    /// Where the true matrix may be nearer to singular by 1, so is the bound.
    #[test]
    fn what_is_uncertain_is_taken_off() {
        let matrix = Symmetric { size: 1, below: vec![], diagonal: vec![8.0], uncertainty: 1.0 };
        let bound = Factor::new(&matrix).unwrap().bound(&matrix, 7.5).unwrap();
        assert!(bound < 6.5 && bound > 6.5 - 1e-13, "{bound}");
    }

    /// The least mode of `[2 1; 1 2]` has two signs, and the eigenvalue 1. More than there is was
    /// wanted: half of it is proved.
    #[test]
    fn the_least_mode_is_found_whatever_its_signs() {
        let below = vec![(1, 0, 1.0)];
        let matrix = Symmetric { size: 2, below, diagonal: vec![2.0; 2], uncertainty: 0.0 };
        let bound = matrix.least_eigenvalue(10.0).unwrap();
        assert!(bound > 0.499 && bound < 1.0, "{bound}");
    }

    /// Twice what is wanted is tried first, and what is proved by it is told.
    #[test]
    fn the_bound_is_that_of_the_shift_that_was_tried() {
        let matrix = Symmetric { size: 1, below: vec![], diagonal: vec![1.0], uncertainty: 0.0 };
        let bound = matrix.least_eigenvalue(0.375).unwrap();
        assert!(bound < 0.75 && bound > 0.75 - 1e-13, "{bound}");
    }

    /// By hand, in any order of elimination: `[4]` has the factor `[2]`, its one row the sum 4 and
    /// 2 (1 + 8) + 2 roundings. `[4 2; 2 4]` has the rows (2, 0) and (1, √3): the sums over the
    /// columns are 3 and √3, over the rows 6 both, with 2 (2 + 8) + 2 roundings in the longer.
    #[test]
    fn the_error_of_a_factor_is_the_rows_of_its_product() {
        let error = |size: usize, below: Vec<(usize, usize, f64)>| {
            let matrix = Symmetric { size, below, diagonal: vec![4.0; size], uncertainty: 0.0 };
            let mut factor = Factor::new(&matrix).unwrap();
            factor.bound(&matrix, 0.0).unwrap();
            factor.error().unwrap() / (1.001 * 0.5 * f64::EPSILON)
        };
        assert!((error(1, vec![]) / (4.0 * 20.0) - 1.0).abs() < 1e-12);
        assert!((error(2, vec![(1, 0, 2.0)]) / (6.0 * 22.0) - 1.0).abs() < 1e-12);
    }

    /// `2^50` operations are an eighth, and an eighth over seven eighths a seventh.
    #[test]
    fn many_roundings_are_more_than_their_sum() {
        assert!((gamma((1 << 50) - 2) * 7.0 - 1.0).abs() < 1e-15);
        assert!((gamma(8) / (5.0 * f64::EPSILON) - 1.0).abs() < 1e-14);
    }

    /// The squares in a row of the factor add up to the diagonal, which is the same in all rows. The
    /// products of its rows with the sums over its columns are the sums over the rows of the matrix,
    /// in whatever order.
    #[test]
    fn every_entry_of_a_factor_stands_in_its_row_and_column() {
        let sorted = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            values
        };
        for (wide, high) in [(30, 1), (5, 4), (150, 150)] {
            let matrix = grid(wide, high, 4.5);
            let mut wanted = matrix.diagonal.clone();
            for (row, column, value) in &matrix.below {
                wanted[*row] += value;
                wanted[*column] += value;
            }
            let mut factor = Factor::new(&matrix).unwrap();
            factor.bound(&matrix, 0.0).unwrap();
            let (mut squares, mut columns) = (vec![0.0; matrix.size], vec![0.0; matrix.size]);
            factor.entries(|row, column, entry| {
                squares[row] += entry * entry;
                columns[column] += entry;
            });
            let mut rows = vec![0.0; matrix.size];
            factor.entries(|row, column, entry| rows[row] += entry * columns[column]);
            assert!(squares.iter().all(|sum| (sum - 4.5).abs() < 1e-13), "{wide} x {high}");
            let apart = sorted(rows).into_iter().zip(sorted(wanted)).map(|(a, b)| (a - b).abs());
            assert!(apart.fold(0.0, f64::max) < 1e-12, "{wide} x {high}");
        }
        // The large net by the other kind of factor.
        assert!(supernodal(&grid(150, 150, 4.5)) && !supernodal(&grid(30, 1, 4.5)));
    }

    /// Where all are neighbours the last row is full, in any order.
    #[test]
    fn the_longest_row_is_that_of_the_factor() {
        let longest = |matrix: &Symmetric| Factor::new(matrix).unwrap().longest_row();
        assert_eq!(longest(&grid(1, 1, 3.0)), 1);
        assert_eq!(longest(&grid(2, 1, 3.0)), 2);
        let below = vec![(1, 0, 1.0), (2, 0, 1.0), (2, 1, 1.0)];
        let all = Symmetric { size: 3, below, diagonal: vec![4.0; 3], uncertainty: 0.0 };
        assert_eq!(longest(&all), 3);
    }

    #[test]
    fn numbers_that_are_none_prove_nothing() {
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e200] {
            let mut matrix = grid(3, 3, 8.0);
            matrix.diagonal[4] = bad;
            assert_eq!(matrix.least_eigenvalue(1.0), None, "{bad}");
        }
        let mut matrix = grid(3, 3, 8.0);
        matrix.below[2].2 = f64::NAN;
        assert_eq!(matrix.least_eigenvalue(1.0), None);
        matrix = grid(3, 3, 8.0);
        matrix.uncertainty = 9.0;
        assert_eq!(matrix.least_eigenvalue(1.0), None);
    }
}
