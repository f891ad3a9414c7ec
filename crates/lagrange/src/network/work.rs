//! The budget of work of a solve: entries of all sparse factors that it computes.
//!
//! Every loop of a solve factorises, and its bounds multiply: starts, rounds, changes of sign,
//! steps. One count over all of them ends a solve after the same step on every machine.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::error::Error;

/// What a solve has spent, of what it may spend; shared by all frameworks made for it.
#[derive(Debug, Clone)]
pub(super) struct Work {
    spent: Arc<AtomicU64>,
    most: u64,
}

impl Default for Work {
    /// Without a limit.
    fn default() -> Self {
        Self::new(u64::MAX)
    }
}

impl Work {
    pub fn new(most: u64) -> Self {
        Self { spent: Arc::default(), most }
    }

    /// Count a factorisation with so many entries.
    pub fn spend(&self, entries: usize) {
        self.spent.fetch_add(entries as u64, Ordering::Relaxed);
    }

    /// Whether no further factorisation ought to begin.
    pub fn is_spent(&self) -> bool {
        self.spent.load(Ordering::Relaxed) >= self.most
    }

    /// A solve that ended without an answer because its work was spent says so: what it was at is
    /// no finding.
    pub fn judged<T>(&self, result: Result<T, Error>) -> Result<T, Error> {
        match result {
            Err(_) if self.is_spent() => {
                let spent = self.spent.load(Ordering::Relaxed);
                Err(Error::Work { spent, max_work: self.most })
            }
            result => result,
        }
    }
}
