//! How much a minimisation may cost.
//!
//! Restarts, stiffer springs and iterations multiply. What takes the time in each of them are
//! factorisations, so the numbers in all factors together are the measure, whatever the machine.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

use crate::error::Error;

/// The meter of one minimisation: copies of it run together.
#[derive(Debug, Clone, Default)]
pub(super) struct Meter {
    read: Arc<AtomicU64>,
    /// Whether a factor was not computed for want of work: nothing that follows is a finding.
    refused: Arc<AtomicBool>,
    /// The end of it; nothing without a limit.
    end: Option<u64>,
}

impl Meter {
    pub(super) fn until(end: u64) -> Self {
        Self { end: Some(end), ..Self::default() }
    }

    /// Whether a factor of this size may be computed: asked before each, wherever it is needed, so
    /// that no loop goes on without work.
    pub(super) fn take(&self, numbers: usize) -> bool {
        let left = self.check().is_ok();
        if left {
            self.read.fetch_add(numbers as u64, Relaxed);
        } else {
            self.refused.store(true, Relaxed);
        }
        left
    }

    /// Asked before each iteration: those without a factor would not end by their work.
    /// [`Error::Work`] when the end is reached.
    pub(super) fn check(&self) -> Result<(), Error> {
        let spent = self.read.load(Relaxed);
        match self.end {
            Some(max_work) if spent >= max_work => Err(Error::Work { spent, max_work }),
            _ => Ok(()),
        }
    }

    /// What a minimisation ends with: neither an answer for which a factor was refused nor an error
    /// once the work is spent is a finding.
    pub(super) fn judged<T>(&self, result: Result<T, Error>) -> Result<T, Error> {
        if result.is_err() || self.refused.load(Relaxed) {
            self.check()?;
        }
        result
    }
}
