//! What most programs need: `use funicular::prelude::*;`.

pub use model::system::{Joint, Kind, Member, Support, System, SystemEquilibrium};
pub use model::{Anchors, Bar, Chain, Rung, SolverName, Vector};
pub use validate::{Equations, Solvers, UseCensus};

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
pub use crate::solve::{Solve, SolveAnswer};
#[cfg(feature = "branches")]
pub use crate::study::Study;
#[cfg(feature = "sweep")]
pub use crate::sweep::{Spread, Sweep};
#[cfg(feature = "branches")]
pub use crate::trace::Trace;
