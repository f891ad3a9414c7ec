//! A matrix as it is put together.

/// The entries of a sparse matrix, by columns; those at one place are added up.
#[derive(Debug, Clone, PartialEq)]
pub struct Entries {
    /// Where each column starts, and where the last one ends.
    pub starts: Vec<usize>,
    /// The row of each entry.
    pub rows: Vec<usize>,
    /// Their values.
    pub values: Vec<f64>,
}

impl Entries {
    /// The square matrix of entries that are given by row, column and value.
    ///
    /// # Panics
    ///
    /// When a column is not below `size`.
    pub fn new(size: usize, entries: &[(usize, usize, f64)]) -> Self {
        let numbered = entries.iter().enumerate().map(|(k, (_, column, _))| (k, *column));
        let (starts, order) = compressed(size, numbered);
        let rows = order.iter().map(|k| entries[*k].0).collect();
        let values = order.iter().map(|k| entries[*k].2).collect();
        Self { starts, rows, values }
    }

    /// Row, column and place of each entry.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        places(&self.starts, &self.rows)
    }
}

/// Row, column and place of each entry of a pattern.
pub(super) fn places<'a>(
    starts: &'a [usize],
    rows: &'a [usize],
) -> impl Iterator<Item = (usize, usize, usize)> + Clone + 'a {
    let columns = starts.windows(2).enumerate();
    columns.flat_map(move |(column, own)| (own[0]..own[1]).map(move |at| (rows[at], column, at)))
}

/// A pattern by columns, of rows and columns in any order; the rows of a column stay in theirs.
pub(super) fn compressed(
    size: usize,
    pairs: impl Iterator<Item = (usize, usize)> + Clone,
) -> (Vec<usize>, Vec<usize>) {
    let mut ends = vec![0; size + 1];
    for (_, column) in pairs.clone() {
        ends[column + 1] += 1;
    }
    for k in 0..size {
        ends[k + 1] += ends[k];
    }
    let (starts, mut rows) = (ends.clone(), vec![0; ends[size]]);
    for (row, column) in pairs {
        rows[ends[column]] = row;
        ends[column] += 1;
    }
    (starts, rows)
}
