#![expect(
    clippy::inline_always,
    reason = "what is inlined is compiled for the registers of its caller"
)]

use nalgebra::{DMatrixView, DMatrixViewMut, Dyn};

use super::blocks::{Block, NONE, Pattern};
use super::entries::{compressed, places};

/// Products of fewer multiplications than this are loops: packing takes longer.
const LOOP: usize = 600;

/// Columns of a block that are eliminated one by one before those after them take them together.
const PANEL: usize = 32;

/// What becomes of the pivots. One that is not finite ends every factorisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pivots {
    /// They are to be positive: the first that is not ends the factorisation.
    Positive,
    /// They may be negative; one that vanishes ends the factorisation.
    Signed,
    /// They may be negative; one of magnitude up to `least` becomes `instead`, with its sign.
    Replaced {
        /// Up to this magnitude.
        least: f64,
        /// The magnitude in its place.
        instead: f64,
    },
    /// They ought to be positive; one up to `least`, a negative one too, becomes `instead`.
    Raised {
        /// Up to this.
        least: f64,
        /// What is in its place.
        instead: f64,
    },
}

impl Pivots {
    /// What is taken for a pivot; `None` ends the factorisation.
    fn taken(self, pivot: f64) -> Option<f64> {
        match self {
            _ if !pivot.is_finite() => None,
            Self::Positive if pivot <= 0.0 => None,
            Self::Signed if pivot.abs() <= 0.0 => None,
            Self::Replaced { least, instead } if pivot < 0.0 && -pivot <= least => Some(-instead),
            Self::Replaced { least, instead } if pivot.abs() <= least => Some(instead),
            Self::Raised { least, instead } if pivot <= least => Some(instead),
            _ => Some(pivot),
        }
    }
}

/// A factorisation $P A P^T = L D L^T$ with ones on the diagonal of $L$, the pattern analysed once.
#[derive(Debug, Clone)]
pub struct Ldlt {
    /// The place of each row of the matrix in the order of elimination.
    pub(super) places: Vec<usize>,
    pub(super) pattern: Pattern,
    /// Where each entry of the matrix goes.
    targets: Vec<usize>,
    pub(super) values: Vec<f64>,
    pub(super) pivots: Vec<f64>,
    memory: Memory,
}

/// What a factorisation works in.
#[derive(Debug, Clone)]
struct Memory {
    /// Where a row stands in the block at hand.
    local: Vec<usize>,
    /// What a block subtracts from another.
    update: Vec<f64>,
    /// Rows of a block times its pivots.
    scaled: Vec<f64>,
    /// The blocks that are yet to be subtracted from a block: the first, and the one after each.
    first: Vec<usize>,
    next: Vec<usize>,
    /// Up to which of its rows each block is subtracted.
    reached: Vec<usize>,
}

/// So many zeros; `None` where there is no memory for them.
fn zeros(length: usize) -> Option<Vec<f64>> {
    let mut all = Vec::new();
    all.try_reserve_exact(length).ok()?;
    all.resize(length, 0.0);
    Some(all)
}

impl Ldlt {
    /// Analyse a matrix of which the entries of one triangle are given by columns, and an order of elimination; entries
    /// at one place are added up. `None` where there is no memory for the factor.
    ///
    /// # Panics
    ///
    /// When the order is no permutation of the columns.
    pub fn new(starts: &[usize], rows: &[usize], order: &[usize]) -> Option<Self> {
        let size = order.len();
        let mut turned = vec![0; size];
        for (k, column) in order.iter().enumerate() {
            turned[*column] = k;
        }
        let pairs = places(starts, rows).map(|(row, column, _)| {
            let (a, b) = (turned[row], turned[column]);
            (a.max(b), a.min(b))
        });
        let below = pairs.clone().filter(|(row, column)| row > column);
        let (begins, lower) = compressed(size, below);
        let pattern = Pattern::new(&begins, &lower)?;
        let targets = pairs.map(|(row, column)| pattern.place(row, column)).collect();
        let values = zeros(pattern.blocks.last().map_or(0, |block| block.entries().end))?;
        let memory = Memory::new(&pattern)?;
        let pivots = vec![0.0; size];
        Some(Self { places: turned, targets, values, pivots, memory, pattern })
    }

    /// Rows and columns of the matrix.
    pub fn size(&self) -> usize {
        self.places.len()
    }

