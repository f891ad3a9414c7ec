//! The lowest modes of a large system: Lanczos' method with shift and inversion.
//!
//! With `S` the solution operator of the shifted, constrained stiffness ([`Shifted`]), the operator
//! `S M` is symmetric in the metric of the inertia `M` and has the eigenvalues `1/(ω² − σ)`: with
//! the shift below all modes the lowest are the largest of these. Lanczos' method may
//! miss a mode of a multiple frequency; how many lie below a shift between two that are found is
//! told by Sylvester's law of inertia, and what is missing is looked for across those found.
//!
//! T. Ericsson, A. Ruhe, Math. Comp. 35 (1980) 1251-1268; R. G. Grimes, J. G. Lewis, H. D. Simon,
//! SIAM J. Matrix Anal. Appl. 15 (1994) 228-272.

use super::lanczos::{across, divide, dot, largest};
use super::planes::Sector;
use super::shifted::Shifted;
use super::solved::{Solved, ZERO};
use super::stiffness::{Entries, Stiffness};
use crate::error::{MotionError, Result};

/// Shift of the first attempt, in units of [`Stiffness::unit`]: below zero, where a mode may be.
const FIRST_SHIFT: f64 = -0.1;

/// Factor of the next shift where modes lie below one.
const LOWER: f64 = 4.0;

/// Shifts tried: from `g/L` to 10³⁰ times it.
const MOST_SHIFTS: usize = 50;

/// Modes beyond those asked for: between some of them there is a gap for the shift that counts.
const BEYOND: usize = 4;

/// Searches for modes that are missing, beside one for each mode asked for: as many as modes of
/// one frequency may need.
const MOST_SEARCHES: usize = 8;

/// Modes nearer to each other than this, relative, are of one frequency: no shift between them
/// counts.
const ONE_FREQUENCY: f64 = 1e-6;

/// Systems of fewer coordinates in a sector are solved by dense linear algebra: Lanczos' method
/// needs room.
pub(super) const LEAST_SIZE: usize = 160;

/// The lowest `count` modes of a sector.
pub(super) fn solve(stiffness: &Stiffness<'_>, sector: &Sector, count: usize) -> Result<Solved> {
    let entries = stiffness.entries(sector);
    let axes = sector.axes.len();
    let unit = stiffness.unit();
    let (shift, below_all) = below_all(&entries, axes, unit)?;
    let total = entries.size - below_all.independent;
    let count = count.min(total);
    let (entries, shifted, values, shapes) = (&entries, &below_all, Vec::new(), Vec::new());
    let mut search = Search { entries, shifted, unit: -shift, values, shapes };
    let mut missing = (count + BEYOND).min(total);
    for _ in 0..MOST_SEARCHES + count {
        search.add(missing);
        let mut pairs = search.pairs(stiffness, sector, shift);
        pairs.sort_by(|a, b| a.omega2.total_cmp(&b.omega2));
        let mut lacking = count.saturating_sub(pairs.len());
        if lacking == 0 {
            let (shift, expected) = counting_shift(&pairs, count, total, unit);
            let below = Shifted::new(entries, axes, shift).and_then(|shifted| shifted.below);
            let failed = MotionError::ModesUncounted { found: pairs.len(), asked: count };
            lacking = below.and_then(|below| below.checked_sub(expected)).ok_or(failed)?;
        }
        if lacking == 0 {
            pairs.truncate(count);
            let negative = negative(entries, axes, &pairs)?;
            return Ok(solved(pairs, total, negative));
        }
        missing = lacking;
    }
    Err(MotionError::ModesUncounted { found: search.shapes.len(), asked: count })
}

/// A mode as it is found.
struct Pair {
    omega2: f64,
    residual: f64,
    is_zero: bool,
    y: Vec<f64>,
}

/// A shift below all modes.
fn below_all(entries: &Entries, axes: usize, unit: f64) -> Result<(f64, Shifted)> {
    let mut shift = FIRST_SHIFT * if unit > 0.0 { unit } else { 1.0 };
    for _ in 0..MOST_SHIFTS {
        if let Some(shifted) = Shifted::new(entries, axes, shift)
            && shifted.below == Some(0)
        {
            return Ok((shift, shifted));
        }
        shift *= LOWER;
    }
    Err(MotionError::ModesUncounted { found: 0, asked: 0 })
}

/// A shift that counts the modes below it, and how many of those found lie there: the middle of
/// the widest gap behind those asked for. Where all behind them are of one frequency it is below
/// that frequency: then any of them are the lowest.
fn counting_shift(pairs: &[Pair], count: usize, total: usize, unit: f64) -> (f64, usize) {
    let near = |omega2: f64| ONE_FREQUENCY * omega2.abs().max(unit);
    let last = pairs[count.max(1) - 1].omega2;
    if pairs.len() >= total {
        let highest = pairs[pairs.len() - 1].omega2;
        return (highest + near(highest), pairs.len());
    }
    let gap = |k: &usize| pairs[k + 1].omega2 - pairs[*k].omega2;
    let widest = (count.max(1) - 1..pairs.len() - 1).max_by(|a, b| gap(a).total_cmp(&gap(b)));
    match widest {
        Some(k) if gap(&k) > 2.0 * near(pairs[k].omega2) => {
            (0.5 * (pairs[k].omega2 + pairs[k + 1].omega2), k + 1)
        }
        _ => {
            let shift = last - 1.5 * near(last);
            (shift, pairs.iter().filter(|pair| pair.omega2 < shift).count())
        }
    }
}

