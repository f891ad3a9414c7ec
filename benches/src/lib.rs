//! Systems for the benches.
