//! Chains between two anchors: the closed chains of least energy, bar by bar.

mod closure;
mod coarse;
mod convergence;
mod curvature;
mod frame;
mod idle_bars;
mod minimise;
mod reaction;
mod refine;
mod regime;
mod scaled_chain;
mod seed;
mod settings;
mod sharp_bend;
mod slope;
mod solution;
mod solver;
mod stability;
mod start;
mod straight_fold;
mod symmetric;
mod vertical_plane;

#[cfg(test)]
mod derivative_tests;

pub use minimise::{minimise, minimise_from};
pub use reaction::reaction_by_differences;
pub use seed::Seed;
pub use settings::{Motion, Settings};
pub use solution::{Solution, Work};
pub use stability::{SecondOrder, second_order};
