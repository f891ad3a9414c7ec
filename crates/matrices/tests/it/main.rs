//! Factorisations, kernels and eigenvalues against what defines them.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod dense;
mod sparse;
