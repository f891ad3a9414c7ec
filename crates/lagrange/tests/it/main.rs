//! The tests of the solver from outside, in one program.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking; so do its helpers")]

mod common;
mod condensed;
mod condensed_processors;
mod condensed_random;
mod derivatives;
mod details;
mod equations;
mod extremes;
mod false_roots;
mod frames;
mod judge;
mod net;
mod net_derivatives;
mod net_floor;
mod net_forces;
mod net_members;
mod net_random;
mod net_runs;
mod net_work;
mod paper;
mod properties;
mod ropes;
mod scale;
mod seeds;
mod stability;
mod survey;
mod work;