    /// Entries of the factor, the diagonal included: the measure of its memory and work.
    pub fn entries(&self) -> usize {
        self.pattern.entries()
    }

    /// The diagonal of $D$, in the order of elimination; not numbers from where the factorisation ended.
    pub fn pivots(&self) -> &[f64] {
        &self.pivots
    }

    /// Row, column and value of each entry of $L$ below the diagonal, in the order of elimination.
    pub fn lower(&self, mut visit: impl FnMut(usize, usize, f64)) {
        for block in &self.pattern.blocks {
            let rows = &self.pattern.rows[block.rows.clone()];
            let columns = self.values[block.entries()].chunks_exact(block.height());
            for (k, values) in columns.enumerate() {
                let below = rows.iter().zip(values).skip(k + 1);
                below.for_each(|(row, value)| visit(*row, block.columns.start + k, *value));
            }
        }
    }

    /// Factorise the matrix with these entries, in the order of the pattern; whether it came to its end.
    ///
    /// Every entry of $L$ is $\big(a_{ij} - \sum_k l_{ik} d_k l_{jk}\big)/d_j$: a division, and for each term two products
    /// and a sum that round.
    pub fn factorise(&mut self, matrix: &[f64], pivots: Pivots) -> bool {
        self.values.fill(0.0);
        self.pivots.fill(f64::NAN);
        self.memory.first.fill(NONE);
        for (at, entry) in self.targets.iter().zip(matrix) {
            self.values[*at] += entry;
        }
        pulp::Arch::new().dispatch(Elimination { of: self, pivots })
    }
}

impl Memory {
    fn new(pattern: &Pattern) -> Option<Self> {
        let (mut update, mut scaled) = (0, 0);
        for block in &pattern.blocks {
            for (count, left) in pattern.parts(block) {
                update = update.max(left * count);
                scaled = scaled.max(block.width() * count);
            }
            scaled = scaled.max(PANEL.min(block.width()) * block.width());
        }
        let count = pattern.blocks.len();
        let local = vec![0; pattern.block_of.len()];
        let (first, next, reached) = (vec![NONE; count], vec![NONE; count], vec![0; count]);
        let (update, scaled) = (zeros(update)?, zeros(scaled)?);
        Some(Self { local, update, scaled, first, next, reached })
    }

    /// Let a block wait, from one of its rows on, for the block in which this stands.
    fn wait(&mut self, pattern: &Pattern, block: usize, from: usize) {
        let rows = &pattern.rows[pattern.blocks[block].rows.clone()];
        if let Some(row) = rows.get(from) {
            self.reached[block] = from;
            self.next[block] = std::mem::replace(&mut self.first[pattern.block_of[*row]], block);
        }
    }
}

/// A factorisation, to be compiled once for each kind of vector register.
struct Elimination<'a> {
    of: &'a mut Ldlt,
    pivots: Pivots,
}

impl pulp::NullaryFnOnce for Elimination<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let Ldlt { pattern, values, pivots, memory, .. } = self.of;
        for (k, block) in pattern.blocks.iter().enumerate() {
            let rows = &pattern.rows[block.rows.clone()];
            for (local, row) in rows.iter().enumerate() {
                memory.local[*row] = local;
            }
            let (before, from_here) = values.split_at_mut(block.start);
            let own = &mut from_here[..block.width() * block.height()];
            let mut other = memory.first[k];
            while other != NONE {
                let next = memory.next[other];
                let of = &pattern.blocks[other];
                let rows = &pattern.rows[of.rows.clone()];
                let from = memory.reached[other];
                let here = rows[from..].partition_point(|row| *row < block.columns.end);
                let left = Rows { height: rows.len(), from, count: here };
                product(&before[of.entries()], left, &pivots[of.columns.clone()], memory);
                subtract(&rows[from..], here, block, memory, own);
                memory.wait(pattern, other, from + here);
                other = next;
            }
            let own_pivots = &mut pivots[block.columns.clone()];
            if !eliminate(own, own_pivots, self.pivots, &mut memory.scaled) {
                return false;
            }
            memory.wait(pattern, k, block.width());
        }
        true
    }
}

/// Rows of a block: from one of them `count`, and all below.
#[derive(Clone, Copy)]
struct Rows {
    height: usize,
    from: usize,
    count: usize,
}

