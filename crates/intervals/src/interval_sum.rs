//! Sums of many intervals whose rounding errors do not pile up.

use crate::interval::Interval;
use crate::rounding::two_sum;

/// A running sum: the error of each addition is computed exactly (Knuth's two-sum) and summed in an
/// interval of its own, so that the result is as narrow as its terms, up to about one rounding of
/// the result, however many there are.
///
/// ```
/// use intervals::{Interval, IntervalSum};
/// let mut sum = IntervalSum::ZERO;
/// for term in [1e16, 1.0, -1e16] {
///     sum.add(Interval::point(term));
/// }
/// assert!(sum.value().contains(1.0) && sum.value().width() < 4e-15);
/// ```
///
/// # References
///
/// D. E. Knuth, "The Art of Computer Programming", vol. 2, 3rd ed. (1997), 4.2.2, theorem B
#[derive(Debug, Clone, Copy)]
pub struct IntervalSum {
    head: f64,
    tail: Interval,
}

impl IntervalSum {
    /// The sum of no terms.
    pub const ZERO: Self = Self { head: 0.0, tail: Interval::ZERO };

    /// Add a term.
    ///
    /// ```
    /// use intervals::{Interval, IntervalSum};
    /// let mut sum = IntervalSum::ZERO;
    /// sum.add(Interval::new(1.0, 2.0));
    /// assert!(sum.value().encloses(Interval::new(1.0, 2.0)));
    /// ```
    #[inline]
    pub fn add(&mut self, term: Interval) {
        let (head, error) = two_sum(self.head, term.lo());
        self.head = head;
        self.tail = self.tail + Interval::point(error) + Interval::new(0.0, term.width());
    }

    /// What all the terms add up to.
    ///
    /// ```
    /// assert!(intervals::IntervalSum::ZERO.value().contains(0.0));
    /// ```
    #[must_use]
    pub fn value(&self) -> Interval {
        Interval::point(self.head) + self.tail
    }
}
