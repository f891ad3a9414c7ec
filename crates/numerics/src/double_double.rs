//! Numbers of about 32 digits with a proved error: unevaluated sums of two doubles
//! ("double-double").
//!
//! Where a result is ill-conditioned, its residual is evaluated with these numbers, so that the
//! enclosures of the result are as narrow as doubles allow.
//!
//! A number is `hi + lo ± error`. Sums and products of two doubles are split exactly into their
//! rounded value and the rounding error; what else is rounded is added to the error. Quotients and
//! roots are refined once and then judged by their exact residual.
//!
//! # References
//!
//! T. J. Dekker, Numer. Math. 18 (1971) 224-242, doi:10.1007/BF01397083; D. E. Knuth, "The Art of
//! Computer Programming", vol. 2, 4.2.2, Theorem B (sums)

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::interval::Interval;
use crate::rounding::{two_sum, up};

/// Half a unit in the last place, relative.
const U: f64 = f64::EPSILON / 2.0;

/// Relative allowance for the roundings in the error terms themselves.
const SLACK: f64 = 1.0 + 64.0 * f64::EPSILON;

/// More than what a product can lose to underflow.
const TINY: f64 = f64::MIN_POSITIVE;

/// A number `hi + lo`, off by at most `error`.
///
/// ```
/// use numerics::DoubleDouble;
/// // The doubles next to √2 are 2e-16 apart; its square as a double is off by 4e-16.
/// let two = DoubleDouble::point(2.0).sqrt().square() - DoubleDouble::point(2.0);
/// assert!(two.interval().mag() < 1e-28);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
    error: f64,
}

impl DoubleDouble {
    /// The number 0.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0, error: 0.0 };

    /// A double, exactly.
    ///
    /// ```
    /// use numerics::DoubleDouble;
    /// assert!(DoubleDouble::point(0.1).interval().contains(0.1));
    /// ```
    pub fn point(x: f64) -> Self {
        Self { hi: x, lo: 0.0, error: 0.0 }
    }

    /// `hi + lo ± error` with `lo` brought below the last place of `hi`, which is exact.
    fn normal(hi: f64, lo: f64, error: f64) -> Self {
        let (hi, lo) = two_sum(hi, lo);
        Self { hi, lo, error: error * SLACK }
    }

    /// Times a power of two; both parts must stay normal, else the loss goes into the error.
    ///
    /// ```
    /// use numerics::DoubleDouble;
    /// let quarter = DoubleDouble::point(1.0).scale(0.25);
    /// assert!(quarter.interval().contains(0.25));
    /// ```
    #[must_use]
    pub fn scale(self, power_of_two: f64) -> Self {
        Self {
            hi: self.hi * power_of_two,
            lo: self.lo * power_of_two,
            error: self.error * power_of_two * SLACK + TINY,
        }
    }

    /// An interval around it.
    ///
    /// ```
    /// use numerics::DoubleDouble;
    /// let third = (DoubleDouble::point(1.0) / DoubleDouble::point(3.0)).interval();
    /// assert!(third.contains(1.0 / 3.0) && third.width() < 2e-16);
    /// ```
    pub fn interval(self) -> Interval {
        Interval::point(self.hi) + Interval::around(self.lo, self.error)
    }

    /// A bound on the absolute value.
    fn mag(self) -> f64 {
        up(self.hi.abs() + up(self.lo.abs() + self.error))
    }

    /// Its square.
    ///
    /// ```
    /// use numerics::DoubleDouble;
    /// assert!(DoubleDouble::point(1.5).square().interval().contains(2.25));
    /// ```
    #[must_use]
    pub fn square(self) -> Self {
        self * self
    }

    /// The square root of a positive number; an infinite error for any other.
    ///
    /// ```
    /// use numerics::DoubleDouble;
    /// assert!(DoubleDouble::point(2.25).sqrt().interval().contains(1.5));
    /// ```
    #[must_use]
    pub fn sqrt(self) -> Self {
        let first = self.hi.max(0.0).sqrt();
        let rest = self - Self::point(first).square();
        let second = rest.hi / (2.0 * first);
        let root = Self::normal(first, second, 0.0);
        // |√a − s| = |a − s²| / (√a + s) ≤ |a − s²| / s.
        let residual = (self - root.square()).mag();
        let error = if first > 0.0 { up(residual / first) * SLACK } else { f64::INFINITY };
        Self { error: if error.is_nan() { f64::INFINITY } else { error }, ..root }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo, error: self.error }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (sum, rest) = two_sum(self.hi, other.hi);
        let low = self.lo + other.lo;
        let all = rest + low;
        let error = self.error + other.error + U * (low.abs() + all.abs());
        Self::normal(sum, all, error * SLACK)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.hi * other.hi;
        // A fused operation is exact here but for underflow.
        let rest = self.hi.mul_add(other.hi, -product);
        let (a, b) = (self.hi * other.lo, self.lo * other.hi);
        let low = a + b;
        let all = rest + low;
        let rounded = U * (a.abs() + b.abs() + low.abs() + all.abs());
        let left_out = (self.lo * other.lo).abs();
        let carried = self.mag() * other.error + other.mag() * self.error;
        Self::normal(product, all, (rounded + left_out + carried) * SLACK + 4.0 * TINY)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - Self::point(first) * other;
        let quotient = Self::normal(first, rest.hi / other.hi, 0.0);
        // a/b − q = (a − q b)/b.
        let residual = (self - quotient * other).mag();
        let least = other.hi.abs() - up(other.lo.abs() + other.error);
        let error = if least > 0.0 { up(residual / least) * SLACK } else { f64::INFINITY };
        Self { error: if error.is_nan() { f64::INFINITY } else { error }, ..quotient }
    }
}

