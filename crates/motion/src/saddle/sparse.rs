//! Elimination for any graph: a sparse `L D Lᵀ` without pivoting.
//!
//! The three coordinates of a joint are eliminated together, and the row of a member right after
//! the last of its joints. At that point all columns of the row are eliminated, so its pivot is `−(R A⁻¹ Rᵀ)`
//! of independent rows: negative wherever the constraints are independent, whatever the order of
//! the joints.

use matrices::sparse::{Ldlt, Pivots};
use model::Vector;

use super::{Layout, OwnRow, Singular};

/// Least pivot relative to the numbers that were subtracted to get it: below it is rounding.
const LEAST_PIVOT: f64 = 1e-13;

/// Where the value of an entry comes from.
#[derive(Debug, Clone, Copy)]
enum Source {
    Inertia(f64),
    Row { vector: usize, axis: usize, sign: f64 },
}

#[derive(Debug, Clone)]
pub(crate) struct Sparse {
    /// The entries on and above the diagonal, column by column, and where their values come from.
    entries: Vec<(usize, usize, Source)>,
    /// Slot that each unknown belongs to.
    slot: Vec<usize>,
    /// `+1` for a coordinate, `−1` for a row.
    sign: Vec<f64>,
    /// First unknown of each slot; unknown of each row.
    of_slot: Vec<usize>,
    of_row: Vec<usize>,
    factor: Ldlt,
    values: Vec<f64>,
    /// Sums of the magnitudes that a pivot is made of.
    made_of: Vec<f64>,
    right: Vec<f64>,
}

impl Sparse {
    /// `None` where there is no memory for the factor.
    pub(super) fn new(layout: &Layout) -> Option<Self> {
        let n = layout.mass.len();
        let mut last = vec![None; layout.rows()];
        for edge in &layout.edges {
            if let Some([row, _]) = edge.row {
                last[row] = last[row].max(Some(edge.a.max(edge.b)));
            }
        }
        for OwnRow { slot, row: [row, _], .. } in &layout.own {
            last[*row] = last[*row].max(Some(*slot));
        }
        let mut complete_at: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (row, slot) in last.into_iter().enumerate() {
            complete_at[slot.unwrap_or_default()].push(row);
        }
        let (mut slot, mut sign) = (Vec::new(), Vec::new());
        let mut of_slot = vec![0; n];
        let mut of_row = vec![0; layout.rows()];
        for (s, rows) in complete_at.iter().enumerate() {
            of_slot[s] = slot.len();
            slot.extend([s; 3]);
            sign.extend([1.0; 3]);
            for &row in rows {
                of_row[row] = slot.len();
                slot.push(s);
                sign.push(-1.0);
            }
        }
        let size = slot.len();
        let (mut starts, mut entries) = (vec![0], Vec::new());
        for (column, of_column) in columns(layout, size, &of_slot, &of_row).into_iter().enumerate()
        {
            entries.extend(of_column.into_iter().map(|(row, source)| (row, column, source)));
            starts.push(entries.len());
        }
        let rows: Vec<usize> = entries.iter().map(|(row, ..)| *row).collect();
        let order: Vec<usize> = (0..size).collect();
        let factor = Ldlt::new(&starts, &rows, &order)?;
        let (values, made_of, right) = (vec![0.0; entries.len()], vec![0.0; size], vec![0.0; size]);
        Some(Self { entries, slot, sign, of_slot, of_row, factor, values, made_of, right })
    }

    pub(super) fn factor(&mut self, vectors: &[Vector]) -> Result<(), Singular> {
        self.made_of.fill(0.0);
        for (value, &(row, column, source)) in self.values.iter_mut().zip(&self.entries) {
            *value = match source {
                Source::Inertia(m) => m,
                Source::Row { vector, axis, sign } => sign * vectors[vector][axis],
            };
            if row == column {
                self.made_of[row] += value.abs();
            }
        }
        // Where it ends, the pivots are no numbers.
        self.factor.factorise(&self.values, Pivots::Signed);
        let pivots = self.factor.pivots();
        self.factor.lower(|row, column, l| self.made_of[row] += l * l * pivots[column].abs());
        for (k, (pivot, made_of)) in pivots.iter().zip(&self.made_of).enumerate() {
            let relative = pivot * self.sign[k] / made_of;
            if relative.is_nan() || relative <= LEAST_PIVOT {
                return Err(Singular { slot: self.slot[k], pivot: relative });
            }
        }
        Ok(())
    }

    pub(super) fn solve(&mut self, x: &mut [Vector], rows: &mut [f64]) {
        let b = &mut self.right;
        b.fill(0.0);
        for (x, &first) in x.iter().zip(&self.of_slot) {
            b[first..first + 3].copy_from_slice(x);
        }
        for (&right, &at) in rows.iter().zip(&self.of_row) {
            b[at] = right;
        }
        self.factor.solve(b);
        for (x, &first) in x.iter_mut().zip(&self.of_slot) {
            x.copy_from_slice(&b[first..first + 3]);
        }
        for (right, &at) in rows.iter_mut().zip(&self.of_row) {
            *right = b[at];
        }
    }
}

/// The entries on and above the diagonal, column by column.
fn columns(
    layout: &Layout,
    size: usize,
    of_slot: &[usize],
    of_row: &[usize],
) -> Vec<Vec<(usize, Source)>> {
    let mut columns: Vec<Vec<(usize, Source)>> = vec![Vec::new(); size];
    for (slot, &mass) in layout.mass.iter().enumerate() {
        for axis in 0..3 {
            let k = of_slot[slot] + axis;
            columns[k].push((k, Source::Inertia(mass)));
        }
    }
    let mut row_entries = |slot: usize, [row, vector]: [usize; 2], sign: f64| {
        for axis in 0..3 {
            columns[of_row[row]].push((of_slot[slot] + axis, Source::Row { vector, axis, sign }));
        }
    };
    for edge in &layout.edges {
        if let Some(row) = edge.row {
            row_entries(edge.a, row, -1.0);
            row_entries(edge.b, row, 1.0);
        }
    }
    for own in &layout.own {
        row_entries(own.slot, own.row, own.sign);
    }
    for edge in &layout.edges {
        for axis in 0..3 {
            let (first, second) = (edge.a.min(edge.b), edge.a.max(edge.b));
            let column = &mut columns[of_slot[second] + axis];
            column.push((of_slot[first] + axis, Source::Inertia(edge.between)));
        }
    }
    columns
}
