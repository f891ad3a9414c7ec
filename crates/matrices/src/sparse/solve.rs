#![expect(
    clippy::inline_always,
    reason = "what is inlined is compiled for the registers of its caller"
)]

use super::blocks::Block;
use super::ldlt::Ldlt;

/// Sums that a product of vectors is split into.
const APART: usize = 4;

impl Ldlt {
    /// Solve in place with the factorisation made last, one right side after the other.
    pub fn solve(&self, right: &mut [f64]) {
        let size = self.size().max(1);
        let mut threes = right.chunks_exact_mut(3 * size);
        for right in &mut threes {
            pulp::Arch::new().dispatch(Solution::<3> { factor: self, right });
        }
        for right in threes.into_remainder().chunks_exact_mut(size) {
            pulp::Arch::new().dispatch(Solution::<1> { factor: self, right });
        }
    }
}

/// Some right sides that are solved for together.
struct Solution<'a, const SIDES: usize> {
    factor: &'a Ldlt,
    right: &'a mut [f64],
}

impl<const SIDES: usize> pulp::NullaryFnOnce for Solution<'_, SIDES> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Ldlt { places, pattern, values, pivots, .. } = self.factor;
        let size = places.len().max(1);
        let mut x = vec![[0.0; SIDES]; places.len()];
        for (side, right) in self.right.chunks_exact(size).enumerate() {
            places.iter().zip(right).for_each(|(place, right)| x[*place][side] = *right);
        }
        let tallest = pattern.blocks.iter().map(Block::height).max().unwrap_or(0);
        let mut below = vec![[0.0; SIDES]; tallest];
        for block in &pattern.blocks {
            let rows = &pattern.rows[block.below()];
            let below = &mut below[..rows.len()];
            below.fill([0.0; SIDES]);
            forwards(&values[block.entries()], &mut x[block.columns.clone()], below);
            for (row, by) in rows.iter().zip(below) {
                x[*row] = std::array::from_fn(|side| x[*row][side] + by[side]);
            }
        }
        for (x, pivot) in x.iter_mut().zip(pivots) {
            *x = x.map(|x| x / pivot);
        }
        for block in pattern.blocks.iter().rev() {
            let rows = &pattern.rows[block.below()];
            let below = &mut below[..rows.len()];
            rows.iter().zip(&mut *below).for_each(|(row, below)| *below = x[*row]);
            backwards(&values[block.entries()], &mut x[block.columns.clone()], below);
        }
        for (side, right) in self.right.chunks_exact_mut(size).enumerate() {
            places.iter().zip(right).for_each(|(place, right)| *right = x[*place][side]);
        }
    }
}

/// Solve with the triangle of a block, and take its rows below off.
#[inline(always)]
fn forwards<const SIDES: usize>(
    block: &[f64],
    own: &mut [[f64; SIDES]],
    below: &mut [[f64; SIDES]],
) {
    let height = own.len() + below.len();
    for (column, values) in block.chunks_exact(height).enumerate() {
        let (before, rest) = own.split_at_mut(column + 1);
        let (upper, lower) = values[column + 1..].split_at(rest.len());
        let by = before[column];
        take_off(rest, upper, by);
        take_off(below, lower, by);
    }
}

/// Take numbers times a vector off vectors.
#[inline(always)]
fn take_off<const SIDES: usize>(vectors: &mut [[f64; SIDES]], numbers: &[f64], by: [f64; SIDES]) {
    for (x, l) in vectors.iter_mut().zip(numbers) {
        for side in 0..SIDES {
            x[side] -= l * by[side];
        }
    }
}

/// Solve with the transpose of a block.
#[inline(always)]
fn backwards<const SIDES: usize>(block: &[f64], own: &mut [[f64; SIDES]], below: &[[f64; SIDES]]) {
    let height = own.len() + below.len();
    for (column, values) in block.chunks_exact(height).enumerate().rev() {
        let (before, rest) = own.split_at_mut(column + 1);
        let (upper, lower) = values[column + 1..].split_at(rest.len());
        let (own, others) = (dot(upper, rest), dot(lower, below));
        let x = &mut before[column];
        *x = std::array::from_fn(|side| x[side] - own[side] - others[side]);
    }
}

/// The sum of some numbers times vectors.
#[inline(always)]
fn dot<const SIDES: usize>(numbers: &[f64], vectors: &[[f64; SIDES]]) -> [f64; SIDES] {
    let mut sums = [[0.0; SIDES]; APART];
    let (mut fours, mut vector_fours) = (numbers.chunks_exact(APART), vectors.chunks_exact(APART));
    for (numbers, vectors) in (&mut fours).zip(&mut vector_fours) {
        for k in 0..APART {
            for side in 0..SIDES {
                sums[k][side] += numbers[k] * vectors[k][side];
            }
        }
    }
    for (number, vector) in fours.remainder().iter().zip(vector_fours.remainder()) {
        for side in 0..SIDES {
            sums[0][side] += number * vector[side];
        }
    }
    std::array::from_fn(|side| sums.iter().map(|sum| sum[side]).sum())
}
