//! What most programs need: `use funicular::prelude::*;`.

pub use model::system::{Joint, Kind, Member, Support, System};
pub use model::{Anchors, Bar, Chain, Equilibrium, Rung, SolverName, Vector};
pub use validate::answer::{Equations, Solvers, UseCensus};

#[cfg(feature = "sweep")]
pub use crate::basins::Basins;
pub use crate::census::Census;
pub use crate::compare::compare;
#[cfg(feature = "branches")]
pub use crate::derivatives::Derivatives;
#[cfg(feature = "sweep")]
pub use crate::ensemble::Ensemble;
pub use crate::error::Error;
pub use crate::judge::Judge;
pub use crate::modes::Modes;
pub use crate::problem::Problem;
#[cfg(feature = "paper")]
pub use crate::reproduce::Reproduce;
pub use crate::simulate::{Simulate, Start};
pub use crate::solution::Solution;
pub use crate::solve::Solve;
#[cfg(feature = "branches")]
pub use crate::study::Study;
#[cfg(feature = "sweep")]
pub use crate::sweep::{Spread, Sweep};
pub use crate::system::SystemSolution;
#[cfg(feature = "branches")]
pub use crate::trace::Trace;
