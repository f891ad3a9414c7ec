//! Where do bars that hang from their anchors come to rest, and how sure can we be?
//!
//! Every equilibrium is found twice, by two solvers that share no mechanics; a third judge checks both from Newton's
//! laws; and every answer says how far it is proved.
//!
//! ```
//! use funicular::prelude::*;
//!
//! // Or Problem::read("chain.toml")?
//! let problem = Problem::parse(
//!     r#"
//!     anchors = { start_m = [0, 0, 0], end_m = [1.2, 0, -0.5] }
//!     bars = [{ length_m = 0.7, mass_kg = 2 }, { length_m = 0.7, mass_kg = 1, count = 2 }]
//!     "#,
//!     "chain.toml",
//! )?;
//! let answer = Solve::new().run(&problem)?;
//! assert!(answer.agrees());
//! let hanging = &answer.equilibria()[0];
//! assert_eq!(hanging.evidence.rung(), Some(Rung::Optimal));
//! assert!((hanging.joints_m[1][2] + 0.6658).abs() < 1e-4);
//! # Ok::<(), Error>(())
//! ```
//!
//! | to do | with |
//! |---|---|
//! | the hanging equilibrium, by both solvers, judged and proved | [`Solve`] |
//! | the same of any system of bars, cables and struts, elastic or not | [`Solve::run_system`] |
//! | every equilibrium, stable or not, and the proof that there is no other | [`Census`] |
//!
//! Each is a builder: `new`, what differs from the defaults, `run`. The program `funicular` does nothing but read its
//! arguments, call these, and print.
//!
//! # Conventions
//!
//! World frame *OXYZ*, *Z* up, gravity along −*Z*; SI units, named in every field. Joint 0 is the start anchor, joint
//! *n* the end anchor; bar *i* = 1..n runs from joint *i*−1 to joint *i*.

pub mod census;
mod error;
pub mod picture;
mod problem;
mod solve;
#[cfg(feature = "sweep")]
pub mod starts;
mod system;
mod threads;

pub mod prelude;

pub use self::census::{Census, CensusAnswer};
pub use error::Error;
pub use problem::{Problem, case};
pub use solve::{Failure, SCHEMA_VERSION, Solve, SolveAnswer};
pub use system::SystemSolution;
pub use threads::MOST_THREADS;
