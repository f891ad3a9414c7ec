//! Equilibria of hanging chains of bars, energy first: section VIII, Solution 1 of the paper, for
//! any number of bars in space.
//!
//! A chain comes to rest where its potential energy is least. The energy is linear in the
//! directions `u_i` of the bars; that the chain ends at its anchor is one vector equation, the
//! closure. This crate minimises the one subject to the other, and gets every force from the
//! energy: the reaction of an anchor is the derivative of the least energy by its place.
//!
//! | paper | code | unit | equation |
//! |---|---|---|---|
//! | `l_i`, `m_i`, `r_i` | `length_m`, `mass_kg`, `centre_m` of `model::Bar` | m, kg, m | section II |
//! | first column of `[A_i]` | `u`, `directions` | - | (5) |
//! | `V` | [`potential_j`], `energy_j` (from joint 0) | J | (v) |
//! | `V / mgl` | [`example::potential`] (6 more) | `mgl` | (vi) |
//! | - | `hang`, `h_i`: weight hanging on bar *i*, less one half | total weight | (v), see `links` |
//! | `sum l_i u_i = D` | `closure`, `gap` | total length | (i), (ii) |
//! | `theta, alpha, beta` | `theta_rad`, `alpha_rad`, `beta_rad` | rad | (i)-(iv) |
//! | (viii) | [`example::quadratic`], [`example::candidates`] | - | (viii) |
//! | (ix), (x) | [`example::scan`] | deg, `mgl` | (ix), (x) |
//! | - | `mu`, `multiplier` of the closure | total weight | - |
//! | `lambda_1..3(n+1)` | `multipliers_n` | N | (40); here by virtual work |
//! | - | `axial`, `N_i`: second derivative by a turn of bar *i*; its axial force | total weight | - |
//!
//! # The method
//!
//! On the closed chains, with the metric `sum l_i |du_i|²`, the projected gradient has the parts
//! `t_i = (I - u_i u_iᵀ)(h_i up + mu)` and the Hessian is the axial force `N_i` times the identity,
//! bar by bar, projected on the three rows of the closure. One pass over the bars eliminates them;
//! what remains has size three (four about vertical anchors, where the turn of the whole chain is
//! taken out). So an iteration costs O(n), and so do the inertia, the Morse index, and the way out
//! of a saddle. Iterates are closed chains, the energy never rises beyond its rounding, and the
//! stop is on the projected gradient and the closure alone. `Ok` means converged to a local
//! minimum; in space that is the global one.
//!
//! From no guess a long chain is first solved with its bars held parallel in groups of eight, and
//! so on down to two dozen bars that start from a circular arc: restricted to such shapes the
//! energy and the closure are those of a shorter chain. Three or four iterations on the chain
//! itself are left. Where a deep chain bends within a few bars the bars around the bend are
//! minimised by themselves first, their ends held.
//!
//! argmin (`Executor`, `CostFunction`, `Gradient`, `Hessian`, `Operator`, `Solver`, `IterState`)
//! runs the minimisation. The `Solver` is ours: argmin has none for constrained problems, and its
//! unconstrained ones cannot use a Hessian that is diagonal plus three rows.
//!
//! Up to which *n* does it keep up? The time is linear in *n* as far as memory goes: nothing is
//! stored but a few vectors of length *n*, and the number of iterations on the chain itself does
//! not grow. `cargo run --release -p energy --example energy_speed` shows it up to a million bars.
//! A pass over the bars costs a square root and a division per bar, and an iteration takes about
//! five passes (system, step, two or three corrections of the closure); a method with three
//! unknowns instead of 2 n needs one pass and stays ahead by that factor and by the coarser chains.
//! A chain drawn out along one line, nearly taut or hanging as two strands side by side, is closed
//! by the balance of its slack with what the bars lose by their angles to that line, and keeps its
//! digits down to the slack of the tautest chain that is a problem; the forces along the line then
//! hold to a rounding over those angles, and the evidence says so where that is much. See
//! [`SecondOrder::condition`] and [`Evidence`](model::Evidence)`::nullity`.
//!
//! # Why some formulas are also in `lagrange`
//!
//! The two solvers share data types and nothing else. Weights hanging on a bar, joint forces, axial
//! forces appear in both, derived and written twice on purpose: that two programs which share no
//! mechanics agree to the last digits is the experiment of this project. Do not deduplicate them.

mod bend;
mod closure;
mod coarse;
mod convergence;
mod curvature;
mod error;
mod folded;
mod frame;
mod lever;
mod links;
mod minimise;
mod objective;
mod plane;
mod potential;
mod reaction;
mod refine;
mod regime;
mod seed;
mod settings;
mod slope;
mod solution;
mod solver;
mod stability;
mod start;
mod strands;
mod symmetric;
mod vector;

#[cfg(test)]
mod twins;

pub mod batch;
pub mod example;
pub mod network;

pub use error::Error;
pub use minimise::{minimise, minimise_from};
pub use potential::potential_j;
pub use reaction::reaction_by_differences;
pub use regime::{Reach, Regime, Turning};
pub use seed::Seed;
pub use settings::{Motion, Settings};
pub use solution::{Solution, Work};
pub use stability::{SecondOrder, second_order};
