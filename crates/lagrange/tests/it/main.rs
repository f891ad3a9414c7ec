//! The tests of the solver from outside, in one program.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking; so do its helpers")]

mod common;
mod condensed;
mod condensed_full;
mod condensed_processors;
mod condensed_random;
mod derivatives;
mod details;
mod equations;
mod extremes;
mod false_roots;
mod frames;
mod judge;
mod network;
mod network_derivatives;
mod network_floor;
mod network_forces;
mod network_members;
mod network_random;
mod network_runs;
mod network_work;
mod paper;
mod properties;
mod ropes;
mod scale;
mod seeds;
mod stability;
mod survey;
mod work;
