//! Equilibria of systems of bars and other members, positions first.
//!
//! The energy of a [`System`](model::system::System) is minimised over the places of its joints;
//! lengths of inextensible members are constraints, supports reduce the coordinates of their
//! joints, elastic members add their potential. Every force follows from the energy by virtual
//! work: the axial force of a member is the derivative of the least energy by its length, the
//! reaction of a support that by its place.
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
//! 2. The relaxation in which bars are cables is convex, and an interior point method solves it in
//!    about ten iterations whatever the size (`interior`). Where all bars pull in it, which is the
//!    rule in nets, bridles and hanging trees, its minimum is the global one of the system, by the
//!    convexity of every potential in the squared length.
//! 3. Bars that must push make the problem one without convexity. Newton's method on an augmented
//!    Lagrangian goes down from wherever it starts (`newton`); a shift keeps its matrix positive
//!    definite, and saddles are left along the lowest mode.
//! 4. Newton's method for places and forces together ends at rounding level.
//!
//! Where lengths overdetermine the shape the last step has a limit only without their misfits: see
//! `limit` and `share`.
//!
//! All four use one matrix: a block for every joint and for every pair of joints that a member
//! connects, symmetric and positive definite wherever it is used, with no rows for the multipliers.
//! It is eliminated with the joints in an order of little fill-in: O(n) for chains and
//! trees, about `n^1.5` for plane nets. The alternative, a matrix with a row for each multiplier,
//! is indefinite, a third larger for nets, and its factorisation must count signs; here positive
//! definite means stable.
//!
//! A rope over rings and pulleys has a rod for each strand and one excess, that of their sum: convex as
//! those of cables, so that all four steps take it as it is.
//!
//! # Cost
//!
//! Processor time of one core (AMD EPYC), by
//! `cargo run --release -p validate --example network_speed energy KIND n ...`:
//!
//! | kind | members | factorisations | time / s | µs a member |
//! |---|---|---|---|---|
//! | net of 32 x 32 joints | 1,984 | 13 | 0.04 | 20 |
//! | net of 100 x 100 | 19,800 | 14 | 0.51 | 26 |
//! | net of 200 x 200 | 79,600 | 16 | 3.4 | 43 |
//! | net of 316 x 316 | 199,080 | 16 | 11.4 | 57 |
//! | bridle of three strands | 300,000 | 7 | 1.3 | 4 |
//! | ten branchings | 999,999 | 8 | 5.2 | 5 |
//! | random tree, drawn by an earlier program | 1,000,000 | 6 | 6.9 | 7 |
//! | a chain | 1,000,000 | 7 | 4.9 | 5 |
//!
//! From 19,800 to 199,080 members of a net the time grows with the power 1.35 of their number.
//! Trees, chains and runs between branchings are eliminated with a constant number of entries a
//! joint, so time and memory are proportional to the number of members: a bridle took 16, 17 and 13
//! µs a member for 3,000, 30,000 and 300,000 of them in one run on a machine with other work. The
//! solver of chains, which turns bars instead of moving joints, is 10 to 15 times as fast for the
//! same chain.
//!
//! Nested dissection (halves by the difference of the numbers of members from two far joints) was
//! held against approximate minimum degree for nets of 100 x 100, 200 x 200 and 316 x 316: 0.56 to
//! 0.51 s, 3.5 to 3.5 s, 11.3 to 11.4 s. It is not used.

mod balance;
mod component;
mod critical;
mod factor;
mod frame;
mod interior;
mod jam;
mod law;
mod limit;
mod minimise;
mod near;
mod newton;
mod polish;
mod settings;
mod shape;
mod share;
mod solution;
mod stability;
mod start;
mod weak;
mod work;

pub use crate::error::Error;
pub use critical::{Critical, critical};
pub use minimise::{minimise, minimise_from, minimise_near};
pub use settings::Settings;
pub use solution::{Forces, Solution, Work};
