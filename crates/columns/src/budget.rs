//! How much memory the columns of a file may take.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ::parquet::errors::ParquetError;
use model::budget::{self, OutOfMemory};
use model::system_file::most_bars_of_file;

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
    bytes: budget::Budget,
}

impl Budget {
    pub fn of(path: &Path) -> Arc<Self> {
        let limit = (most_bars_of_file() as u64).saturating_mul(BYTES_PER_BAR).min(MOST_BYTES);
        Arc::new(Self { path: path.to_owned(), bytes: budget::Budget::new(limit) })
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

    /// What is left for all columns, bytes.
    pub fn left(&self) -> usize {
        usize::try_from(self.budget.bytes.left()).unwrap_or(usize::MAX)
    }

    /// A size that a file claims, as far as there is room for it.
    pub fn fits(&self, claimed: u64) -> Result<usize, ParquetError> {
        self.budget.bytes.fits(claimed).map_err(|error| self.refused(error))?;
        usize::try_from(claimed).map_err(external)
    }

    /// Hold so much more.
    pub fn take(&mut self, bytes: u64) -> Result<(), ParquetError> {
        self.budget.bytes.take(bytes).map_err(|error| self.refused(error))?;
        self.held += bytes;
        Ok(())
    }

    fn refused(&self, error: OutOfMemory) -> ParquetError {
        let (path, column) = (self.budget.path.clone(), self.column.clone());
        let OutOfMemory { needed: claimed, left, limit: budget } = error;
        external(ColumnsError::Memory { path, column, claimed, left, budget })
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        self.budget.bytes.give_back(self.held);
    }
}

/// An error on its way through the `parquet` crate.
pub fn external(error: impl std::error::Error + Send + Sync + 'static) -> ParquetError {
    ParquetError::External(Box::new(error))
}
