//! How much memory what is read from outside may come to need, and how much work a solve may do.
//!
//! Every reader asks its budget before what it holds grows by the word of a file: a count, a number
//! of segments, the size of a page. Nothing is made that was not granted.

use std::num::NonZeroU64;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::system::System;

/// Memory of a process where no limit is set, bytes: that of a machine that answers 20 million bars.
pub const MAX_MEMORY: u64 = 24_000_000_000;

static MEMORY: AtomicU64 = AtomicU64::new(MAX_MEMORY);

/// Hold all readers of this process to so much memory, bytes: what [`limit_memory`] is called with,
/// at most [`MAX_MEMORY`].
///
/// [`limit_memory`]: crate::system_file::limit_memory
pub(crate) fn set_memory(bytes: u64) {
    MEMORY.store(bytes.min(MAX_MEMORY), Ordering::Relaxed);
}

/// Memory that readers of this process may ask for, bytes.
pub(crate) fn memory() -> u64 {
    MEMORY.load(Ordering::Relaxed)
}

/// Work of one solve where no limit is set: numbers in all factors of its matrices, up to an hour or so.
static WORK: AtomicU64 = AtomicU64::new(10_000_000_000);

/// Hold every solve of this process, whoever asks for it, to so much work, numbers in all factors of
/// its matrices: what the settings of both solvers have where they are not told otherwise.
///
/// ```standalone_crate
/// # use std::num::NonZeroU64;
/// assert_eq!(model::budget::max_work(), 10_000_000_000);
/// model::budget::limit_work(NonZeroU64::MIN);
/// assert_eq!(model::budget::max_work(), 1);
/// ```
pub fn limit_work(numbers: NonZeroU64) {
    WORK.store(numbers.get(), Ordering::Relaxed);
}

/// Work that a solve of this process may do, as [`limit_work`] has it.
pub fn max_work() -> u64 {
    WORK.load(Ordering::Relaxed)
}

/// The memory that one system, answer or table of columns may come to need.
///
/// ```
/// use model::budget::Budget;
/// let budget = Budget::new(1000);
/// assert_eq!(budget.take(700), Ok(()));
/// let refused = budget.take(301).unwrap_err();
/// assert_eq!(refused.to_string(), "301 bytes of memory are needed; of 1000, 300 are left");
/// budget.give_back(1);
/// assert_eq!(budget.take(301), Ok(()));
/// ```
#[derive(Debug)]
pub struct Budget {
    limit: u64,
    held: AtomicU64,
    /// What of that is for members.
    members: AtomicU64,
}

/// Occurs when more memory is needed than the budget has left.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{needed} bytes of memory are needed; of {limit}, {left} are left")]
pub struct OutOfMemory {
    /// What is needed, bytes.
    pub needed: u64,
    /// What is left of the budget, bytes.
    pub left: u64,
    /// The whole budget, bytes.
    pub limit: u64,
}

impl Default for Budget {
    /// All memory that readers of this process may ask for.
    fn default() -> Self {
        Self::new(memory())
    }
}

impl Budget {
    /// So many bytes.
    pub const fn new(limit: u64) -> Self {
        Self { limit, held: AtomicU64::new(0), members: AtomicU64::new(0) }
    }

