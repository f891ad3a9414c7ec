//! Branches over a parameter, seen from outside: what is found, and how a parameter is written.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod closed_forms;
mod degenerate;
mod diagram;
mod load;
mod parameters;
mod random_chains;
mod scale;
mod stops;
mod systems;
mod work;
