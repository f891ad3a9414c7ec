//! Equilibria of hanging chains of bars, forces first: sections II-IV and VII of the paper.
//!
//! The unknowns are the paper's own. Each of n bars has six coordinates, eq. (21); each of the n + 1
//! joints has three constraint functions, eqs. (7)-(20), and three multipliers. Equation (40) and the
//! constraint functions are 6n + 3(n+1) equations for as many unknowns (30 for three bars), and every
//! equilibrium, stable or not, solves them:
//!
//! $$ -\mathbf{B}^T\\{\lambda\\} = \mathbf{T}, \qquad \\{f\\} = 0. $$
//!
//! | paper | code | shape | unit | equation |
//! |---|---|---|---|---|
//! | $\mathbf{A}_i$ | [`rotation`](rotation()) | 3 × 3 | 1 | (1)-(5) |
//! | $u_i = \mathbf{A}_ie_x$ | [`direction`] | 3 | 1 | (6), (10) |
//! | $\partial u_i/\partial(\psi_i, \theta_i, \varphi_i)$ | [`direction_gradient`] | 3 × 3 | 1/rad | (22) |
//! | $\psi_i, \theta_i, \varphi_i$ | [`Seed`], [`Solution::angles_rad`] | 3 per bar | rad | section II |
//! | $\\{q\\}$ | `q` | 6n | m, rad | (21) |
//! | $f_i$ | [`constraint_functions`] | 3(n+1) | m | (7)-(20) |
//! | $\mathbf{B}$ | [`constraint_matrix`] | 3(n+1) × 6n | 1, m/rad | (22) |
//! | $\mathbf{T}$ | [`load_vector`] | 6n | N | (41) |
//! | $\\{\lambda\\}$ | `lambda` | 3(n+1) | N | (33), (40) |
//! | (40) with (7)-(20) | [`residual`] | 6n + 3(n+1) | N, N m, m | (40) |
//! | its derivative | [`jacobian`] | square | mixed | |
//! | spin about $C_i x_i$ | [`spin`](spin()) | 3 | 1 | section III, (23) |
//! | $F_i = p_0 + c_i e_z$ | `force` | 3 per bar | N | sum of (40) over bars 1..i |
//!
//! # The method
//!
//! Everything affine is eliminated exactly, which leaves 3n angles and the first pull (module
//! `point`). Their matrix is singular at every solution; module `step` treats it, and nothing else
//! does. Module `newton` makes the method global; module `relax` helps where the residual has local
//! minima that are no roots; module `spin` says where the paper's coordinates lose a moment balance
//! and with it admit false roots, and how they are avoided. [`StepMethod::Dense`] does the same on
//! the full matrix with a singular value decomposition, to be read and to be compared.
//!
//! # Independence
//!
//! The crate `energy` answers the same question from the potential energy. Neither crate may use the
//! other, nor share so much as a helper: that they agree is the evidence, so formulas that stand in
//! both (a direction from angles, a sum of weights) stand there twice on purpose.

pub mod batch;
pub mod condensed;
mod constraints;
mod dense;
mod effort;
mod error;
mod indeterminate;
mod load;
mod mechanism;
mod multipliers;
pub mod network;
mod newton;
mod point;
mod reduced;
mod relax;
mod rotation;
mod seed;
mod settings;
mod solution;
mod solve;
mod spectrum;
mod spin;
mod stability;
mod step;
mod system;
mod thresholds;

pub use constraints::{constraint_functions, constraint_matrix};
pub use effort::Effort;
pub use error::SolveError;
pub use load::load_vector;
pub use rotation::{direction, direction_gradient, direction_hessian, rotation};
pub use seed::Seed;
pub use settings::{Settings, SettingsError, StepMethod};
pub use solution::Solution;
pub use solve::{Converged, Solver, solve, solve_from};
pub use spectrum::{Spectrum, spectrum};
pub use spin::spin;
pub use system::{jacobian, relative_residual, residual};
