//! The pattern of the factor: which columns form a block, and in which rows a block has entries.

use std::ops::Range;

use super::entries::{compressed, places};

/// No column, no block.
pub(super) const NONE: usize = usize::MAX;

/// Columns of the factor that are stored together, each after the one before.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// Its columns, in the order of elimination.
    pub(super) columns: Range<usize>,
    /// Where its rows stand: its own columns, then those below.
    pub(super) rows: Range<usize>,
    /// Where its entries start.
    pub(super) start: usize,
}

impl Block {
    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    pub(super) fn height(&self) -> usize {
        self.rows.len()
    }

    /// Where its entries stand.
    pub(super) fn entries(&self) -> Range<usize> {
        self.start..self.start + self.width() * self.height()
    }

    /// Where the rows below its own stand.
    pub(super) fn below(&self) -> Range<usize> {
        self.rows.start + self.width()..self.rows.end
    }
}

/// The pattern of a factor.
#[derive(Debug, Clone)]
pub(super) struct Pattern {
    pub(super) blocks: Vec<Block>,
    /// The rows of the blocks, one block after the other, ascending in each.
    pub(super) rows: Vec<usize>,
    /// The block of each column.
    pub(super) block_of: Vec<usize>,
}

impl Pattern {
    /// That of the factor of a matrix with these entries below the diagonal, by columns; `None` where there is no
    /// memory for it.
    pub(super) fn new(starts: &[usize], lower: &[usize]) -> Option<Self> {
        let size = starts.len() - 1;
        let across = places(starts, lower).map(|(row, column, _)| (column, row));
        let (row_starts, columns) = compressed(size, across);
        let (parents, counts) = tree(&row_starts, &columns);
        let sizes = widths(&parents, &counts);
        let mut block_of = vec![0; size];
        let mut all: Vec<usize> = Vec::new();
        all.try_reserve_exact(sizes.iter().map(|size| size.height).sum()).ok()?;
        let mut blocks: Vec<Block> = Vec::with_capacity(sizes.len());
        let (mut seen, mut start) = (vec![NONE; size], 0);
        // The blocks whose first row below stands in a block: a list of each.
        let (mut first, mut next) = (vec![NONE; sizes.len()], vec![NONE; sizes.len()]);
        for (k, Size { columns, .. }) in sizes.iter().enumerate() {
            block_of[columns.clone()].fill(k);
        }
        for (k, Size { columns, height, .. }) in sizes.into_iter().enumerate() {
            let begin = all.len();
            let mut add = |all: &mut Vec<usize>, row: usize| {
                if std::mem::replace(&mut seen[row], k) != k {
                    all.push(row);
                }
            };
            let own = &lower[starts[columns.start]..starts[columns.end]];
            for row in columns.clone().chain(own.iter().copied()) {
                add(&mut all, row);
            }
            let mut before = first[k];
            while before != NONE {
                for at in blocks[before].below() {
                    let row = all[at];
                    add(&mut all, row);
                }
                before = next[before];
            }
            all[begin..].sort_unstable();
            debug_assert_eq!(all.len() - begin, height);
            let block = Block { columns, rows: begin..all.len(), start };
            if let Some(row) = all[block.below()].first() {
                next[k] = std::mem::replace(&mut first[block_of[*row]], k);
            }
            start = block.entries().end;
            blocks.push(block);
        }
        Some(Self { blocks, rows: all, block_of })
    }

    /// Where the entry at a row and a column of the factor stands.
    pub(super) fn place(&self, row: usize, column: usize) -> usize {
        let block = &self.blocks[self.block_of[column]];
        let at = self.rows[block.rows.clone()].partition_point(|other| *other < row);
        block.start + (column - block.columns.start) * block.height() + at
    }

    /// Entries of the factor, with the zeros that blocks have on and below the diagonal.
    pub(super) fn entries(&self) -> usize {
        self.blocks.iter().map(|block| trapezoid(block.width(), block.height())).sum()
    }

    /// How many rows below a block stand in another from one of them on, and how many in all from there.
    pub(super) fn parts(&self, block: &Block) -> impl Iterator<Item = (usize, usize)> + '_ {
        let mut left = &self.rows[block.below()];
        std::iter::from_fn(move || {
            let into = self.block_of[*left.first()?];
            let count = left.partition_point(|row| self.block_of[*row] <= into);
            let all = left.len();
            left = &left[count..];
            Some((count, all))
        })
    }
}

/// The elimination tree of a matrix of which the entries below the diagonal are given by rows: the first row below each
/// diagonal in which the factor has an entry, and how many entries a column of the factor has.
fn tree(starts: &[usize], columns: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let size = starts.len() - 1;
    let (mut parents, mut ancestors) = (vec![NONE; size], vec![NONE; size]);
    for (column, row, _) in places(starts, columns) {
        let mut k = column;
        while k != NONE && k < row {
            let above = std::mem::replace(&mut ancestors[k], row);
            if above == NONE {
                parents[k] = row;
            }
            k = above;
        }
    }
    let (mut counts, mut seen) = (vec![1; size], ancestors);
    for row in 0..size {
        seen[row] = row;
        for column in &columns[starts[row]..starts[row + 1]] {
            let mut k = *column;
            while std::mem::replace(&mut seen[k], row) != row {
                counts[k] += 1;
                k = parents[k];
            }
        }
    }
    (parents, counts)
}

/// Columns that form a block.
struct Size {
    columns: Range<usize>,
    height: usize,
    /// Entries of these columns of the factor.
    entries: usize,
}

/// Entries on and below the diagonal of a block.
fn trapezoid(width: usize, height: usize) -> usize {
    width * height - width * (width - 1) / 2
}

/// The blocks: columns with the same rows, and more where that stores few zeros.
fn widths(parents: &[usize], counts: &[usize]) -> Vec<Size> {
    let mut found: Vec<Size> = Vec::new();
    for (column, height) in counts.iter().copied().enumerate() {
        found.push(Size { columns: column..column + 1, height, entries: height });
        while let [.., before, last] = &found[..]
            && parents[last.columns.start - 1] < last.columns.end
        {
            let columns = before.columns.start..last.columns.end;
            let height = before.columns.len() + last.height;
            let entries = before.entries + last.entries;
            let all = trapezoid(columns.len(), height);
            if all - entries > few(columns.len(), all) {
                break;
            }
            found.truncate(found.len() - 2);
            found.push(Size { columns, height, entries });
        }
    }
    found
}

/// The zeros that a block of this width may store.
fn few(width: usize, entries: usize) -> usize {
    let part = match width {
        ..=4 => 4,
        5..=16 => 8,
        17..=48 => 10,
        _ => 20,
    };
    entries / part
}
