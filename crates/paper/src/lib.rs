//! The paper audited: what it prints, what is true, and the numbers that decide.
//!
//! ```
//! use paper::example::Example;
//! use paper::printed::Paper;
//! let example = Example::solve()?;
//! let [theta, ..] = example.by_energy_e1().angles_rad.map(f64::to_degrees);
//! let printed = Paper::project().claim("ix-theta").unwrap().value();
//! // The paper prints a point of its grid: 0.344 rad.
//! assert!((printed - theta - 0.014_88).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What is printed comes from `validation/paper.toml` ([`printed`]). Its example is solved by both
//! solvers and closed by the census ([`example`], [`completeness`]); each claim ([`claims`]) and
//! each equation ([`equations`]) gets a verdict that follows from numbers. [`reproduce`] puts all
//! of it into one value, which `report` renders.

pub mod basins;
pub mod bounds;
pub mod claims;
pub mod completeness;
pub mod equations;
pub mod example;
pub mod figures;
pub mod printed;
pub mod reproduction;
pub mod seeds;
pub mod sentence;
pub mod sextic;
mod slope;

pub use reproduction::{Reproduction, reproduce};
