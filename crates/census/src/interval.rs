//! Interval arithmetic: sets of real numbers that are certain to contain the result.
//!
//! # Why it is rigorous
//!
//! IEEE 754 rounds +, −, ×, ÷ and √ correctly: the computed value is a neighbour of the exact one, so
//! the next double below and the next double above it enclose the exact result. Stepping to the next
//! double is done without branches by the formula of Rump, Zimmermann, Boldo and Melquiond: with
//! `u` = 2⁻⁵³, `φ = u(1 + 2u)` and the smallest subnormal number `η`,
//!
//! $$ \mathrm{fl}(x - \mathrm{fl}(\varphi |x| + \eta)) \le \mathrm{pred}(x), \qquad
//!    \mathrm{succ}(x) \le \mathrm{fl}(x + \mathrm{fl}(\varphi |x| + \eta)) $$
//!
//! for every finite `x`, subnormal numbers included. Overflow gives an infinite end, which is still
//! an enclosure; whatever is not a number becomes the whole line, with which nothing can be proved.
//! No rounding mode is set, no fused operation and no function of the system's libm is used, so the
//! ends are the same bits on every processor.
//!
//! # References
//!
//! - S. M. Rump, P. Zimmermann, S. Boldo, G. Melquiond, "Computing predecessor and successor in
//!   rounding to nearest", BIT 49 (2009) 419-431, doi:10.1007/s10543-009-0218-z
//! - R. E. Moore, R. B. Kearfott, M. J. Cloud, "Introduction to Interval Analysis" (2009),
//!   doi:10.1137/1.9780898717716

use std::ops::{Add, Div, Mul, Neg, Sub};

use serde::{Deserialize, Serialize};

/// `u(1 + 2u)` with `u = 2⁻⁵³`: the successor of `u`.
const PHI: f64 = f64::EPSILON / 2.0 * (1.0 + f64::EPSILON);

/// The smallest subnormal number, 2⁻¹⁰⁷⁴.
const ETA: f64 = f64::from_bits(1);

/// At or above the double after `x`.
pub(crate) fn up(x: f64) -> f64 {
    x + (PHI * x.abs() + ETA)
}

/// At or below the double before `x`.
pub(crate) fn down(x: f64) -> f64 {
    x - (PHI * x.abs() + ETA)
}

/// All real numbers from `lo` to `hi`, both included.
///
/// ```
/// use census::Interval;
/// let third = Interval::ONE / Interval::point(3.0);
/// assert!(third.lo() < third.hi() && third.width() < 2e-16);
/// let one = third * Interval::point(3.0);
/// assert!(one.contains(1.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

impl Interval {
    /// The number 0.
    pub const ZERO: Self = Self { lo: 0.0, hi: 0.0 };
    /// The number 1.
    pub const ONE: Self = Self { lo: 1.0, hi: 1.0 };
    /// The whole line: nothing is known.
    pub const LINE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// The negative numbers.
    pub(crate) const fn negated(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }

    /// All numbers from `lo` to `hi`; the whole line if `lo <= hi` does not hold.
    #[must_use]
    pub fn new(lo: f64, hi: f64) -> Self {
        if lo <= hi { Self { lo, hi } } else { Self::LINE }
    }

    /// From ends that are in order, for constants.
    pub(crate) const fn ordered(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }

    /// A number that is exact as it stands.
    #[must_use]
    pub fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// All numbers within `radius` of `middle`, rounded outward.
    #[must_use]
    pub fn around(middle: f64, radius: f64) -> Self {
        Self::rounded(middle - radius, middle + radius)
    }

    /// Around ends that are each off by one rounding at most.
    fn rounded(lo: f64, hi: f64) -> Self {
        Self::new(down(lo), up(hi))
    }

    /// The lower end.
    #[must_use]
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// The upper end.
    #[must_use]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// A double inside, next to the middle.
    #[must_use]
    pub fn mid(self) -> f64 {
        // Halves of subnormal ends are rounded; the result must stay inside all the same.
        (0.5 * self.lo + 0.5 * self.hi).max(self.lo).min(self.hi)
    }

    /// At least the distance of [`mid`](Self::mid) to either end.
    #[must_use]
    pub fn rad(self) -> f64 {
        let middle = self.mid();
        up((self.hi - middle).max(middle - self.lo))
    }

