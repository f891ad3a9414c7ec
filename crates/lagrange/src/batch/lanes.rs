//! Several numbers side by side, and their sines and cosines.
//!
//! Plain arrays with loops of fixed length: the compiler turns them into vector instructions, of
//! whatever width the machine has. Every operation works entry by entry and is one that IEEE 754
//! rounds exactly (no library function, no fused product), so an entry depends neither on its
//! neighbours nor on the machine.
#![expect(
    clippy::inline_always,
    reason = "a pass over the bars is fast only as one loop of vector instructions"
)]

use std::f64::consts::FRAC_2_PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Seeds solved side by side: one register of 512 bits, two of 256, four of 128.
pub(crate) const LANES: usize = 8;

/// One number of each of the seeds.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Lanes(pub(crate) [f64; LANES]);

/// Lane by lane, from its place. Written out: `std::array::from_fn` goes through a function that
/// is not inlined across the parts of a build, and a loop stays in memory where little is optimised; either is several times slower.
#[inline(always)]
pub(crate) fn each<T>(entry: impl Fn(usize) -> T) -> [T; LANES] {
    let [a, b, c, d] = [entry(0), entry(1), entry(2), entry(3)];
    [a, b, c, d, entry(4), entry(5), entry(6), entry(7)]
}

macro_rules! entrywise {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(each(|k| self.0[k] $op other.0[k]))
            }
        }
    };
}
entrywise!(Add, add, +);
entrywise!(Sub, sub, -);
entrywise!(Mul, mul, *);
entrywise!(Div, div, /);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl Lanes {
    pub(crate) const ZERO: Self = Self::all(0.0);

    #[inline(always)]
    pub(crate) const fn all(x: f64) -> Self {
        Self([x; LANES])
    }

    #[inline(always)]
    pub(crate) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(each(|k| f(self.0[k])))
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// The larger of two numbers; the second if one of them is undefined.
    #[inline(always)]
    pub(crate) fn larger(self, other: Self) -> Self {
        Self(each(|k| if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] }))
    }

    /// `yes` where the condition holds, else `no`.
    #[inline(always)]
    pub(crate) fn select(condition: [bool; LANES], yes: Self, no: Self) -> Self {
        Self(each(|k| if condition[k] { yes.0[k] } else { no.0[k] }))
    }

    /// Where this is at most the other; nowhere where one is undefined.
    #[inline(always)]
    pub(crate) fn at_most(self, other: Self) -> [bool; LANES] {
        each(|k| self.0[k] <= other.0[k])
    }

    /// Sine and cosine, to about one unit in the last place of 1, for arguments up to
    /// [`LARGEST_ANGLE`].
    ///
    /// The nearest multiple of $\pi/2$ is taken off in three parts, the first two with so few
    /// digits that their products are exact (W. J. Cody and W. Waite, "Software Manual for the
    /// Elementary Functions", 1980); what remains is at most $\pi/4$, where Taylor's polynomials of
    /// degree 15 and 16 are exact to $5\cdot10^{-17}$.
    #[inline(always)]
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        let shifted = self * Self::all(FRAC_2_PI) + Self::all(ROUND);
        let turns = shifted - Self::all(ROUND);
        let rest = self - turns * Self::all(HALF_PI[0]);
        let rest = rest - turns * Self::all(HALF_PI[1]);
        let rest = rest - turns * Self::all(HALF_PI[2]);
        let square = rest * rest;
        let mut sin = Self::all(SIN[0]);
        for coefficient in &SIN[1..] {
            sin = sin * square + Self::all(*coefficient);
        }
        let sin = rest + rest * square * sin;
        let mut cos = Self::all(COS[0]);
        for coefficient in &COS[1..] {
            cos = cos * square + Self::all(*coefficient);
        }
        let cos = Self::all(1.0) - (square * Self::all(0.5) - square * square * cos);
        let mut out = (sin, cos);
        for k in 0..LANES {
            // The quadrant stands in the last two bits.
            let quadrant = shifted.0[k].to_bits();
            let swap = (quadrant & 1).wrapping_neg();
            let (s, c) = (sin.0[k].to_bits(), cos.0[k].to_bits());
            let exchange = (s ^ c) & swap;
            let sin_sign = (quadrant & 2) << 62;
            let cos_sign = (quadrant.wrapping_add(1) & 2) << 62;
            out.0.0[k] = f64::from_bits(s ^ exchange ^ sin_sign);
            out.1.0[k] = f64::from_bits(c ^ exchange ^ cos_sign);
        }
        out
    }
}

/// Largest argument of [`Lanes::sin_cos`], rad: the multiple of $\pi/2$ then has 20 bits.
pub(crate) const LARGEST_ANGLE: f64 = 1e6;

/// Adding 1.5 · 2⁵² leaves no room for a fraction: the sum is rounded to a whole number.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// $\pi/2$ as a sum: the first 33 bits, the next 33, and the rest.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    f64::from_bits(0x3BA3_198A_2E03_7073),
];

/// Coefficients of $(\sin x - x)/x^3$ in $x^2$, from the highest: $\pm 1/15!, \dots, -1/3!$.
const SIN: [f64; 7] = [
    -1.0 / 1_307_674_368_000.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 39_916_800.0,
    1.0 / 362_880.0,
    -1.0 / 5040.0,
    1.0 / 120.0,
    -1.0 / 6.0,
];

/// Coefficients of $(\cos x - 1 + x^2/2)/x^4$ in $x^2$, from the highest: $\pm 1/16!, \dots, 1/4!$.
const COS: [f64; 7] = [
    1.0 / 20_922_789_888_000.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 479_001_600.0,
    -1.0 / 3_628_800.0,
    1.0 / 40_320.0,
    -1.0 / 720.0,
    1.0 / 24.0,
];

#[cfg(test)]
mod tests {
    use super::{LANES, LARGEST_ANGLE, Lanes};

    #[test]
    fn sines_and_cosines_are_those_of_the_library() {
        for step in 0..100_000_u32 {
            // All sizes up to the largest, both signs.
            let x = (f64::from(step) - 5e4) / 5e4;
            let x = if step % 3 == 0 { x * LARGEST_ANGLE } else { x * 20.0 };
            let (sin, cos) = Lanes::all(x).sin_cos();
            // One rounding of a number below 1 in either of the two, and a little.
            assert!((sin.0[LANES - 1] - x.sin()).abs() <= 2.3e-16, "sin {x}");
            assert!((cos.0[0] - x.cos()).abs() <= 2.3e-16, "cos {x}");
        }
    }

    #[test]
    fn an_entry_does_not_depend_on_its_neighbours() {
        let mixed = Lanes([0.1, -2.0, 1e5, f64::NAN, 7.0, f64::INFINITY, 0.0, 3.0]);
        let (sin, cos) = mixed.sin_cos();
        for (k, x) in mixed.0.into_iter().enumerate().filter(|(_, x)| x.is_finite()) {
            let (s, c) = Lanes::all(x).sin_cos();
            assert_eq!(
                (sin.0[k].to_bits(), cos.0[k].to_bits()),
                (s.0[0].to_bits(), c.0[0].to_bits())
            );
        }
    }
}