/// The rows of a block from one on, times its pivots and the transpose of the first of them, into `update`.
#[inline(always)]
fn product(block: &[f64], rows: Rows, pivots: &[f64], memory: &mut Memory) {
    let Rows { height, from, count } = rows;
    let (left, width) = (height - from, pivots.len());
    let update = &mut memory.update[..left * count];
    if left * count * width < LOOP {
        update.fill(0.0);
        for (values, pivot) in block.chunks_exact(height).zip(pivots) {
            let values = &values[from..];
            for (column, update) in update.chunks_exact_mut(left).enumerate() {
                let by = pivot * values[column];
                for (x, l) in update[column..].iter_mut().zip(&values[column..]) {
                    *x += l * by;
                }
            }
        }
        return;
    }
    let scaled = &mut memory.scaled[..width * count];
    scale(block, height, from..from + count, pivots, scaled);
    let mut update = DMatrixViewMut::from_slice(update, left, count);
    update.gemm(
        1.0,
        &part(&block[from..], left, width, height),
        &part(scaled, width, count, width),
        0.0,
    );
}

/// Rows of a block times its pivots, each as a column.
#[inline(always)]
fn scale(
    block: &[f64],
    height: usize,
    rows: std::ops::Range<usize>,
    pivots: &[f64],
    scaled: &mut [f64],
) {
    let width = pivots.len();
    for (k, (values, pivot)) in block.chunks_exact(height).zip(pivots).enumerate() {
        for (row, value) in values[rows.clone()].iter().enumerate() {
            scaled[row * width + k] = pivot * value;
        }
    }
}

/// A matrix within columns of some height.
fn part(
    entries: &[f64],
    rows: usize,
    columns: usize,
    height: usize,
) -> DMatrixView<'_, f64, Dyn, Dyn> {
    DMatrixView::from_slice_with_strides_generic(
        entries,
        Dyn(rows),
        Dyn(columns),
        Dyn(1),
        Dyn(height),
    )
}

/// Subtract an update of some rows, of which the first ones are columns of the block.
#[inline(always)]
fn subtract(rows: &[usize], columns: usize, block: &Block, memory: &Memory, own: &mut [f64]) {
    let height = block.height();
    for (k, update) in memory.update.chunks_exact(rows.len()).take(columns).enumerate() {
        let own = &mut own[(rows[k] - block.columns.start) * height..][..height];
        for (row, by) in rows.iter().zip(update).skip(k) {
            own[memory.local[*row]] -= by;
        }
    }
}

/// Eliminate the columns of a block; whether all pivots were taken.
#[inline(always)]
fn eliminate(own: &mut [f64], found: &mut [f64], pivots: Pivots, scaled: &mut [f64]) -> bool {
    let width = found.len();
    let height = own.len() / width;
    for begin in (0..width).step_by(PANEL) {
        let end = (begin + PANEL).min(width);
        for column in begin..end {
            let (before, after) = own.split_at_mut((column + 1) * height);
            let values = &mut before[column * height..];
            let Some(pivot) = pivots.taken(values[column]) else { return false };
            found[column] = pivot;
            let others = after.chunks_exact_mut(height).take(end - column - 1);
            for (row, other) in (column + 1..).zip(others) {
                let by = values[row] / pivot;
                for (x, l) in other[row..].iter_mut().zip(&values[row..]) {
                    *x -= l * by;
                }
            }
            values[column + 1..].iter_mut().for_each(|x| *x /= pivot);
        }
        let (before, after) = own.split_at_mut(end * height);
        let panel = &before[begin * height..];
        let scaled = &mut scaled[..(end - begin) * (width - end)];
        scale(panel, height, end..width, &found[begin..end], scaled);
        // In parts, as half of the square above the diagonal is of no use.
        for first in (end..width).step_by(2 * PANEL) {
            let (count, left) = ((2 * PANEL).min(width - first), height - first);
            let own = &mut after[(first - end) * height + first..];
            let size = (Dyn(left), Dyn(count));
            let mut own = DMatrixViewMut::from_slice_with_strides_generic(
                own,
                size.0,
                size.1,
                Dyn(1),
                Dyn(height),
            );
            let scaled = &scaled[(first - end) * (end - begin)..];
            let by = part(scaled, end - begin, count, end - begin);
            own.gemm(-1.0, &part(&panel[first..], left, end - begin, height), &by, 1.0);
        }
    }
    true
}
