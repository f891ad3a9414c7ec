//! Numbers with their rounding error: what makes a bound a proof.
//!
//! +, −, ×, ÷ and √ of IEEE 754 are correctly rounded, so the neighbours of a computed result
//! enclose the exact one. [`IntervalSum`] adds many terms without their errors piling up.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// All numbers from `lo` to `hi`. Whatever is not a number becomes the whole line: nothing is known,
/// and nothing can be proved with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

impl Interval {
    pub(crate) const ZERO: Self = Self { lo: 0.0, hi: 0.0 };
    const LINE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// A number that is exact as it stands.
    pub(crate) fn exact(x: f64) -> Self {
        Self::ordered(x, x)
    }

    fn ordered(lo: f64, hi: f64) -> Self {
        if lo <= hi { Self { lo, hi } } else { Self::LINE }
    }

    /// Around ends that are each off by one rounding at most.
    fn rounded(lo: f64, hi: f64) -> Self {
        Self::ordered(lo.next_down(), hi.next_up())
    }

    /// A number inside.
    #[cfg(any(test, feature = "cones"))]
    pub(crate) fn middle(self) -> f64 {
        0.5 * self.lo + 0.5 * self.hi
    }

    /// The square; never negative.
    pub(crate) fn square(self) -> Self {
        let (a, b) = (self.lo.abs(), self.hi.abs());
        let far = a.max(b);
        let near = if self.lo <= 0.0 && self.hi >= 0.0 { 0.0 } else { a.min(b) };
        Self::ordered((near * near).next_down().max(0.0), (far * far).next_up())
    }

    /// The square root of what is not negative.
    pub(crate) fn sqrt(self) -> Self {
        Self::ordered(
            self.lo.max(0.0).sqrt().next_down().max(0.0),
            self.hi.max(0.0).sqrt().next_up(),
        )
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::rounded(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let products =
            [self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi];
        // `min` and `max` would drop what is not a number.
        if products.iter().any(|p| p.is_nan()) {
            return Self::LINE;
        }
        Self::rounded(
            products.iter().copied().fold(f64::INFINITY, f64::min),
            products.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        )
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if !(other.lo > 0.0 || other.hi < 0.0) {
            return Self::LINE;
        }
        let quotients =
            [self.lo / other.lo, self.lo / other.hi, self.hi / other.lo, self.hi / other.hi];
        if quotients.iter().any(|q| q.is_nan()) {
            return Self::LINE;
        }
        Self::rounded(
            quotients.iter().copied().fold(f64::INFINITY, f64::min),
            quotients.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        )
    }
}

/// A running sum: the error of each addition is computed exactly (Knuth's two-sum) and summed in an
/// interval of its own, so that the result is as narrow as its terms, up to about one rounding of
/// the result, however many there are.
///
/// # References
///
/// D. E. Knuth, The Art of Computer Programming, vol. 2, 3rd ed., section 4.2.2, theorem B.
#[derive(Debug, Clone, Copy)]
pub(crate) struct IntervalSum {
    head: f64,
    tail: Interval,
}

impl IntervalSum {
    pub(crate) const ZERO: Self = Self { head: 0.0, tail: Interval::ZERO };

    pub(crate) fn add(&mut self, term: Interval) {
        let (a, b) = (self.head, term.lo);
        let sum = a + b;
        let of_a = sum - b;
        let of_b = sum - of_a;
        let error = (a - of_a) + (b - of_b);
        self.head = sum;
        let width = Interval::ordered(0.0, (term.hi - term.lo).next_up());
        self.tail = self.tail + Interval::exact(error) + width;
    }

    pub(crate) fn value(&self) -> Interval {
        Interval::exact(self.head) + self.tail
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Whether exact = p + e (an unevaluated pair) lies inside.
    fn holds(x: Interval, p: f64, e: f64) -> bool {
        let below = x.lo < p || (x.lo <= p && e >= 0.0);
        let above = x.hi > p || (x.hi >= p && e <= 0.0);
        below && above
    }

    /// The rounding error of a product and of a quotient is known exactly with a fused
    /// multiply-add: the enclosures hold it.
    #[test]
    fn operations_enclose_the_exact_result() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..100_000 {
            let a = rng.random_range(-2.0..2.0_f64) * 10.0_f64.powi(rng.random_range(-9..9));
            let b = rng.random_range(-2.0..2.0_f64) * 10.0_f64.powi(rng.random_range(-9..9));
            let (x, y) = (Interval::exact(a), Interval::exact(b));
            let p = a * b;
            assert!(holds(x * y, p, a.mul_add(b, -p)));
            let s = a + b;
            let of_a = s - b;
            assert!(holds(x + y, s, (a - of_a) + (b - (s - of_a))));
            let q = a / b;
            // a = q b + rest, so the exact quotient is q + rest / b.
            assert!(holds(x / y, q, -q.mul_add(b, -a) / b));
            assert!(holds(x.square(), a * a, a.mul_add(a, -(a * a))));
            let r = a.abs().sqrt();
            assert!(holds(Interval::exact(a.abs()).sqrt(), r, -r.mul_add(r, -a.abs())));
        }
    }

    #[test]
    fn what_is_not_a_number_proves_nothing() {
        let one = Interval::exact(1.0);
        let nan = Interval::exact(f64::NAN);
        let infinite = Interval::exact(f64::INFINITY);
        for x in [
            nan,
            nan + one,
            infinite - infinite,
            infinite * Interval::ZERO,
            one / Interval::ZERO,
            infinite / infinite,
            nan.square(),
            nan.sqrt(),
        ] {
            assert!(x.lo <= 0.0 && x.hi >= f64::MAX, "{x:?}");
        }
    }

    /// A million terms that nearly cancel: the enclosure holds the exact sum and is narrow.
    #[test]
    fn sum_is_tight_for_a_million_terms() {
        let mut sum = IntervalSum::ZERO;
        let n = 1_000_000;
        for k in 0..n {
            sum.add(Interval::exact(0.1));
            sum.add(Interval::exact(if k % 2 == 0 { 1e9 } else { -1e9 }));
        }
        // The double nearest 0.1 is 0.1 + 5.551115123125783e-18 (its 54-bit tail).
        let exact = 1e5 + 5.551_115_123_125_783e-12;
        let value = sum.value();
        assert!(value.lo <= exact && exact <= value.hi, "{value:?}");
        assert!(value.hi - value.lo < 1e-10, "{value:?}");
    }
}
