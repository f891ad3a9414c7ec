//! A proved lower bound of the least eigenvalue of a sparse symmetric matrix, by a factorisation in
//! floating point.
//!
//! # The bound
//!
//! Let the factorisation of $A - \sigma I$ run to its end with positive pivots $d$, and let
//! $G = L \sqrt D$. Every entry of $L$ and $D$ was computed from
//!
//! $$ a_{ij} = \sum_{k \le j} l_{ik} d_k l_{jk}, \qquad i \ge j, $$
//!
//! solved for $l_{ij}$, or $d_j$. A product with a factor zero is exact, and so is adding it; hence only the
//! $m_{ij}$ terms with $l_{ik} l_{jk} \ne 0$ round. In whatever order and in whatever groups the
//! library adds them, with fused operations or without, each term and $a_{ij}$ itself pass through
//! at most $m_{ij}$ additions that round, and through at most eight operations besides: two
//! products, and quotients by the pivots. Hence
//! $a_{ij}(1 + \theta_0) = \sum_k l_{ik} d_k l_{jk} (1 + \theta_k)$ with all $|\theta| \le
//! \gamma_{m_{ij} + 8}$, where $\gamma_m = m u/(1 - m u)$ and $u = 2^{-53}$; divided by
//! $1 + \theta_0$,
//!
//! $$ |E_{ij}| \le \gamma_{2 m_{ij} + 16} \big(|G| |G|^T\big)_{ij}, \qquad
//!    A - \sigma I + E = G G^T \ge 0. $$
//!
//! $E$ is symmetric, so its norm is at most its largest row sum, and $m_{ij}$ is at most the number
//! $k_i$ of entries in row $i$ of $G$ that are not zero:
//!
//! $$ \lambda_{\min}(A) \ge \sigma - \max_i \gamma_{2 k_i + 16} \big(|G| (|G|^T 1)\big)_i. $$
//!
//! Two passes over the factor give that number. It knows the matrix by the longest row of its
//! factor and not by its size: in a plane net of $n$ joints a row has some $\sqrt n$ entries, in a
//! chain two. The bound by the trace, $\gamma_{n + 1}\\,\mathrm{tr}(A)$, is larger by the number of
//! joints and more.
//!
//! Underflow adds at most [`TINY`] times the largest entry to each operation.
//!
//! # References
//!
//! S. M. Rump, BIT Numer. Math. 46 (2006) 433-452, doi:10.1007/s10543-006-0056-1 (definiteness by
//! floating-point Cholesky, and the count of the terms that are not zero); N. J. Higham, Accuracy
//! and Stability of Numerical Algorithms (2002), lemma 8.4 and theorem 10.3.

use matrices::sparse::{Entries, Ldlt, Pivots, minimum_degree};

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
    /// The first entry of a column is that on the diagonal.
    matrix: Entries,
    factor: Ldlt,
}

impl Factor {
    /// The order of elimination, approximate minimum degree, and the pattern of the factor;
    /// nothing without memory for it.
    fn new(matrix: &Symmetric) -> Option<Self> {
        let diagonal = (0..matrix.size).map(|k| (k, k, 0.0));
        let entries: Vec<_> = diagonal.chain(matrix.below.iter().copied()).collect();
        let matrix = Entries::new(matrix.size, &entries);
        drop(entries);
        let order = minimum_degree(&matrix.starts, &matrix.rows)?;
        let factor = Ldlt::new(&matrix.starts, &matrix.rows, &order)?;
        Some(Self { matrix, factor })
    }

    /// A lower bound of the least eigenvalue by the factorisation of the matrix less `shift`;
    /// nothing where that does not run to its end.
    fn bound(&mut self, matrix: &Symmetric, shift: f64) -> Option<f64> {
        for (&at, entry) in self.matrix.starts.iter().zip(&matrix.diagonal) {
            self.matrix.values[at] = entry - shift;
        }
        if !self.factor.factorise(&self.matrix.values, Pivots::Positive) {
            return None;
        }
        let largest = matrix.diagonal.iter().fold(shift, |most, d| most.max(d.abs()));
        // Of the entries on the diagonal, and of the difference that is returned.
        let subtracted = 3.0 * gamma(1) * (largest + shift);
        let error = self.error()? + subtracted + matrix.uncertainty;
        Some(shift - error).filter(|bound| bound.is_finite())
    }

    /// A guess of the least eigenvalue of the matrix that was factorised last, from above: the norm
    /// of a vector over that of the solution with it.
    fn least_of_factored(&self, size: usize) -> f64 {
        // The lowest mode of a matrix of pulling members has one sign.
        let mut vector: Vec<f64> =
            (0..size).map(|k| 1.0 + (0.618_034 * k as f64).fract()).collect();
        let mut length = f64::NAN;
        for _ in 0..STEPS {
            let before = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            for x in &mut vector {
                *x /= before;
            }
            self.factor.solve(&mut vector);
            length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        }
        length.recip()
    }

    /// The bound of the norm of $E$; nothing where an entry of the factor is not finite.
    fn error(&self) -> Option<f64> {
        let size = self.factor.size();
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
        let mut lengths = vec![0_usize; self.factor.size()];
        self.entries(|row, _, _| lengths[row] += 1);
        lengths.into_iter().max().unwrap_or(0)
    }

    /// Row, column and value of every entry of $G$, in the order of elimination.
    fn entries(&self, mut visit: impl FnMut(usize, usize, f64)) {
        let roots: Vec<f64> = self.factor.pivots().iter().map(|pivot| pivot.sqrt()).collect();
        roots.iter().enumerate().for_each(|(k, root)| visit(k, k, *root));
        self.factor.lower(|row, column, value| visit(row, column, roots[column] * value));
    }
}

#[cfg(test)]
mod tests;
