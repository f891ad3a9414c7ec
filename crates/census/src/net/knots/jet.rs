//! Values with their derivatives over a box: forward differentiation in intervals.

use std::array::from_fn;
use std::ops::{Add, Mul, Neg, Sub};

use numerics::Interval;

use crate::boxes::arithmetic::{difference, product, sum};

/// The range of a function of N coordinates over a box, and those of its partial derivatives.
///
/// Zeros are kept exact: most functions depend on few of the coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet<const N: usize> {
    pub(super) value: Interval,
    pub(super) slope: [Interval; N],
}

impl<const N: usize> Jet<N> {
    pub(super) const ZERO: Self = Self { value: Interval::ZERO, slope: [Interval::ZERO; N] };

    pub(super) fn constant(value: Interval) -> Self {
        Self { value, slope: [Interval::ZERO; N] }
    }

    /// The coordinate k.
    pub(super) fn coordinate(value: Interval, k: usize) -> Self {
        Self { value, slope: from_fn(|j| if j == k { Interval::ONE } else { Interval::ZERO }) }
    }

    /// The chain rule for a function of one variable.
    fn composed(self, value: Interval, slope: Interval) -> Self {
        Self { value, slope: self.slope.map(|part| product(part, slope)) }
    }

    pub(super) fn square(self) -> Self {
        self.composed(self.value.square(), self.value.scale(2.0))
    }

    /// Of what is positive.
    pub(super) fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.composed(root, Interval::ONE / root.scale(2.0))
    }

    /// Of what is not zero.
    pub(super) fn inverse(self) -> Self {
        let inverse = Interval::ONE / self.value;
        self.composed(inverse, -inverse.square())
    }

    pub(super) fn times(self, factor: Interval) -> Self {
        self.composed(product(self.value, factor), factor)
    }
}

impl<const N: usize> Add for Jet<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: sum(self.value, other.value),
            slope: from_fn(|k| sum(self.slope[k], other.slope[k])),
        }
    }
}

impl<const N: usize> Sub for Jet<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            value: difference(self.value, other.value),
            slope: from_fn(|k| sum(self.slope[k], -other.slope[k])),
        }
    }
}

impl<const N: usize> Neg for Jet<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: self.slope.map(|part| -part) }
    }
}

impl<const N: usize> Mul for Jet<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: product(self.value, other.value),
            slope: from_fn(|k| {
                sum(product(self.slope[k], other.value), product(self.value, other.slope[k]))
            }),
        }
    }
}

/// Three components.
pub(super) type Jets<const N: usize> = [Jet<N>; 3];

pub(super) fn squared<const N: usize>(a: Jets<N>) -> Jet<N> {
    a.into_iter().map(Jet::square).fold(Jet::ZERO, Add::add)
}

/// `f · a` with a constant f.
pub(super) fn along<const N: usize>(f: [Interval; 3], a: Jets<N>) -> Jet<N> {
    (0..3).map(|k| a[k].times(f[k])).fold(Jet::ZERO, Add::add)
}

/// `a × f` with a constant f.
pub(super) fn across<const N: usize>(a: Jets<N>, f: [Interval; 3]) -> Jets<N> {
    from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i].times(f[j]) - a[j].times(f[i])
    })
}

pub(super) fn values<const N: usize>(a: Jets<N>) -> [Interval; 3] {
    a.map(|part| part.value)
}
