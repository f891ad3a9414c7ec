//! How much a minimisation may cost.
//!
//! Restarts, stiffer springs and iterations multiply. What takes the time in each of them are
//! factorisations, so the numbers in all factors together are the measure, whatever the machine.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use crate::network::error::Error;

/// The meter of one minimisation: copies of it run together.
#[derive(Debug, Clone, Default)]
pub(super) struct Meter {
    read: Arc<AtomicU64>,
    /// The end of it; nothing without a limit.
    end: Option<u64>,
}

impl Meter {
    pub(super) fn until(end: u64) -> Self {
        Self { end: Some(end), ..Self::default() }
    }

    /// A factor of this size is computed.
    pub(super) fn count(&self, numbers: usize) {
        self.read.fetch_add(numbers as u64, Relaxed);
    }

    /// Asked before each iteration.
    ///
    /// # Errors
    ///
    /// [`Error::Work`] when the end is reached.
    pub(super) fn check(&self) -> Result<(), Error> {
        let spent = self.read.load(Relaxed);
        match self.end {
            Some(max_work) if spent >= max_work => Err(Error::Work { spent, max_work }),
            _ => Ok(()),
        }
    }
}