/// Number of all modes with `ω² < 0`: where those found reach above zero, they are the ones.
fn negative(entries: &Entries, axes: usize, pairs: &[Pair]) -> Result<usize> {
    let leaving = pairs.iter().filter(|pair| pair.omega2 < 0.0 && !pair.is_zero).count();
    match pairs.last() {
        Some(last) if last.omega2 < 0.0 && !last.is_zero => {
            // Below zero by less than any that is none.
            let shifted = Shifted::new(entries, axes, ZERO * last.omega2);
            let failed = MotionError::ModesUncounted { found: pairs.len(), asked: pairs.len() };
            shifted.and_then(|shifted| shifted.below).ok_or(failed)
        }
        _ => Ok(leaving),
    }
}

fn solved(pairs: Vec<Pair>, total: usize, negative: usize) -> Solved {
    Solved {
        omega2: pairs.iter().map(|pair| pair.omega2).collect(),
        zero: pairs.iter().map(|pair| pair.is_zero).collect(),
        residual: pairs.iter().map(|pair| pair.residual).collect(),
        shapes: pairs.into_iter().map(|pair| pair.y).collect(),
        total,
        negative,
    }
}

/// Eigenvectors of the operator found so far.
struct Search<'a> {
    entries: &'a Entries,
    shifted: &'a Shifted,
    /// The operator is multiplied by this, 1/s²: its eigenvalues are then about one and below.
    unit: f64,
    values: Vec<f64>,
    /// Displacements of length one in the metric of the inertia.
    shapes: Vec<Vec<f64>>,
}

impl Search<'_> {
    fn inertial(&self, y: &[f64]) -> Vec<f64> {
        self.entries.inertia_times(y)
    }

    /// The operator with these taken out.
    fn operate(&self, y: &[f64], without: &[Vec<f64>]) -> Vec<f64> {
        let inertial = self.inertial(y);
        let mut out = self.shifted.solve(&inertial);
        divide(&mut out, 1.0 / self.unit);
        for (theta, q) in self.values.iter().zip(without) {
            let part = theta * dot(q, &inertial);
            out.iter_mut().zip(q).for_each(|(x, q)| *x -= part * q);
        }
        out
    }

    /// Look for so many more.
    fn add(&mut self, count: usize) {
        let rest = |y: &[f64]| self.operate(y, &self.shapes);
        let metric = |y: &[f64]| self.inertial(y);
        let numbers = [count, self.shapes.len()];
        for (theta, mut y) in largest(&rest, &metric, self.entries.size, numbers) {
            let length = across(&mut y, &self.shapes, &|y| self.entries.inertia_times(y));
            if length > 0.5 {
                divide(&mut y, length);
                self.values.push(theta);
                self.shapes.push(y);
            }
        }
    }

    /// The modes found, each after one more step of inverse iteration.
    fn pairs(&self, stiffness: &Stiffness<'_>, sector: &Sector, shift: f64) -> Vec<Pair> {
        let metric = |y: &[f64]| self.inertial(y);
        let pair = |y: &Vec<f64>| {
            let mut y = self.operate(y, &[]);
            let length = across(&mut y, &[], &metric);
            divide(&mut y, length);
            let [omega2, made_of] = stiffness.energy(sector, &y);
            let mut by = self.operate(&y, &[]);
            let theta = dot(&y, &self.inertial(&by));
            by.iter_mut().zip(&y).for_each(|(by, y)| *by -= theta * y);
            let off = across(&mut by, &[], &metric);
            // There is an eigenvalue of the operator within `off` of theta.
            let of = |theta: f64| shift + self.unit / theta;
            let low = (of(theta + off) - omega2).abs();
            let high = if theta > off { (of(theta - off) - omega2).abs() } else { f64::MAX };
            let is_zero = omega2.abs() <= ZERO * made_of;
            Pair { omega2, residual: low.max(high), is_zero, y }
        };
        self.shapes.iter().map(pair).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(all: &[f64]) -> Vec<Pair> {
        let pair =
            |omega2: &f64| Pair { omega2: *omega2, residual: 0.0, is_zero: false, y: vec![] };
        all.iter().map(pair).collect()
    }

    /// The middle of the widest gap behind those asked for; beside equal ones below them; beyond all.
    #[test]
    fn the_shift_that_counts_lies_in_a_gap() {
        let found = pairs(&[1.0, 9.0, 10.0, 13.0, 14.0]);
        for (count, wanted, below) in
            [(1, 5.0, 1), (2, 11.5, 3), (3, 11.5, 3), (4, 13.5, 4), (0, 5.0, 1)]
        {
            let (shift, counted) = counting_shift(&found, count, 9, 0.5);
            assert!(
                (shift - wanted).abs() < 1e-14 && counted == below,
                "{count}: {shift} {counted}"
            );
        }
        let (shift, counted) = counting_shift(&found, 2, 5, 0.5);
        assert!((shift - 14.0 * (1.0 + ONE_FREQUENCY)).abs() < 1e-14 && counted == 5);
        // A unit that is larger than the frequencies says how near is equal.
        let (shift, counted) = counting_shift(&found, 2, 5, 1e3);
        assert!((shift - 14.001).abs() < 1e-12 && counted == 5);
        let equal = pairs(&[1.0, 4.0, 4.0, 4.0 + 4e-6]);
        let (shift, counted) = counting_shift(&equal, 2, 9, 0.5);
        assert!((shift - 4.0 * (1.0 - 1.5e-6)).abs() < 1e-14 && counted == 1, "{shift} {counted}");
        // Two of them apart: three times what is near is a gap.
        let apart = pairs(&[1.0, 4.0, 4.0 + 12e-6]);
        let (shift, counted) = counting_shift(&apart, 2, 9, 0.5);
        assert!((shift - 4.0 - 6e-6).abs() < 1e-14 && counted == 2, "{shift} {counted}");
    }
}
