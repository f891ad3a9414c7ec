//! How much memory the columns of a file may take.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use ::parquet::errors::ParquetError;
use model::system_file::most_bars;

use crate::error::ColumnsError;

/// Memory for each bar that a system may have, bytes: a page of each of twelve columns.
const BYTES_PER_BAR: u64 = 100;

/// The most in any case, bytes: three columns of doubles of as many bars as a system may have,
/// each as one page.
const MOST_BYTES: u64 = 1 << 29;

/// What the pages and dictionaries of one file may hold together, asked before each of them grows.
#[derive(Debug)]
pub struct Budget {
    path: PathBuf,
    limit: u64,
    held: AtomicU64,
}

impl Budget {
    pub fn of(path: &Path) -> Arc<Self> {
        let limit = (most_bars() as u64).saturating_mul(BYTES_PER_BAR).min(MOST_BYTES);
        Arc::new(Self { path: path.to_owned(), limit, held: AtomicU64::new(0) })
    }

    /// What is left, bytes.
    pub fn left(&self) -> usize {
        let left = self.limit.saturating_sub(self.held.load(Ordering::Relaxed));
        usize::try_from(left).unwrap_or(usize::MAX)
    }
}

/// What one column holds of the budget; given back when it goes away.
#[derive(Debug)]
pub struct Share {
    budget: Arc<Budget>,
    column: String,
    held: u64,
}

impl Share {
    pub fn new(budget: &Arc<Budget>, column: &str) -> Self {
        Self { budget: budget.clone(), column: column.to_owned(), held: 0 }
    }

    /// Nothing yet, for the same column.
    pub fn empty(&self) -> Self {
        Self::new(&self.budget, &self.column)
    }

    pub fn left(&self) -> usize {
        self.budget.left()
    }

    /// A size that a file claims, as far as there is room for it.
    pub fn fits(&self, claimed: u64) -> Result<usize, ParquetError> {
        let left = self.left();
        usize::try_from(claimed).ok().filter(|size| *size <= left).ok_or_else(|| {
            let (path, column) = (self.budget.path.clone(), self.column.clone());
            let (left, budget) = (left as u64, self.budget.limit);
            external(ColumnsError::Memory { path, column, claimed, left, budget })
        })
    }

    /// Hold so much more.
    pub fn take(&mut self, bytes: u64) -> Result<(), ParquetError> {
        self.fits(bytes)?;
        self.held += bytes;
        self.budget.held.fetch_add(bytes, Ordering::Relaxed);
        Ok(())
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        self.budget.held.fetch_sub(self.held, Ordering::Relaxed);
    }
}

/// An error on its way through the `parquet` crate.
pub fn external(error: impl std::error::Error + Send + Sync + 'static) -> ParquetError {
    ParquetError::External(Box::new(error))
}
