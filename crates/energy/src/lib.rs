//! Equilibria of hanging chains of bars, energy first.

mod closure;
mod coarse;
mod curvature;
mod error;
mod frame;
mod hanging;
mod links;
mod minimise;
mod plane;
mod potential;
mod reaction;
mod seed;
mod settings;
mod slope;
mod solution;
mod solver;
mod stability;
mod start;
mod straight;
mod symmetric;
mod vector;

pub mod bound;

pub use error::Error;
pub use minimise::{minimise, minimise_from};
pub use potential::potential_j;
pub use reaction::reaction_by_differences;
pub use seed::Seed;
pub use settings::{Motion, Settings};
pub use solution::{Solution, Work};
pub use stability::{SecondOrder, second_order};
