//! The only place where the two solvers meet.
//!
//! `lagrange` and `energy` answer the same question and know nothing of each other. Here their answers
//! are held against each other ([`compare`](mod@compare)), against a third judge written from Newton's laws
//! ([`statics`]), against a proof of global minimality ([`certificate`]), and against what the paper prints
//! ([`claims`], [`equations`]). [`independence`] proves from the dependency graph that the agreement of the
//! two is worth something.

pub mod basins;
pub mod bounds;
pub mod cables;
pub mod census_checks;
pub mod census_rungs;
pub mod certificate;
pub mod claims;
pub mod compare;
pub mod completeness;
mod completeness_slope;
pub mod consistency;
mod differences;
pub mod equations;
pub mod example;
pub mod figures;
pub mod independence;
pub mod paper;
pub mod reproduction;
pub mod seeds;
pub mod sextic;
pub mod statics;
pub mod table;
pub mod tolerances;
pub mod units;

pub use compare::{Agreement, Verdict, compare};
pub use reproduction::{Reproduction, reproduce};
pub use tolerances::Tolerances;
