//! Tests of the crate from outside.

mod chains;
mod critical;
mod little_force;
mod net;
mod net_large;
mod net_members;
mod net_overdetermined;
mod net_random;
mod net_support;
mod net_work;
mod paper;
mod physics;
mod ropes;
mod scale;
mod settings;
mod support;
mod work;
