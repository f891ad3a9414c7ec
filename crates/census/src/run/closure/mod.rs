//! The closure of one pattern of tension and compression: Φ(p) = Σ sᵢ lᵢ Fᵢ/|Fᵢ| − D.

pub(crate) mod bar;

use numerics::Interval;

use crate::run::closure::bar::BarTerm;
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::system::System;

/// A pattern of tension (+1) and compression (−1): bit n−1−i set means that bar i, counted from 0,
/// is compressed. Sorted as numbers, patterns that agree on their first bars stand together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Pattern(pub(crate) u32);

impl Pattern {
    pub(crate) fn bit(bars: usize, bar: usize) -> u32 {
        1 << (bars - 1 - bar)
    }

    pub(crate) fn sign(self, bars: usize, bar: usize) -> i8 {
        if self.0 & Self::bit(bars, bar) == 0 { 1 } else { -1 }
    }

    pub(crate) fn signs(self, bars: usize) -> impl Iterator<Item = i8> {
        (0..bars).map(move |bar| self.sign(bars, bar))
    }
}

pub(crate) fn signed(sign: i8, x: Interval) -> Interval {
    if sign < 0 { -x } else { x }
}

/// The derivative of Φ over a cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Closure {
    pub(crate) slope: [[Interval; 2]; 2],
}

impl Closure {
    /// The derivative of Φ over a cell, natural extension; `None` where a force vanishes.
    pub(crate) fn over(system: &System, signs: &[i8], cell: &Cell) -> Option<Self> {
        let mut slope = [[Interval::ZERO; 2]; 2];
        for ((sign, length), weight) in
            signs.iter().zip(&system.length).zip(system.weights(cell.face))
        {
            let term = BarTerm::over(cell, *length, *weight)?;
            for (sum, part) in slope.iter_mut().flatten().zip(term.slope.as_flattened()) {
                *sum = *sum + signed(*sign, *part);
            }
        }
        Some(Self { slope })
    }

    /// Φ and its derivative at a point in plain numbers, Φ first: no proof rests on it.
    pub(crate) fn plain(
        system: &System,
        signs: &[i8],
        face: Face,
        at: [f64; 2],
    ) -> ([f64; 2], [[f64; 2]; 2]) {
        let mut sum = system.span.map(|part| [-part.mid(), 0.0, 0.0]);
        let bars = signs.iter().zip(&system.length).zip(system.weights(face));
        for ((sign, length), weight) in bars {
            let term = BarTerm::plain(face, at, f64::from(*sign) * length.mid(), weight.mid());
            for (sum, term) in sum.iter_mut().flatten().zip(term.as_flattened()) {
                *sum += term;
            }
        }
        (sum.map(|[value, _, _]| value), sum.map(|[_, x, y]| [x, y]))
    }

    /// Φ alone.
    pub(crate) fn gap_over(system: &System, signs: &[i8], cell: &Cell) -> [Interval; 2] {
        let mut gap = system.span.map(|part| -part);
        for ((sign, length), weight) in
            signs.iter().zip(&system.length).zip(system.weights(cell.face))
        {
            let value = BarTerm::value_over(cell, *length, *weight);
            for k in 0..2 {
                gap[k] = gap[k] + signed(*sign, value[k]);
            }
        }
        gap
    }
}
