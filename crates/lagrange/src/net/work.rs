//! The budget of work of a solve: entries of all sparse factors that it computes.
//!
//! Every loop of a solve factorises, and its bounds multiply: starts, rounds, changes of sign,
//! steps. One count over all of them ends a solve after the same step on every machine.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::error::Error;

/// What a solve has spent, of what it may spend; shared by all frameworks made for it.
#[derive(Debug, Clone)]
pub(super) struct Work {
    spent: Arc<AtomicU64>,
    /// Whether a factor was refused: nothing that follows is a finding.
    refused: Arc<AtomicBool>,
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
        Self { spent: Arc::default(), refused: Arc::default(), most }
    }

    /// Whether a factor with so many entries may be computed; it is counted then. Asked before each,
    /// so that no loop goes on without work.
    pub fn spend(&self, entries: usize) -> bool {
        let left = !self.is_spent();
        if left {
            self.spent.fetch_add(entries as u64, Ordering::Relaxed);
        } else {
            self.refused.store(true, Ordering::Relaxed);
        }
        left
    }

    /// Whether a factor was refused.
    pub fn is_refused(&self) -> bool {
        self.refused.load(Ordering::Relaxed)
    }

    /// Whether no further factorisation ought to begin.
    pub fn is_spent(&self) -> bool {
        self.spent.load(Ordering::Relaxed) >= self.most
    }

    /// What a solve ends with: neither an answer for which a factor was refused nor an error once the
    /// work is spent is a finding.
    pub fn judged<T>(&self, result: Result<T, Error>) -> Result<T, Error> {
        if self.is_refused() || (result.is_err() && self.is_spent()) {
            return Err(self.ended());
        }
        result
    }

    /// Nothing more, once a factor was refused: also what needs none takes time.
    pub fn goes_on(&self) -> Result<(), Error> {
        if self.is_refused() { Err(self.ended()) } else { Ok(()) }
    }

    fn ended(&self) -> Error {
        Error::Work { spent: self.spent.load(Ordering::Relaxed), max_work: self.most }
    }
}
