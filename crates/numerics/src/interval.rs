//! Interval arithmetic: sets of real numbers that are certain to contain the result.
//!
//! Every operation rounds its ends outward, by [`down`] and [`up`]. Overflow gives an infinite end,
//! which is still an enclosure; whatever is not a number becomes the whole line, with which nothing
//! can be proved.
//!
//! # References
//!
//! R. E. Moore, R. B. Kearfott, M. J. Cloud, "Introduction to Interval Analysis" (2009),
//! doi:10.1137/1.9780898717716

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::rounding::{down, up};

/// All real numbers from `lo` to `hi`, both included.
///
/// ```
/// use numerics::Interval;
/// let third = Interval::ONE / Interval::point(3.0);
/// assert!(third.lo() < third.hi() && third.width() < 2e-16);
/// let one = third * Interval::point(3.0);
/// assert!(one.contains(1.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(into = "[f64; 2]"))]
pub struct Interval {
    lo: f64,
    hi: f64,
}

impl From<Interval> for [f64; 2] {
    fn from(Interval { lo, hi }: Interval) -> Self {
        [lo, hi]
    }
}

impl Interval {
    /// The number 0.
    pub const ZERO: Self = Self { lo: 0.0, hi: 0.0 };
    /// The number 1.
    pub const ONE: Self = Self { lo: 1.0, hi: 1.0 };
    /// The whole line: nothing is known.
    pub const LINE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// The negatives of all its numbers; what the operator does, for constants.
    ///
    /// ```
    /// use numerics::Interval;
    /// const MINUS_ONE: Interval = Interval::ONE.negated();
    /// assert_eq!(MINUS_ONE, -Interval::ONE);
    /// ```
    #[must_use]
    pub const fn negated(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }

    /// All numbers from `lo` to `hi`; the whole line if `lo <= hi` does not hold.
    ///
    /// ```
    /// use numerics::Interval;
    /// let one_to_two = Interval::new(1.0, 2.0);
    /// assert!(one_to_two.contains(1.5));
    /// assert_eq!(Interval::new(2.0, 1.0), Interval::LINE);
    /// ```
    #[inline]
    pub fn new(lo: f64, hi: f64) -> Self {
        if lo <= hi { Self { lo, hi } } else { Self::LINE }
    }

    /// From ends that are in order, for constants.
    pub(crate) const fn ordered(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }

    /// A number that is exact as it stands.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert!(Interval::point(0.5).width() <= 0.0);
    /// ```
    #[inline]
    pub fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// All numbers within `radius` of `middle`, rounded outward.
    ///
    /// ```
    /// use numerics::Interval;
    /// let x = Interval::around(1.0, 0.25);
    /// assert!(x.lo() <= 0.75 && x.hi() >= 1.25);
    /// ```
    #[inline]
    pub fn around(middle: f64, radius: f64) -> Self {
        Self::rounded(middle - radius, middle + radius)
    }

    /// Around ends that are each off by one rounding at most.
    #[inline]
    fn rounded(lo: f64, hi: f64) -> Self {
        Self::new(down(lo), up(hi))
    }

