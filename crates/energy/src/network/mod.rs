//! Equilibria of systems of bars and other members, positions first.
//!
//! The energy of a [`System`](model::system::System) is minimised over the places of its joints; lengths of
//! inextensible members are constraints, supports reduce the coordinates of their joints, elastic members
//! add their potential. Every force follows from the energy by virtual work: the axial force of a member is the
//! derivative of the least energy by its length, the reaction of a support that by its place.
//!
//! | symbol | code | meaning | unit inside |
//! |---|---|---|---|
//! | `x` | `Shape::x` | places of the joints | longest member |
//! | `F` | `Shape::force` | axial forces, tension positive: multipliers of the lengths | sum of the loads |
//! | `c`, `J` | `Excess` | excess length and its gradient, see `law` | longest member |
//! | `phi` | `Rod::flexibility` | elongation by a unit force | |
//! | `kappa` | `stiffness / length` | springs of the augmented Lagrangian | |
//!
//! # The method, and why it is this one
//!
//! 1. Force densities give a start in which all members pull (`start`).
//! 2. The relaxation in which bars are cables is convex, and an interior point method solves it in about ten
//!    iterations whatever the size (`interior`). Where all bars pull in it, which is the rule in nets, bridles
//!    and hanging trees, its minimum is the global one of the system, by the convexity of every
//!    potential in the squared length.
//! 3. Bars that must push make the problem one without convexity. Newton's method on an augmented Lagrangian
//!    goes down from wherever it starts (`newton`); a shift keeps its matrix positive definite, and saddles are
//!    left along the lowest mode.
//! 4. Newton's method for places and forces together ends at rounding level.
//!
//! All four use one matrix: a block for every joint and for every pair of joints that a member connects,
//! symmetric and positive definite wherever it is used, with no rows for the multipliers. It is eliminated
//! with the joints in an order of least fill-in by faer: O(n) for chains and trees, about `n^1.5` for plane
//! nets. The alternative, a matrix with a row for each multiplier, is indefinite, a third larger for nets, and
//! its factorisation must count signs; here positive definite means stable.

mod component;
mod error;
mod factor;
mod frame;
mod interior;
mod law;
mod minimise;
mod newton;
mod polish;
mod potential;
mod settings;
mod shape;
mod solution;
mod stability;
mod start;

pub use error::Error;
pub use minimise::{minimise, minimise_from};
pub use settings::Settings;
pub use solution::{Forces, Solution, Work};
pub use stability::Rigidity;
