//! Equilibria of any system of members, forces first.
//!
//! A [`System`](model::system::System) is a framework: its weights and loads act at the joints by
//! the lever rule, and a member is a law of elongation from force. The hanging shape follows from
//! the least complementary energy over the forces in balance; Newton's method on places and forces
//! then brings any equilibrium, stable or not, to rounding.
//!
//! What a system has of structure is used first, and decides what a solve costs:
//!
//! | part | treated as | cost |
//! |---|---|---|
//! | a dangling tree | nothing: each member bears the load below it (`runs`) | O(n) |
//! | a run of members between branchings | one element, its pull and a 3 x 3 derivative (`elements`) | O(n) a step, a matrix of the branchings alone |
//! | a net | a sparse matrix over the joints, minimum degree first (`order`) | the factor of a planar graph |
//!
//! Processor's time of one solve on one core of a server, as
//! `cargo run --release -p lagrange --example network_solve_speed -- net 32 50 71 100 141 200 316`
//! and the same with `bridle 10000 100000` and `tree 100000 1000000` print it:
//!
//! | system | members | factorisations | time |
//! |---|---|---|---|
//! | net of rigid bars, hung from four corners | 1,984 | 16 | 0.04 s |
//! | | 4,900 | 17 | 0.09 s |
//! | | 9,940 | 18 | 0.28 s |
//! | | 19,800 | 20 | 0.75 s |
//! | | 39,480 | 22 | 1.8 s |
//! | | 79,600 | 27 | 5.4 s |
//! | | 199,080 | 30 | 20 s |
//! | three strands to one joint | 30,000 | 7 | 0.01 s |
//! | | 300,000 | 7 | 0.19 s |
//! | dangling tree | 100,000 | 1 | 0.08 s |
//! | | 1,000,000 | 1 | 0.86 s |
//!
//! From 4,900 to 79,600 members of nets that is n to the power 1.47; the elimination alone has 1.5.
//!
//! [`Derivatives`] of an answer by lengths, masses, stiffnesses, loads and anchors come from one
//! more factorisation; where the forces are one family [`force_ranges`] says how far each of them
//! is open.
//!
//! | symbol | code | meaning |
//! |---|---|---|
//! | $x_j$ | `places` | place of joint j |
//! | $d_e = x_b - x_a$ | `span` | span of member e from joint a to joint b |
//! | $N_e$ | `axial` | axial force, tension positive |
//! | $F_e = N_e\\,d_e/|d_e|$ | `pull`, `force` | force with which member e pulls joint a towards joint b |
//! | $w_e = N_e/|d_e|$ | `density` | force density |
//! | $l_e$ | `length` | unstretched length |
//! | $c_e = l_e/EA_e$ | `compliance` | elongation by a unit of axial force |
//! | $\mu_e$ | `mu` | rounding of the law of a member in tension |
//! | $p$ | `pull` | force with which a run pulls its first joint |
//! | $D(p)$ | `Law` | span of a run |
//! | $R$ | `rows` | derivative of the lengths of inextensible taut members by the places |

mod coarse;
mod derivatives;
mod elements;
mod error;
mod floor;
mod framework;
mod hanging;
mod law;
mod newton;
mod order;
mod paper;
mod possible;
mod ranges;
mod residual;
mod runs;
mod second_order;
mod seed;
mod settings;
mod settle;
mod solution;
mod solve;
mod state;
mod stiffness;

pub use derivatives::{Change, Derivatives, Gradient, Parameter};
pub use error::Error;
pub use paper::{PaperUnknowns, paper_residual};
pub use ranges::force_ranges;
pub use seed::Seed;
pub use settings::{Settings, SettingsError};
pub use solution::{Forces, Solution};
pub use solve::{solve, solve_from};