    /// Around these numbers, each off by one rounding at most.
    #[inline]
    fn hull_of(numbers: [f64; 4]) -> Self {
        // `min` and `max` pass over NaN, which 0 times infinity makes.
        if numbers.iter().any(|number| number.is_nan()) {
            return Self::LINE;
        }
        let [a, b, c, d] = numbers;
        Self::rounded(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }

    /// The lower end.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(1.0, 2.0).lo(), 1.0);
    /// ```
    #[inline]
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// The upper end.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(1.0, 2.0).hi(), 2.0);
    /// ```
    #[inline]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// A double inside, next to the middle.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(1.0, 2.0).mid(), 1.5);
    /// ```
    #[inline]
    pub fn mid(self) -> f64 {
        // Halves of subnormal ends are rounded; the result must stay inside all the same.
        (0.5 * self.lo + 0.5 * self.hi).max(self.lo).min(self.hi)
    }

    /// At least the distance of [`mid`](Self::mid) to either end.
    ///
    /// ```
    /// use numerics::Interval;
    /// let radius = Interval::new(1.0, 2.0).rad();
    /// assert!((0.5..0.5000001).contains(&radius));
    /// ```
    #[inline]
    pub fn rad(self) -> f64 {
        let middle = self.mid();
        up((self.hi - middle).max(middle - self.lo))
    }

    /// At least the distance of the ends.
    ///
    /// ```
    /// use numerics::Interval;
    /// let width = Interval::new(1.0, 2.0).width();
    /// assert!((1.0..1.0000001).contains(&width));
    /// ```
    #[inline]
    pub fn width(self) -> f64 {
        if self.lo < self.hi { up(self.hi - self.lo) } else { 0.0 }
    }

    /// The largest absolute value.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(-3.0, 2.0).mag(), 3.0);
    /// ```
    #[inline]
    pub fn mag(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// The smallest absolute value.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(-3.0, -2.0).mig(), 2.0);
    /// assert_eq!(Interval::new(-3.0, 2.0).mig(), 0.0);
    /// ```
    #[inline]
    pub fn mig(self) -> f64 {
        if self.contains(0.0) { 0.0 } else { self.lo.abs().min(self.hi.abs()) }
    }

    /// Whether `x` lies in it.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert!(Interval::new(1.0, 2.0).contains(2.0));
    /// assert!(!Interval::LINE.contains(f64::NAN));
    /// ```
    #[inline]
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// Whether all of `other` lies in it.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert!(Interval::new(1.0, 2.0).encloses(Interval::point(2.0)));
    /// ```
    #[inline]
    pub fn encloses(self, other: Self) -> bool {
        self.lo <= other.lo && other.hi <= self.hi
    }

    /// Whether it lies in `other` without touching its ends.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert!(Interval::point(1.5).interior_to(Interval::new(1.0, 2.0)));
    /// assert!(!Interval::point(2.0).interior_to(Interval::new(1.0, 2.0)));
    /// ```
    #[inline]
    pub fn interior_to(self, other: Self) -> bool {
        other.lo < self.lo && self.hi < other.hi
    }

    /// Whether it has no number in common with `other`.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert!(Interval::new(1.0, 2.0).disjoint(Interval::new(3.0, 4.0)));
    /// assert!(!Interval::new(1.0, 2.0).disjoint(Interval::new(2.0, 4.0)));
    /// ```
    #[inline]
    pub fn disjoint(self, other: Self) -> bool {
        self.hi < other.lo || other.hi < self.lo
    }

    /// The sign of all its numbers, if they have the same: −1, 0 (the number 0 alone) or +1.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(1.0, 2.0).sign(), Some(1));
    /// assert_eq!(Interval::new(-1.0, 2.0).sign(), None);
    /// assert_eq!(Interval::ZERO.sign(), Some(0));
    /// ```
    #[inline]
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
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(-3.0, -2.0).unit_sign(), Interval::point(-1.0));
    /// assert_eq!(Interval::new(-3.0, 2.0).unit_sign(), Interval::new(-1.0, 1.0));
    /// ```
    #[must_use]
    #[inline]
    pub fn unit_sign(self) -> Self {
        match self.sign() {
            Some(1) => Self::ONE,
            Some(-1) => -Self::ONE,
            _ => Self { lo: -1.0, hi: 1.0 },
        }
    }

    /// The numbers that are in both, if any.
    ///
    /// ```
    /// use numerics::Interval;
    /// let common = Interval::new(1.0, 3.0).intersect(Interval::new(2.0, 4.0));
    /// assert_eq!(common, Some(Interval::new(2.0, 3.0)));
    /// ```
    #[must_use]
    #[inline]
    pub fn intersect(self, other: Self) -> Option<Self> {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        (lo <= hi).then_some(Self { lo, hi })
    }

    /// The smallest interval around both.
    ///
    /// ```
    /// use numerics::Interval;
    /// let around = Interval::point(1.0).hull(Interval::point(3.0));
    /// assert_eq!(around, Interval::new(1.0, 3.0));
    /// ```
    #[must_use]
    #[inline]
    pub const fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The absolute values.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(-3.0, 2.0).abs(), Interval::new(0.0, 3.0));
    /// ```
    #[must_use]
    #[inline]
    pub fn abs(self) -> Self {
        Self { lo: self.mig(), hi: self.mag() }
    }

    /// The squares; never negative.
    ///
    /// ```
    /// use numerics::Interval;
    /// let square = Interval::new(-3.0, 2.0).square();
    /// assert!(square.lo() >= 0.0 && square.contains(9.0) && square.hi() < 9.0000001);
    /// ```
    #[must_use]
    #[inline]
    pub fn square(self) -> Self {
        let (near, far) = (self.mig(), self.mag());
        Self::new(down(near * near).max(0.0), up(far * far))
    }

    /// The square roots of what is not negative.
    ///
    /// ```
    /// use numerics::Interval;
    /// let root = Interval::new(-1.0, 4.0).sqrt();
    /// assert!(root.lo() >= 0.0 && root.contains(2.0) && root.hi() < 2.0000001);
    /// ```
    #[must_use]
    #[inline]
    pub fn sqrt(self) -> Self {
        Self::new(down(self.lo.max(0.0).sqrt()).max(0.0), up(self.hi.max(0.0).sqrt()))
    }

    /// Times a number that is exact as it stands.
    ///
    /// ```
    /// use numerics::Interval;
    /// let x = Interval::new(1.0, 3.0).times(-0.5);
    /// assert!(x.encloses(Interval::new(-1.5, -0.5)) && x.width() < 1.0000001);
    /// ```
    #[must_use]
    #[inline]
    pub fn times(self, x: f64) -> Self {
        let [a, b] = [self.lo * x, self.hi * x];
        // What is not a number becomes the whole line.
        if x < 0.0 { Self::rounded(b, a) } else { Self::rounded(a, b) }
    }

    /// Times a power of two: exact unless the result is subnormal, which is rounded outward.
    ///
    /// ```
    /// use numerics::Interval;
    /// assert_eq!(Interval::new(1.0, 3.0).scale(0.5), Interval::new(0.5, 1.5));
    /// ```
    #[must_use]
    #[inline]
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
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::rounded(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.negated()
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let Self { lo, hi } = other;
        Self::hull_of([self.lo * lo, self.lo * hi, self.hi * lo, self.hi * hi])
    }
}

impl Div for Interval {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::LINE;
        }
        let Self { lo, hi } = other;
        Self::hull_of([self.lo / lo, self.lo / hi, self.hi / lo, self.hi / hi])
    }
}

/// The sum of all terms, one after the other.
impl std::iter::Sum for Interval {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, |total, term| total + term)
    }
}
