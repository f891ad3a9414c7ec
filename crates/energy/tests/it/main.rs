//! Tests of the crate from outside.

mod chains;
mod little_force;
mod network;
mod network_large;
mod network_members;
mod network_random;
mod network_support;
mod paper;
mod physics;
mod support;
