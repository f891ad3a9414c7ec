//! What most programs need: `use funicular::prelude::*;`.

pub use model::system::{Joint, Kind, Member, Support, System};
pub use model::{Anchors, Bar, Chain, Equilibrium, Rung, SolverName, Vector};
pub use validate::answer::{Equations, Solvers, UseCensus};

pub use crate::census::Census;
pub use crate::error::Error;
pub use crate::problem::Problem;
pub use crate::solve::Solve;
pub use crate::system::SystemSolution;
