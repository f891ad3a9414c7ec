//! The paper's equations: coordinates and multipliers of all bars, solved together.

mod constraints;
mod indeterminate;
mod load;
pub(crate) mod mechanism;
pub(crate) mod multipliers;
mod newton;
mod point;
mod reduced;
mod relax;
mod rotation;
mod seed;
mod solution;
mod solve;
mod spectrum;
mod spin;
mod stability;
mod step;
pub(crate) mod system;

pub use constraints::{constraint_functions, constraint_matrix};
pub use load::load_vector;
pub use rotation::{direction, direction_gradient, direction_hessian, rotation};
pub use seed::Seed;
pub use solution::Solution;
pub use solve::{Converged, Solver, solve, solve_from};
pub use spectrum::{Spectrum, spectrum};
pub use spin::spin;
pub use system::{jacobian, relative_residual, residual};
