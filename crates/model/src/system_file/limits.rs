//! How large a system may be.

use crate::budget::{memory, set_memory};

/// Most bars of one system: what an answer over so many joints still leaves of 24 GB of memory.
pub const MAX_BARS: usize = 20_000_000;

/// Longest system file, bytes: a hundred thousand bars written one by one need a tenth of it.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

/// Longest bars file, bytes: a hundred for each bar, and three numbers of 17 digits with exponents
/// need about 75.
pub const MAX_BARS_FILE_BYTES: u64 = 100 * MAX_BARS as u64;

/// Memory that a bar of a chain needs, from its file to the answers of both solvers, bytes, where it is one of
/// a `count`: 370 are measured of a million.
pub const BYTES_PER_BAR: u64 = 400;

/// The same where bars are in a file of their own, each with its numbers: 550 are measured of a million.
pub const BYTES_PER_BAR_OF_FILE: u64 = 640;

/// Memory that a byte of a system file needs while it is parsed, bytes: at most 67 are measured, of
/// a file of empty arrays (48 of one of empty lines).
pub const BYTES_PER_FILE_BYTE: u64 = 80;

/// Hold all readers of this process to what fits into so much memory, bytes: files longer than a
/// [`BYTES_PER_FILE_BYTE`]-th of it, chains of more bars than a [`BYTES_PER_BAR`]-th (of a file of bars a
/// [`BYTES_PER_BAR_OF_FILE`]-th), and other systems
/// of more members than a [`BYTES_PER_MEMBER`]-th, rows of rigid bars of more than a
/// [`BYTES_PER_MEMBER_IN_ROW`]-th, are refused where the file says so, before they are
/// made. Never more than [`MAX_FILE_BYTES`], [`MAX_BARS`] and
/// [`MAX_MEMORY`](crate::budget::MAX_MEMORY), which hold until this is called.
///
/// [`BYTES_PER_MEMBER`]: crate::budget::BYTES_PER_MEMBER
/// [`BYTES_PER_MEMBER_IN_ROW`]: crate::budget::BYTES_PER_MEMBER_IN_ROW
///
/// ```standalone_crate
/// use model::system_file::{limit_memory, parse};
/// limit_memory(400_000);
/// let chain = |count| format!(
///     "anchors = {{ start_m = [0, 0, 0], end_m = [0, 0, -1] }}\n\
///      [[bars]]\nlength_m = 1\nmass_kg = 1\ncount = {count}\n"
/// );
/// assert!(parse(&chain(1000), "chain.toml").is_ok());
/// let error = parse(&chain(1001), "chain.toml").unwrap_err();
/// assert!(error.to_string().starts_with("chain.toml:5:9: bars[1].count"), "{error}");
/// ```
pub fn limit_memory(bytes: u64) {
    set_memory(bytes);
}

/// Most bars of one system, as [`limit_memory`] has it.
pub fn most_bars() -> usize {
    usize::try_from(memory() / BYTES_PER_BAR).unwrap_or(usize::MAX).min(MAX_BARS)
}

/// Most bars of a file of bars, as [`limit_memory`] has it.
pub fn most_bars_of_file() -> usize {
    usize::try_from(memory() / BYTES_PER_BAR_OF_FILE).unwrap_or(usize::MAX).min(MAX_BARS)
}

/// Longest system file, bytes, as [`limit_memory`] has it.
pub fn most_file_bytes() -> u64 {
    (memory() / BYTES_PER_FILE_BYTE).min(MAX_FILE_BYTES)
}

/// Longest file of bars or joints, bytes: what is read of it stays in memory beside its text.
pub(super) fn most_bars_file_bytes() -> u64 {
    memory().min(MAX_BARS_FILE_BYTES)
}
