//! Under construction.

pub mod condensed;
