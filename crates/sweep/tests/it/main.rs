//! Sweeps on disk, seen from outside.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod made_up;
mod merge;
mod resume;
mod store;
