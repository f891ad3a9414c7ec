//! The census from outside, in one program.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking; so do its helpers")]

mod beside;
mod boxes;
mod compact;
mod completeness;
mod degenerate;
mod estimate;
mod figure;
mod integers;
mod mutations;
mod nets;
mod paper;
mod random;
mod ropes;
mod singular_families;
mod support;
mod systems;
mod tolerances;
mod unloaded;
mod work;
