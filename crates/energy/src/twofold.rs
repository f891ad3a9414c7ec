//! Numbers to twice the digits of a double, as sums of two doubles.
//!
//! T. J. Dekker, Numer. Math. 18 (1971) 224-242, doi:10.1007/BF01397083

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A sum of two doubles, the second at most half a unit in the last place of the first. Sums,
/// products and quotients err by a few units in the 104th binary digit.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Twofold {
    high: f64,
    low: f64,
}

impl Twofold {
    /// The sum of any two doubles, exactly.
    pub(crate) fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let back = high - a;
        Self { high, low: (a - (high - back)) + (b - back) }
    }

    /// The double nearest to it.
    pub(crate) fn value(self) -> f64 {
        self.high
    }

    /// The double nearest to it, and the rest.
    pub(crate) fn parts(self) -> [f64; 2] {
        [self.high, self.low]
    }

    /// The square root; zero of what is negative.
    pub(crate) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::default();
        }
        // One step of Newton's method doubles the digits.
        let root = Self::from(self.high.sqrt());
        root + (self - root * root) / Self::from(2.0 * root.high)
    }
}

impl From<f64> for Twofold {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for Twofold {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let first = Self::sum(high.high, high.low + low.high);
        Self::sum(first.high, first.low + low.low)
    }
}

impl Neg for Twofold {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Twofold {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let rest = self.high.mul_add(other.high, -high);
        Self::sum(high, rest + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Twofold {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = Self::from(self.high / other.high);
        let rest = self - first * other;
        let second = Self::from(rest.high / other.high);
        let rest = rest - second * other;
        first + second + Self::from(rest.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As whole numbers of 2^-100.
    fn units(x: Twofold) -> i128 {
        let part = |x: f64| {
            let scaled = x * 2.0_f64.powi(100);
            assert!(scaled.fract().abs() <= 0.0 && scaled.abs() < 2.0_f64.powi(120));
            #[expect(clippy::cast_possible_truncation, reason = "a whole number in range")]
            let whole = scaled as i128;
            whole
        };
        part(x.high) + part(x.low)
    }

    #[test]
    fn sums_and_products_of_fifty_digits_are_exact() {
        let part = |k: i64| k as f64 * 2.0_f64.powi(-50);
        let numbers = [659_706_976_665_121, -879_609_302_221_003, 1_099_511_627_775_007, 3];
        for a in numbers {
            for b in numbers {
                let [x, y] = [a, b].map(|k| Twofold::from(part(k)));
                assert_eq!(units(x * y), i128::from(a) * i128::from(b));
                let shifted = i128::from(a) + (i128::from(b) << 20);
                let far = Twofold::from(part(b) * 2.0_f64.powi(20));
                assert_eq!(units(x + far), shifted << 50);
                assert_eq!(units(far - -x), shifted << 50);
            }
        }
    }

    /// The square root of two and a third to 32 digits (OEIS A002193).
    #[test]
    fn roots_and_quotients_have_twice_the_digits() {
        let root = Twofold::from(2.0).sqrt();
        assert_eq!(root.high.to_bits(), std::f64::consts::SQRT_2.to_bits());
        assert!((root.low + 9.667_293_313_452_913e-17).abs() < 1e-31);
        let third = Twofold::from(1.0) / Twofold::from(3.0);
        let left = third * Twofold::from(3.0) - Twofold::from(1.0);
        assert!(left.value().abs() < 1e-31);
        // A third less its double is a third of 2^-54.
        assert!((third.low * 2.0_f64.powi(54) * 3.0 - 1.0).abs() < 1e-15);
        assert!(Twofold::from(-1.0).sqrt().value().abs() <= 0.0);
        let root = (root * root).sqrt();
        assert!((root - Twofold::from(2.0).sqrt()).value().abs() < 1e-31);
    }
}
