//! Elimination for any graph: a sparse `L D Lᵀ` without pivoting.
//!
//! The three coordinates of a joint are eliminated together, and the row of a member right after
//! the last of its joints. At that point all columns of the row are eliminated, so its pivot is `−(R A⁻¹ Rᵀ)`
//! of independent rows: negative wherever the constraints are independent, whatever the order of
//! the joints. The factorisation is Davis' up-looking one (ACM Trans. Math. Software 31 (2005)
//! 587-591).

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
    /// Entries of each column on and above the diagonal.
    begin: Vec<usize>,
    entries: Vec<(usize, Source)>,
    /// Slot that each unknown belongs to.
    slot: Vec<usize>,
    /// `+1` for a coordinate, `−1` for a row.
    sign: Vec<f64>,
    /// First unknown of each slot; unknown of each row.
    of_slot: Vec<usize>,
    of_row: Vec<usize>,
    parent: Vec<usize>,
    column: Vec<usize>,
    filled: Vec<usize>,
    index: Vec<usize>,
    value: Vec<f64>,
    d: Vec<f64>,
    work: Vec<f64>,
    flag: Vec<usize>,
    pattern: Vec<usize>,
}

const NONE: usize = usize::MAX;

impl Sparse {
    pub(super) fn new(layout: &Layout) -> Self {
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
        let columns = columns(layout, slot.len(), &of_slot, &of_row);
        let mut begin = vec![0];
        let mut entries = Vec::new();
        for column in columns {
            entries.extend(column);
            begin.push(entries.len());
        }
        let size = slot.len();
        let mut found = Self {
            begin,
            entries,
            slot,
            sign,
            of_slot,
            of_row,
            parent: vec![NONE; size],
            column: Vec::new(),
            filled: vec![0; size],
            index: Vec::new(),
            value: Vec::new(),
            d: vec![0.0; size],
            work: vec![0.0; size],
            flag: vec![NONE; size],
            pattern: vec![0; size],
        };
        found.analyse();
        found
    }

    /// The elimination tree and the number of entries in each column of `L`.
    fn analyse(&mut self) {
        let size = self.slot.len();
        let mut count = vec![0; size];
        for k in 0..size {
            self.flag[k] = k;
            for &(row, _) in &self.entries[self.begin[k]..self.begin[k + 1]] {
                let mut i = row;
                while self.flag[i] != k {
                    if self.parent[i] == NONE {
                        self.parent[i] = k;
                    }
                    count[i] += 1;
                    self.flag[i] = k;
                    i = self.parent[i];
                }
            }
        }
        self.column = vec![0];
        for entries in count {
            self.column.push(self.column[self.column.len() - 1] + entries);
        }
        self.index = vec![0; self.column[size]];
        self.value = vec![0.0; self.column[size]];
    }

    pub(super) fn factor(&mut self, vectors: &[Vector]) -> Result<(), Singular> {
        let size = self.slot.len();
        self.flag.fill(NONE);
        self.filled.fill(0);
        for k in 0..size {
            let mut top = size;
            self.flag[k] = k;
            for &(row, source) in &self.entries[self.begin[k]..self.begin[k + 1]] {
                self.work[row] += match source {
                    Source::Inertia(m) => m,
                    Source::Row { vector, axis, sign } => sign * vectors[vector][axis],
                };
                let (mut i, mut length) = (row, 0);
                while self.flag[i] != k {
                    self.pattern[length] = i;
                    length += 1;
                    self.flag[i] = k;
                    i = self.parent[i];
                }
                while length > 0 {
                    length -= 1;
                    top -= 1;
                    self.pattern[top] = self.pattern[length];
                }
            }
            let mut pivot = self.work[k];
            let mut made_of = pivot.abs();
            self.work[k] = 0.0;
            for at in top..size {
                let i = self.pattern[at];
                let y = self.work[i];
                self.work[i] = 0.0;
                let (first, end) = (self.column[i], self.column[i] + self.filled[i]);
                for p in first..end {
                    self.work[self.index[p]] -= self.value[p] * y;
                }
                let l = y / self.d[i];
                pivot -= l * y;
                made_of += (l * y).abs();
                self.index[end] = k;
                self.value[end] = l;
                self.filled[i] += 1;
            }
            let relative = pivot * self.sign[k] / made_of;
            if relative.is_nan() || relative <= LEAST_PIVOT {
                self.work.fill(0.0);
                return Err(Singular { slot: self.slot[k], pivot: relative });
            }
            self.d[k] = pivot;
        }
        Ok(())
    }

    pub(super) fn solve(&mut self, x: &mut [Vector], rows: &mut [f64]) {
        let b = &mut self.work;
        for (x, &first) in x.iter().zip(&self.of_slot) {
            b[first..first + 3].copy_from_slice(x);
        }
        for (&right, &at) in rows.iter().zip(&self.of_row) {
            b[at] = right;
        }
        let size = self.slot.len();
        for j in 0..size {
            let y = b[j];
            for p in self.column[j]..self.column[j + 1] {
                b[self.index[p]] -= self.value[p] * y;
            }
        }
        for j in (0..size).rev() {
            let mut y = b[j] / self.d[j];
            for p in self.column[j]..self.column[j + 1] {
                y -= self.value[p] * b[self.index[p]];
            }
            b[j] = y;
        }
        for (x, &first) in x.iter_mut().zip(&self.of_slot) {
            x.copy_from_slice(&b[first..first + 3]);
        }
        for (right, &at) in rows.iter_mut().zip(&self.of_row) {
            *right = b[at];
        }
        b.fill(0.0);
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