impl std::iter::Sum for DoubleDouble {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, |total, term| total + term)
    }
}

#[cfg(test)]
mod tests {
    use num_rational::BigRational;
    use num_traits::Signed;
    use proptest::prelude::*;

    use super::*;

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).expect("finite")
    }

    fn value(x: DoubleDouble) -> BigRational {
        exact(x.hi) + exact(x.lo)
    }

    /// Whether the exact value is within the error, and the error at the level of 2⁻⁹⁵.
    fn close(x: DoubleDouble, reference: &BigRational) -> bool {
        let error = exact(x.error);
        (value(x) - reference).abs() <= error
            && error <= reference.abs() * exact(2f64.powi(-95)) + exact(1e-290)
            && x.interval().width() <= 4.0 * f64::EPSILON * x.hi.abs() + 1e-290
    }

    /// Sums of two doubles of different size, exactly.
    fn pair() -> impl Strategy<Value = DoubleDouble> {
        (0.1..10.0f64, -1.0..1.0f64, any::<bool>()).prop_map(|(a, b, negative)| {
            let x = DoubleDouble::normal(a, b * 1e-17, 0.0);
            if negative { -x } else { x }
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn exact_rational_results_are_within_the_error(a in pair(), b in pair()) {
            let (x, y) = (value(a), value(b));
            prop_assert!(close(a * b, &(&x * &y)));
            prop_assert!(close(a / b, &(&x / &y)));
            prop_assert!(close(a.scale(0.25), &(&x * exact(0.25))));
            // A sum may cancel: its error is judged by the larger term.
            for (sum, reference) in [(a + b, &x + &y), (a - b, &x - &y)] {
                prop_assert!((value(sum) - reference).abs() <= exact(sum.error));
                prop_assert!(sum.error <= a.hi.abs().max(b.hi.abs()) * 2f64.powi(-95));
            }
            let root = (if a.hi < 0.0 { -a } else { a }).sqrt();
            let (low, high) = (value(root) - exact(root.error), value(root) + exact(root.error));
            prop_assert!(&low * &low <= x.abs() && x.abs() <= &high * &high);
            prop_assert!(root.error <= 2f64.powi(-95) * root.hi);
            prop_assert!(exact(root.interval().lo()) <= low && high <= exact(root.interval().hi()));
        }

        #[test]
        fn errors_are_carried(a in pair(), b in pair(), s in -1.0..1.0f64, t in -1.0..1.0f64) {
            // Any operand within the error gives a result within the error.
            let blur = |x: DoubleDouble| DoubleDouble { error: 1e-20, ..x };
            let (x, y) = (value(a) + exact(s) * exact(1e-20), value(b) + exact(t) * exact(1e-20));
            for (result, reference) in [
                (blur(a) + blur(b), &x + &y),
                (blur(a) * blur(b), &x * &y),
                (blur(a) / blur(b), &x / &y),
            ] {
                prop_assert!((value(result) - reference).abs() <= exact(result.error));
            }
        }
    }

    proptest! {
        /// With errors far above all roundings the bounds are all but exact: not a unit in the last
        /// place may be missing.
        #[test]
        fn large_errors_are_carried_to_the_last_place(a in pair(), b in pair(), part in 0.0..1.0f64) {
            let (e, f) = (part * 1e-3, 0.7 * part * 1e-3);
            let blur = |x: DoubleDouble, error| DoubleDouble { error, ..x };
            let sum = blur(a, e) + blur(b, f);
            prop_assert!(exact(sum.error) >= exact(e) + exact(f));
            prop_assert!(sum.error <= (e + f) * (1.0 + 1e-12) + 1e-30);
            let product = blur(a, e) * b;
            prop_assert!(exact(product.error) >= value(b).abs() * exact(e));
            prop_assert!(product.error <= b.hi.abs() * e * (1.0 + 1e-12) + 1e-30);
            for scale in [0.125, 4.0] {
                let scaled = blur(a, e).scale(scale);
                prop_assert!(exact(scaled.error) >= exact(e) * exact(scale));
                prop_assert!(scaled.error <= e * scale * (1.0 + 1e-12) + 1e-300);
            }
            // The quotient at either end of the numerator.
            let quotient = blur(a, e) / b;
            for end in [exact(e), -exact(e)] {
                let reference = (value(a) + end) / value(b);
                prop_assert!((value(quotient) - reference).abs() <= exact(quotient.error));
            }
            let interval = blur(a, e).interval();
            prop_assert!(exact(interval.hi()) >= value(a) + exact(e));
            prop_assert!(exact(interval.lo()) <= value(a) - exact(e));
        }
    }

    /// What is as small as doubles get is not lost: the error says so.
    #[test]
    fn underflow_is_in_the_error() {
        let small = DoubleDouble::point(3.0 * f64::from_bits(1));
        let quarter = small.scale(0.25);
        let off = (value(quarter) - value(small) / exact(4.0)).abs();
        assert!(off <= exact(quarter.error));
        let product = DoubleDouble::point(1e-170) * DoubleDouble::point(1.1e-170);
        let off = (value(product) - exact(1e-170) * exact(1.1e-170)).abs();
        assert!(off <= exact(product.error));
    }

    #[test]
    fn nothing_is_known_of_a_root_or_quotient_of_zero() {
        assert!(DoubleDouble::ZERO.sqrt().error.is_infinite());
        assert!((DoubleDouble::point(1.0) / DoubleDouble::ZERO).error.is_infinite());
    }
}
