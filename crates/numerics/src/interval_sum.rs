//! Sums of many intervals whose rounding errors do not pile up.

use crate::interval::Interval;
use crate::rounding::two_sum;

/// A running sum: the error of each addition is computed exactly (Knuth's two-sum) and summed in an
/// interval of its own, so that the result is as narrow as its terms, up to about one rounding of
/// the result, however many there are.
///
/// ```
/// use numerics::{Interval, IntervalSum};
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
    /// use numerics::{Interval, IntervalSum};
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
    /// assert!(numerics::IntervalSum::ZERO.value().contains(0.0));
    /// ```
    pub fn value(&self) -> Interval {
        Interval::point(self.head) + self.tail
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum is as wide as its terms together, whichever end of each is taken.
    #[test]
    fn widths_add_up() {
        let mut sum = IntervalSum::ZERO;
        let (mut lo, mut hi) = (0.0, 0.0);
        // Sums of sixteenths are exact.
        for k in 0..1000_i32 {
            let at = f64::from(k * k % 97 - 48) / 16.0;
            let term = Interval::new(at, at + f64::from(k % 5) / 4.0);
            sum.add(term);
            (lo, hi) = (lo + term.lo(), hi + term.hi());
        }
        let value = sum.value();
        assert!(value.encloses(Interval::new(lo, hi)), "{value:?} does not enclose {lo} to {hi}");
        assert!(value.width() <= (hi - lo) * (1.0 + 1e-12), "{value:?} beside {lo} to {hi}");
    }
}
