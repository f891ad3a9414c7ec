//! Drawings of structures, seen from outside.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod structure;
