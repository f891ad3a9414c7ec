//! Columns on disk, seen from outside.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

#[cfg(unix)]
mod atomic;
mod bars;
mod files;
mod memory;
mod notes;
mod rows;
mod tables;
