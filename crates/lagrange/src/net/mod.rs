//! Equilibria of any system of members, forces first.
//!
//! A [`System`](model::system::System) is a framework: its weights and loads act at the joints by
//! the lever rule, and a member is a law of elongation from force. The hanging shape follows from
//! the least complementary energy over the forces in balance, a programme over cones; Newton's
//! method on places and forces then brings any equilibrium, stable or not, to rounding.
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
//! `cargo run --release -p validate --example network_speed lagrange net 32 50 71 100 141 200 316`
//! and the same with `bridle 10000 100000` and `tree 100000 1000000` print it:
//!
//! | system | members | factorisations | time |
//! |---|---|---|---|
//! | net of rigid bars, hung from four corners | 1,984 | 15 | 0.04 s |
//! | | 4,900 | 19 | 0.11 s |
//! | | 9,940 | 17 | 0.26 s |
//! | | 19,800 | 22 | 0.87 s |
//! | | 39,480 | 23 | 2.0 s |
//! | | 79,600 | 21 | 4.7 s |
//! | | 199,080 | 24 | 17 s |
//! | net of cables, hung from four corners (`cables 100`), 132 of them slack | 19,800 | 25 | 0.9 s |
//! | net of cables in a ring (`ring 100`), 3,144 of them slack | 19,404 | 12 | 0.51 s |
//! | the same (`ring 316`), 34,196 slack | 197,820 | 15 | 11 s |
//! | crumpled net of cables (`crumpled 100`), 6,011 of them slack | 19,800 | 21 | 0.75 s |
//! | three strands to one joint | 30,000 | 7 | 0.01 s |
//! | | 300,000 | 7 | 0.10 s |
//! | dangling tree | 100,000 | 1 | 0.08 s |
//! | | 1,000,000 | 1 | 0.86 s |
//!
//! The bridle of 300,000 bars takes 13 times as long as one chain of as many bars by
//! [`condensed`](crate::condensed), in one run (`cargo run --release -p validate --example
//! bridle_speed`).
//!
//! From 4,900 to 199,080 members of nets that is n to the power 1.36; the elimination alone has
//! 1.5.
//!
//! A rope over rings and pulleys has a link for each span and one force: its equation is that of the sum of
//! its spans, and its stiffness along couples all joints that it meets. What knows runs or cones leaves
//! systems with ropes to augmented multipliers (`settle`) and Newton's method.
//!
//! [`Derivatives`] of an answer by lengths, masses, stiffnesses, loads and anchors come from one
//! more factorisation; where the forces are one family the evidence says how far each of them is
//! open (`ranges`).
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
//! | $z_e = (t_e, F_e)$ | `forces` | force with its size $t_e \ge \lvert F_e \rvert$, module `hanging` |
//! | $s_e$ | `slacks` | length that the force allows, and span |
//! | $p$ | `pull` | force with which a run pulls its first joint |
//! | $D(p)$ | `Law` | span of a run |
//! | $R$ | `rows` | derivative of the lengths of inextensible taut members by the places |

mod admissible;
mod assembly;
mod coarse;
mod cone;
mod decided;
mod densities;
mod derivatives;
mod directions;
mod elements;
mod equations;
mod fitted;
mod floor;
mod framework;
mod hanging;
mod jam;
mod law;
mod newton;
mod order;
mod possible;
mod ranges;
mod readings;
mod residual;
mod runs;
mod second_order;
mod seed;
mod settings;
mod settle;
mod signs;
mod smooth;
mod solution;
mod solve;
mod state;
mod stiffness;
mod weak;
mod work;

pub use crate::error::Error;
pub use derivatives::{Change, Derivatives, Gradient, Parameter};
pub use equations::{Equations, Side};
pub use seed::Seed;
pub use settings::Settings;
pub use solution::{Forces, Solution};
pub use solve::{solve, solve_from};