    /// At least the distance of the ends.
    #[must_use]
    pub fn width(self) -> f64 {
        if self.lo < self.hi { up(self.hi - self.lo) } else { 0.0 }
    }

    /// The largest absolute value.
    #[must_use]
    pub fn mag(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// The smallest absolute value.
    #[must_use]
    pub fn mig(self) -> f64 {
        if self.contains(0.0) { 0.0 } else { self.lo.abs().min(self.hi.abs()) }
    }

    /// Whether `x` lies in it.
    #[must_use]
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// Whether all of `other` lies in it.
    #[must_use]
    pub fn encloses(self, other: Self) -> bool {
        self.lo <= other.lo && other.hi <= self.hi
    }

    /// Whether it lies in `other` without touching its ends.
    #[must_use]
    pub fn inside(self, other: Self) -> bool {
        other.lo < self.lo && self.hi < other.hi
    }

    /// Whether it has no number in common with `other`.
    #[must_use]
    pub fn misses(self, other: Self) -> bool {
        self.hi < other.lo || other.hi < self.lo
    }

    /// The sign of all its numbers, if they have the same: −1, 0 (the number 0 alone) or +1.
    ///
    /// ```
    /// use census::Interval;
    /// assert_eq!(Interval::new(1.0, 2.0).sign(), Some(1));
    /// assert_eq!(Interval::new(-1.0, 2.0).sign(), None);
    /// assert_eq!(Interval::ZERO.sign(), Some(0));
    /// ```
    #[must_use]
    pub fn sign(self) -> Option<i8> {
        if self.lo > 0.0 {
            Some(1)
        } else if self.hi < 0.0 {
            Some(-1)
        } else if self.lo >= 0.0 && self.hi <= 0.0 {
            Some(0)
        } else {
            None
        }
    }

    /// −1 or +1 according to the sign of all its numbers; everything between if they differ.
    pub(crate) fn unit_sign(self) -> Self {
        match self.sign() {
            Some(1) => Self::ONE,
            Some(-1) => -Self::ONE,
            _ => Self { lo: -1.0, hi: 1.0 },
        }
    }

    /// The numbers that are in both, if any.
    #[must_use]
    pub fn intersect(self, other: Self) -> Option<Self> {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        (lo <= hi).then_some(Self { lo, hi })
    }

    /// The smallest interval around both.
    #[must_use]
    pub const fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The absolute values.
    #[must_use]
    pub fn abs(self) -> Self {
        Self { lo: self.mig(), hi: self.mag() }
    }

    /// The squares; never negative.
    #[must_use]
    pub fn square(self) -> Self {
        let (near, far) = (self.mig(), self.mag());
        Self::new(down(near * near).max(0.0), up(far * far))
    }

    /// The square roots of what is not negative.
    #[must_use]
    pub fn sqrt(self) -> Self {
        Self::new(down(self.lo.max(0.0).sqrt()).max(0.0), up(self.hi.max(0.0).sqrt()))
    }

    /// Times a power of two: exact unless the result is subnormal, which is rounded outward.
    #[must_use]
    pub fn scale(self, power_of_two: f64) -> Self {
        let end = |x: f64| x * power_of_two;
        let exact = |x: f64| x.abs() <= 0.0 || end(x).is_normal();
        Self::new(
            if exact(self.lo) { end(self.lo) } else { down(end(self.lo)) },
            if exact(self.hi) { end(self.hi) } else { up(end(self.hi)) },
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
        self.negated()
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let products =
            [self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi];
        // `min` and `max` pass over NaN, which 0 times infinity makes.
        if products.iter().any(|product| product.is_nan()) {
            return Self::LINE;
        }
        let [a, b, c, d] = products;
        Self::rounded(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::LINE;
        }
        let quotients =
            [self.lo / other.lo, self.lo / other.hi, self.hi / other.lo, self.hi / other.hi];
        if quotients.iter().any(|quotient| quotient.is_nan()) {
            return Self::LINE;
        }
        let [a, b, c, d] = quotients;
        Self::rounded(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

/// The sum of all terms, one after the other.
impl std::iter::Sum for Interval {
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

    fn holds(interval: Interval, value: &BigRational) -> bool {
        let below = interval.lo == f64::NEG_INFINITY || &exact(interval.lo) <= value;
        let above = interval.hi == f64::INFINITY || &exact(interval.hi) >= value;
        below && above
    }

    /// Finite doubles of every size and kind, subnormal ones and both zeros included.
    fn any_finite() -> impl Strategy<Value = f64> {
        prop_oneof![
            any::<f64>().prop_filter("finite", |x| x.is_finite()),
            -2.0..2.0f64,
            Just(0.0),
            Just(-0.0),
            Just(f64::MIN_POSITIVE),
            (0u64..64).prop_map(f64::from_bits),
        ]
    }

    fn any_interval() -> impl Strategy<Value = Interval> {
        (any_finite(), any_finite()).prop_map(|(a, b)| Interval::new(a.min(b), a.max(b)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn a_step_outward_reaches_the_neighbouring_double(x in any_finite()) {
            prop_assert!(up(x) >= x.next_up() && down(x) <= x.next_down());
            // And hardly more than that: at most two steps.
            if x.is_normal() && x.abs() < f64::MAX / 4.0 && x.abs() > 1e-290 {
                prop_assert!(up(x) <= x.next_up().next_up() && down(x) >= x.next_down().next_down());
            }
        }

        #[test]
        fn exact_rational_results_are_enclosed(a in any_interval(), b in any_interval(), t in 0.0..=1.0f64) {
            // Operands inside the intervals: the ends, and something in between.
            for (x, y) in [
                (a.lo, b.lo), (a.lo, b.hi), (a.hi, b.lo), (a.hi, b.hi),
                ((a.lo * (1.0 - t) + a.hi * t).clamp(a.lo, a.hi), (b.lo * t + b.hi * (1.0 - t)).clamp(b.lo, b.hi)),
            ] {
                let (ex, ey) = (exact(x), exact(y));
                prop_assert!(holds(a + b, &(&ex + &ey)), "{x:e} + {y:e}");
                prop_assert!(holds(a - b, &(&ex - &ey)), "{x:e} - {y:e}");
                prop_assert!(holds(a * b, &(&ex * &ey)), "{x:e} * {y:e}");
                prop_assert!(holds(a.square(), &(&ex * &ex)), "{x:e} squared");
                prop_assert!(holds(a.abs(), &ex.abs()));
                if y != 0.0 {
                    prop_assert!(holds(a / b, &(&ex / &ey)), "{x:e} / {y:e}");
                }
                if x >= 0.0 {
                    let root = a.sqrt();
                    prop_assert!(&exact(root.lo) * &exact(root.lo) <= ex);
                    prop_assert!(root.hi.is_infinite() || &exact(root.hi) * &exact(root.hi) >= ex);
                }
                prop_assert!(holds(a.scale(0.125), &(&ex * exact(0.125))));
            }
        }

        #[test]
        fn results_of_points_are_narrow(x in -1e100..1e100f64, y in 1e-3..1e3f64) {
            let (a, b) = (Interval::point(x), Interval::point(y));
            for wide in [a + b, a - b, a * b, a / b, b.sqrt()] {
                prop_assert!(wide.width() <= 5.0 * f64::EPSILON * wide.mag());
            }
        }

        #[test]
        fn the_middle_and_the_radius_cover_the_interval(a in any_interval()) {
            let (middle, radius) = (a.mid(), a.rad());
            prop_assert!(a.contains(middle));
            prop_assert!(exact(middle) - exact(a.lo) <= exact(radius) || radius.is_infinite());
            prop_assert!(radius.is_infinite() || exact(a.hi) - exact(middle) <= exact(radius));
            prop_assert!(Interval::around(middle, radius).encloses(a));
        }
    }

    #[test]
    fn nothing_is_proved_with_what_is_not_a_number() {
        assert_eq!(Interval::point(f64::NAN), Interval::LINE);
        assert_eq!(Interval::ONE / Interval::ZERO, Interval::LINE);
        assert_eq!(Interval::new(2.0, 1.0), Interval::LINE);
        assert_eq!(Interval::LINE * Interval::ZERO, Interval::LINE);
        assert!(!Interval::LINE.inside(Interval::LINE));
        assert_eq!(Interval::new(f64::MAX, f64::MAX) + Interval::point(f64::MAX), Interval::LINE);
        assert_eq!(Interval::LINE.sign(), None);
    }
}
