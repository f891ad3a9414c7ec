//! The census from outside, in one program.

mod compact;
mod completeness;
mod degenerate;
mod estimate;
mod figure;
mod integers;
mod multiplicity;
mod mutations;
mod paper;
mod random;
mod singular_families;
mod support;
mod unloaded;
mod work;
