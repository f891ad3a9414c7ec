//! Sums that do not drift with the number of bars, and differences that keep their digits.

/// Bars summed plainly in one go. A plain sum of 256 terms errs by at most 256 roundings of a block
/// that is 1/(n/256) of the whole: beside the total that is one rounding, whatever n is.
pub(crate) const BLOCK: usize = 256;

/// A number as the unevaluated sum of two doubles, some 32 digits.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct DoubleDouble {
    /// The nearest double.
    pub high: f64,
    /// What it leaves.
    pub low: f64,
}

impl DoubleDouble {
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let shadow = high - a;
        Self { high, low: (a - (high - shadow)) + (b - shadow) }
    }

    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    #[must_use]
    pub fn plus(self, b: f64) -> Self {
        let sum = Self::sum(self.high, b);
        Self::sum(sum.high, sum.low + self.low)
    }

    #[must_use]
    pub fn add(self, other: Self) -> Self {
        self.plus(other.high).plus(other.low)
    }

    #[must_use]
    pub fn negate(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }

    #[must_use]
    pub fn square(self) -> Self {
        Self::product(self.high, self.high).plus(2.0 * self.high * self.low)
    }

    /// The product, to a few units in its 104th binary digit, like the two below.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self::product(self.high, other.high).plus(self.high * other.low + self.low * other.high)
    }

    /// The quotient.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        let first = Self { high: self.high / other.high, low: 0.0 };
        let left = self.add(other.times(first).negate());
        let second = Self { high: left.high / other.high, low: 0.0 };
        let left = left.add(other.times(second).negate());
        first.add(second).plus(left.high / other.high)
    }

    /// The square root; zero of what is negative.
    #[must_use]
    pub fn root(self) -> Self {
        if self.high <= 0.0 {
            return Self::default();
        }
        let near = Self { high: self.high.sqrt(), low: 0.0 };
        let left = self.add(near.square().negate());
        near.plus(left.value() / (2.0 * near.high))
    }

    /// The half.
    #[must_use]
    pub fn half(self) -> Self {
        Self { high: 0.5 * self.high, low: 0.5 * self.low }
    }

    pub fn value(self) -> f64 {
        self.high + self.low
    }

    /// Sum of many terms.
    pub fn total(terms: impl Iterator<Item = f64>) -> Self {
        terms.fold(Self::default(), Self::plus)
    }
}

/// Running sums of `terms`, in place; returns the last.
///
/// Four at a time, so that the chain of dependent additions is a quarter as long.
#[inline]
pub(super) fn running(terms: &mut [f64]) -> f64 {
    let mut carry = 0.0;
    let (fours, rest) = terms.as_chunks_mut::<4>();
    for four in fours {
        let second = four[0] + four[1];
        let third = second + four[2];
        let fourth = second + (four[2] + four[3]);
        *four = [carry + four[0], carry + second, carry + third, carry + fourth];
        carry += fourth;
    }
    for term in rest {
        carry += *term;
        *term = carry;
    }
    carry
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn double_double_keeps_what_a_double_loses() {
        let tiny = f64::EPSILON / 8.0;
        let sum = DoubleDouble::total([1.0, tiny, -1.0].into_iter());
        assert!((sum.value() - tiny).abs() <= f64::EPSILON * tiny);
        // (1 + e)^2 - 1 - 2e = e^2.
        let square = DoubleDouble::sum(1.0, tiny).square().plus(-1.0).plus(-2.0 * tiny);
        assert!(square.value().abs() <= 2.0 * tiny * tiny);
        assert!((DoubleDouble::product(0.1, 0.1).value() - 0.1 * 0.1).abs() <= f64::EPSILON * 0.01);
    }

    /// The square root of two to 32 digits (OEIS A002193), and a third.
    #[test]
    fn roots_and_quotients_to_twice_the_digits() {
        let of = |high: f64| DoubleDouble { high, low: 0.0 };
        let root = of(2.0).root();
        assert_eq!(root.high.to_bits(), std::f64::consts::SQRT_2.to_bits());
        assert!((root.low + 9.667_293_313_452_913e-17).abs() < 1e-31);
        assert!(root.times(root).plus(-2.0).value().abs() < 1e-31);
        let third = of(1.0).over(of(3.0));
        // A third less its double is a third of 2^-54.
        assert!((third.low * 2.0_f64.powi(54) * 3.0 - 1.0).abs() < 1e-15);
        let sixth = third.half();
        assert!(root.times(sixth).over(root).add(sixth.negate()).value().abs() < 1e-32);
        assert!(of(-1.0).root().value().abs() <= 0.0);
    }

    #[test]
    fn running_sums_of_integers_are_exact() {
        for n in 0..20 {
            let mut terms: Vec<f64> = (1..=n).map(f64::from).collect();
            let last = running(&mut terms);
            for (k, term) in (1..=n).zip(&terms) {
                assert!((term - f64::from(k * (k + 1) / 2)).abs() < 0.5);
            }
            assert!((last - f64::from(n * (n + 1) / 2)).abs() < 0.5);
        }
    }
}
