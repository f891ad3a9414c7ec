//! Bounds: true for whatever they are given, tight for the optimum.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

#[cfg(feature = "cones")]
mod cable;
#[cfg(feature = "sdp")]
mod semidefinite;
mod stress;
mod support;