    /// What is left, bytes.
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.held.load(Ordering::Relaxed))
    }

    /// Whether there is room for so many bytes more.
    ///
    /// # Errors
    /// [`OutOfMemory`] if there is not.
    pub fn fits(&self, bytes: u64) -> Result<(), OutOfMemory> {
        let left = self.left();
        if bytes <= left {
            return Ok(());
        }
        Err(OutOfMemory { needed: bytes, left, limit: self.limit })
    }

    /// Hold so many bytes more.
    ///
    /// # Errors
    /// [`OutOfMemory`] if there is no room for them.
    pub fn take(&self, bytes: u64) -> Result<(), OutOfMemory> {
        self.fits(bytes)?;
        self.held.fetch_add(bytes, Ordering::Relaxed);
        Ok(())
    }

    /// Hold so many bytes less.
    pub fn give_back(&self, bytes: u64) {
        self.held.fetch_sub(bytes, Ordering::Relaxed);
    }

    /// Hold so many members more, each with its joint, as they are read.
    ///
    /// # Errors
    /// [`OutOfMemory`] if there is no room for them.
    pub fn take_members(&self, count: usize) -> Result<(), OutOfMemory> {
        self.take_for_members(count, BYTES_PER_MEMBER_READ)
    }

    /// Hold so many equal members more, each with a joint that differs from the others in its name alone.
    ///
    /// # Errors
    /// [`OutOfMemory`] if there is no room for them.
    pub fn take_equal_members(&self, count: usize) -> Result<(), OutOfMemory> {
        self.take_for_members(count, BYTES_PER_EQUAL_MEMBER_READ)
    }

    fn take_for_members(&self, count: usize, each: u64) -> Result<(), OutOfMemory> {
        let bytes = (count as u64).saturating_mul(each);
        self.take(bytes)?;
        self.members.fetch_add(bytes, Ordering::Relaxed);
        Ok(())
    }

    /// Hold names of so many joints more, of so many bytes each.
    ///
    /// # Errors
    /// [`OutOfMemory`] if there is no room for them.
    pub fn take_names(&self, count: usize, name_bytes: usize) -> Result<(), OutOfMemory> {
        let copies = (name_bytes as u64).saturating_mul(COPIES);
        self.take((count as u64).saturating_mul(copies))
    }

    /// Whether there is room for what both solvers need beside the system that was read.
    ///
    /// # Errors
    /// [`OutOfMemory`] if there is not.
    pub fn fits_solve(&self, system: &System) -> Result<(), OutOfMemory> {
        let each = if system.is_row() { BYTES_PER_MEMBER_IN_ROW } else { BYTES_PER_MEMBER };
        let all = (system.members().len() as u64).saturating_mul(each);
        self.fits(all.saturating_sub(self.members.load(Ordering::Relaxed)))
    }

    /// Whether there is room for so many members of so many bytes each.
    ///
    /// # Errors
    /// [`OutOfMemory`] if there is not.
    pub fn fits_members(&self, count: usize, each: u64) -> Result<(), OutOfMemory> {
        self.fits((count as u64).saturating_mul(each))
    }
}

/// Memory that a member of a system and its joint need while they are read, bytes, each with numbers of its
/// own: 600 are measured in a tree of a hundred thousand, 285 in a net of as many.
pub const BYTES_PER_MEMBER_READ: u64 = 640;

/// The same of members in a row that are equal, and of the joints between them, which share their numbers:
/// 135 are measured of a million.
pub const BYTES_PER_EQUAL_MEMBER_READ: u64 = 175;

/// The same from the file to the answers of both solvers, of a row of rigid bars between two anchors:
/// 395 are measured of a million.
pub const BYTES_PER_MEMBER_IN_ROW: u64 = 400;

/// The same in other systems, and of any where it moves, is varied or has derivatives: 2,950 in a row of
/// elastic cables, 3,450 in trees and bridles, 4,400 in a row in motion, and 4,700 in a net of 40,000 cables
/// are measured.
pub const BYTES_PER_MEMBER: u64 = 5_000;

/// The same from the file to the modes of oscillation, beside [`BYTES_PER_MODE`]: 5,800 with one mode are
/// measured in a row of a hundred thousand bars, and 6,800 with 20.
pub const BYTES_PER_MEMBER_IN_MODES: u64 = 7_000;

/// What each mode that is asked for adds to a member, bytes.
pub const BYTES_PER_MODE: u64 = 100;

/// Copies of a name, from its file to the answer: by which it is found while the file is read, and that of the
/// system, which its answers share. A name of a row is put together when it is printed.
const COPIES: u64 = 2;
