//! Tests of the crate from outside.

mod chains;
mod conditions;
mod critical;
mod little_force;
mod network;
mod network_large;
mod network_members;
mod network_overdetermined;
mod network_random;
mod network_support;
mod network_work;
mod paper;
mod physics;
mod ropes;
mod scale;
mod settings;
mod support;
mod work;
