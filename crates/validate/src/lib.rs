//! The only place where the two solvers meet.
//!
//! ```
//! use validate::{Solvers, systems::ask};
//! // The paper's chain: three bars of 1 m and 1 kg, anchors 2 m apart on one vertical.
//! let system = model::system::System::from(model::cases::paper().chain());
//! let answer = ask(&system, Solvers::Both, &|_| {});
//! assert!(answer.agrees());
//! for found in &answer.equilibria {
//!     // lambda_3, the vertical force of the ground on bar 1, in mg (a root finder of 40 digits).
//!     assert!((found.reactions_n[0][2] / 9.80665 - 2.312_944_292_241_838).abs() < 1e-12);
//!     assert_eq!(found.evidence.rung(), Some(model::Rung::Optimal));
//! }
//! ```
//!
//! `lagrange` and `energy` answer the same question and know nothing of each other. Here their
//! answers are held against each other ([`systems::compare`]), against a third judge written
//! from Newton's laws ([`systems::judge`]), against a proof of global minimality
//! ([`systems::certify`]), and against a list of all equilibria ([`systems::look_up`]). A test (`independence`) proves from the
//! dependency graph that the agreement of the two is worth something. Answers from elsewhere are judged by the
//! same laws ([`foreign`]).

pub mod built_in;
pub mod census_checks;
pub mod certificate;
pub mod completeness;
pub mod field;
pub mod foreign;
mod free;
pub mod gallery;
pub mod lever;
pub mod question;
pub mod systems;
pub mod table;
pub mod tolerances;
mod verdict;

pub use question::{Equations, Question, Solvers, UseCensus};
pub use tolerances::Tolerances;
pub use verdict::Verdict;
