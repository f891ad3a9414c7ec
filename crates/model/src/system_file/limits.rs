//! How large a system may be.

/// Most bars of one system: what an answer over so many joints still leaves of 24 GB of memory.
pub const MAX_BARS: usize = 20_000_000;

/// Longest system file, bytes: a hundred thousand bars written one by one need a tenth of it.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

/// Longest bars file, bytes: a hundred for each bar, and three numbers of 17 digits with exponents
/// need about 75.
pub const MAX_BARS_FILE_BYTES: u64 = 100 * MAX_BARS as u64;
