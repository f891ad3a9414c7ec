//! Sums of many numbers whose rounding errors do not pile up, without a proof.

use crate::rounding::two_sum;

/// A compensated running sum: as accurate as if it were added with twice the digits and rounded
/// once.
///
/// ```
/// use numerics::CompensatedSum;
/// let mut sum = CompensatedSum::default();
/// for term in [1e16, 1.0, -1e16] {
///     sum.add(term);
/// }
/// assert_eq!(sum.value(), 1.0);
/// ```
///
/// # References
///
/// T. Ogita, S. M. Rump, S. Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26 (2005)
/// 1955-1988, doi:10.1137/030601818, algorithm 4.4
#[derive(Debug, Clone, Copy, Default)]
pub struct CompensatedSum {
    total: f64,
    errors: f64,
}

impl CompensatedSum {
    /// Add a term.
    ///
    /// ```
    /// let mut sum = numerics::CompensatedSum::default();
    /// sum.add(0.5);
    /// assert_eq!(sum.value(), 0.5);
    /// ```
    #[inline]
    pub fn add(&mut self, term: f64) {
        let (total, error) = two_sum(self.total, term);
        self.total = total;
        self.errors += error;
    }

    /// What all the terms add up to.
    ///
    /// ```
    /// assert_eq!(numerics::CompensatedSum::default().value(), 0.0);
    /// ```
    #[must_use]
    pub fn value(&self) -> f64 {
        self.total + self.errors
    }
}
