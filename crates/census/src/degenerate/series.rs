//! Taylor series in two variables over a box, cut off at an order.
//!
//! Coefficient (i, j) is an enclosure of $\partial_x^i \partial_y^j f / (i!\\,j!)$ over the whole box.
//! The recurrences of products, quotients and roots of series hold at each point, and so for the
//! ranges: R. E. Moore, R. B. Kearfott, M. J. Cloud, "Introduction to Interval Analysis" (2009),
//! chapter 9, doi:10.1137/1.9780898717716.

use std::ops::{Add, Mul, Neg, Sub};

use numerics::Interval;

/// Derivatives up to this order.
pub(crate) const ORDER: usize = 5;

/// A function with its derivatives over a box.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Series([[Interval; ORDER + 1]; ORDER + 1]);

/// All pairs of exponents, by total degree.
fn exponents() -> impl Iterator<Item = (usize, usize)> {
    (0..=ORDER).flat_map(|degree| (0..=degree).map(move |j| (degree - j, j)))
}

impl Series {
    const ZERO: Self = Self([[Interval::ZERO; ORDER + 1]; ORDER + 1]);

    /// A constant.
    pub(crate) fn constant(value: Interval) -> Self {
        let mut series = Self::ZERO;
        series.0[0][0] = value;
        series
    }

    /// The first (0) or second (1) variable.
    pub(crate) fn variable(value: Interval, which: usize) -> Self {
        let mut series = Self::constant(value);
        series.0[1 - which][which] = Interval::ONE;
        series
    }

    /// The range.
    pub(crate) fn value(&self) -> Interval {
        self.0[0][0]
    }

    /// The ranges of both first derivatives.
    pub(crate) fn gradient(&self) -> [Interval; 2] {
        [self.0[1][0], self.0[0][1]]
    }

    /// The derivative by a variable; its last order is lost.
    pub(crate) fn derivative(&self, which: usize) -> Self {
        let mut derivative = Self::ZERO;
        for (i, j) in exponents().filter(|(i, j)| i + j < ORDER) {
            let (power, from) =
                if which == 0 { (i + 1, self.0[i + 1][j]) } else { (j + 1, self.0[i][j + 1]) };
            derivative.0[i][j] = times(Interval::point(power as f64), from);
        }
        derivative
    }

    /// Times a number.
    pub(crate) fn scaled(&self, factor: Interval) -> Self {
        Self(self.0.map(|row| row.map(|part| times(part, factor))))
    }

    /// Of what is positive; `None` if that is not known.
    pub(crate) fn sqrt(&self) -> Option<Self> {
        if self.value().lo() <= 0.0 {
            return None;
        }
        let mut root = Self::constant(self.value().sqrt());
        let twice = root.value().scale(2.0);
        for (i, j) in exponents().skip(1) {
            let known = inner(i, j).filter(|at| *at != (i, j));
            let sum = known.map(|(k, l)| times(root.0[k][l], root.0[i - k][j - l]));
            root.0[i][j] = less(self.0[i][j], sum.fold(Interval::ZERO, plus)) / twice;
        }
        Some(root)
    }

    /// One over what is not zero; `None` if that is not known.
    pub(crate) fn inverse(&self) -> Option<Self> {
        if self.value().contains(0.0) {
            return None;
        }
        let mut inverse = Self::constant(Interval::ONE / self.value());
        for (i, j) in exponents().skip(1) {
            let sum = inner(i, j).map(|(k, l)| times(self.0[k][l], inverse.0[i - k][j - l]));
            inverse.0[i][j] = -(sum.fold(Interval::ZERO, plus) / self.value());
        }
        Some(inverse)
    }
}

/// The exponents that divide (i, j), but for (0, 0).
fn inner(i: usize, j: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=i).flat_map(move |k| (0..=j).map(move |l| (k, l))).skip(1)
}

/// Zeros stay exact.
fn times(a: Interval, b: Interval) -> Interval {
    if a == Interval::ZERO || b == Interval::ZERO { Interval::ZERO } else { a * b }
}

fn plus(a: Interval, b: Interval) -> Interval {
    match (a == Interval::ZERO, b == Interval::ZERO) {
        (true, _) => b,
        (_, true) => a,
        _ => a + b,
    }
}

fn less(a: Interval, b: Interval) -> Interval {
    plus(a, -b)
}

impl Add for Series {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        for (i, j) in exponents() {
            self.0[i][j] = plus(self.0[i][j], other.0[i][j]);
        }
        self
    }
}

impl Neg for Series {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|row| row.map(|part| -part)))
    }
}

impl Sub for Series {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Series {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let mut product = Self::ZERO;
        for (i, j) in exponents() {
            let terms = inner(i, j).map(|(k, l)| times(self.0[k][l], other.0[i - k][j - l]));
            let first = times(self.0[0][0], other.0[i][j]);
            product.0[i][j] = terms.fold(first, plus);
        }
        product
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1/√(1 + x + 2y) = Σ C(−1/2, m) (x + 2y)^m, and its derivative is a series as well.
    #[test]
    fn a_known_series() {
        let [x, y] = [0, 1].map(|which| Series::variable(Interval::ZERO, which));
        let two = Series::constant(Interval::point(2.0));
        let f = (Series::constant(Interval::ONE) + x + two * y).sqrt().unwrap().inverse().unwrap();
        let binomial = [1.0, -0.5, 0.375, -0.3125, 0.273_437_5, -0.246_093_75];
        let choose =
            |m: usize, j: usize| (0..j).fold(1.0, |c, k| c * (m - k) as f64 / (k + 1) as f64);
        for (i, j) in exponents() {
            let m = i + j;
            let expected = binomial[m] * choose(m, j) * 2_f64.powi(i32::try_from(j).unwrap());
            assert!((f.0[i][j].mid() - expected).abs() < 1e-13, "{i} {j} {:?}", f.0[i][j]);
            assert!(f.0[i][j].contains(expected));
        }
        let by_y = f.derivative(1);
        for (i, j) in exponents().filter(|(i, j)| i + j < ORDER) {
            let expected = (j + 1) as f64 * f.0[i][j + 1].mid();
            assert!((by_y.0[i][j].mid() - expected).abs() < 1e-12);
        }
        // f² (1 + x + 2y) = 1.
        let one = f * f * (Series::constant(Interval::ONE) + x + two * y);
        for (i, j) in exponents().skip(1) {
            assert!(
                one.0[i][j].contains(0.0) && one.0[i][j].mag() < 1e-11,
                "{i} {j} {:?}",
                one.0[i][j]
            );
        }
    }

    #[test]
    fn ranges_hold_the_derivatives_at_points() {
        let over = Interval::new(0.1, 0.2);
        let function = |x: Interval, y: Interval| {
            let [x, y] = [Series::variable(x, 0), Series::variable(y, 1)];
            (x * x + y * y).sqrt().unwrap()
        };
        let (all, at) = (function(over, over), Interval::point(0.15));
        let point = function(at, Interval::point(0.125));
        for (i, j) in exponents() {
            assert!(all.0[i][j].encloses(point.0[i][j]), "{i} {j}");
        }
    }
}
