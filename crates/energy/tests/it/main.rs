//! Tests of the crate from outside.

mod chains;
mod paper;
mod physics;
mod support;
