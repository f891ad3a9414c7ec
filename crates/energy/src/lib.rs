//! Under construction.

pub mod bound;
