//! The part of the derivative that breaks a symmetry, bordered so that it stays regular where that part
//! is singular.

use numerics::Interval;

use super::equations::Entry;
use super::family::Family;
use super::inverse::Inverse;
use super::symmetry::Block;

/// $[J_\chi, p; q, 0]$ with $p$ and $q$ near the left and right null vectors.
#[derive(Debug, Clone)]
pub(super) struct Side {
    pub(super) block: usize,
    column: Vec<f64>,
    row: Vec<f64>,
    pub(super) inverse: Inverse,
}

impl Side {
    /// Next to a point with this derivative by all unknowns; borders that suit another one near by may be
    /// given.
    pub(super) fn new(
        family: &Family<'_>,
        block: usize,
        slope: &[Entry],
        borders: Option<&Self>,
    ) -> Option<Self> {
        let own = family.blocks[block].restrict(slope);
        let size = family.blocks[block].size();
        let inverse =
            |column: &[f64], row: &[f64]| Inverse::of(size + 1, &bordered(&own, column, row));
        let found = if let Some(side) = borders {
            inverse(&side.column, &side.row)?
        } else {
            // Without any symmetry that may hide the null vectors.
            let any: Vec<f64> = (0..size).map(|k| 1.0 + (k as f64).sin()).collect();
            inverse(&any, &any)?
        };
        let [column, row] = [found.last_row(), &found.last_column()].map(|x| unit(&x[..size]));
        let inverse = inverse(&column, &row)?;
        Some(Self { block, column, row, inverse })
    }

    pub(super) fn of<'a>(&self, family: &'a Family<'_>) -> &'a Block {
        &family.blocks[self.block]
    }

    /// The entries over a box, of whose derivative by all unknowns these are given.
    pub(super) fn entries(&self, family: &Family<'_>, jacobian: &[Entry]) -> Vec<Entry> {
        bordered(&self.of(family).restrict(jacobian), &self.column, &self.row)
    }
}

fn bordered(own: &[Entry], column: &[f64], row: &[f64]) -> Vec<Entry> {
    let last = column.len();
    let mut entries = own.to_vec();
    entries.extend(column.iter().enumerate().map(|(k, p)| (k, last, Interval::point(*p))));
    entries.extend(row.iter().enumerate().map(|(k, q)| (last, k, Interval::point(*q))));
    entries
}

fn unit(x: &[f64]) -> Vec<f64> {
    let size = x.iter().map(|x| x * x).sum::<f64>().sqrt();
    x.iter().map(|x| x / size).collect()
}
