//! The problem and the answer as data.
//!
//! ```
//! use model::{Anchors, Bar, Chain, Problem};
//! let bars = vec![Bar::homogeneous(1.0, 2.0)?; 3];
//! let anchors = Anchors { start_m: [0.0; 3], end_m: [2.1, 0.0, 2.8] };
//! let chain = Chain::new("too short", 9.81, anchors, bars)?;
//! assert_eq!((chain.total_mass_kg(), chain.anchors().span_m()), (6.0, 3.5));
//! let refusal = Problem::new(chain).unwrap_err();
//! assert_eq!(
//!     refusal.to_string(),
//!     "the anchors \"0\" and \"3\" are 3.5 m apart and the members between them reach only 3 m: 0.5 m are missing"
//! );
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`Chain`] is what hangs: rigid [`Bar`]s in a row between two [`Anchors`]. A [`Problem`] is a
//! chain that has an answer; [`Refusal`](system::Refusal) says why another has none. An [`Equilibrium`] is an answer
//! of one solver with its [`Evidence`].
//!
//! No mechanics that a solver asks for lives here. The two solvers, which must know nothing of each other, both depend
//! on this crate; a formula of statics that both took from it would be common to both. Loads by the lever rule and the sign
//! of a kind are for checks and motion, and a test in `validate` sees that neither solver asks for them.
//!
//! # Conventions
//!
//! World frame *OXYZ* of the paper, *Z* up, gravity along −*Z*. SI units, named in every field.
//! Joint 0 is the start anchor *O*, joint *n* the end anchor; bar *i* = 1..n runs from joint *i*−1
//! to joint *i*. Vectors are `[x, y, z]` in the world frame.

mod axial;
mod bar;
pub mod budget;
pub mod cases;
mod cell;
mod chain;
mod conversions;
mod ends;
mod equilibrium;
pub mod evidence;
mod input;
mod mass_range;
pub mod number;
mod problem;
mod readable;
mod solver_name;
mod stability;
mod steers;
mod sum;
pub mod system;
pub mod system_file;

pub use axial::AxialForce;
pub use bar::{Bar, BarError};
pub use cell::{name_of_cell, text_cell};
pub use chain::{Anchors, Chain, SMALLEST_TOTAL, STANDARD_GRAVITY_M_S2, VERTICAL_TOLERANCE};
pub use ends::{Ends, Finish};
pub use equilibrium::{Equilibrium, Reactions};
pub use evidence::{
    Agreed, Choices, Complete, CompleteSystem, Convergence, Disagreement, Evidence, Excess,
    ForceChoice, ForceRange, ForceUncertainty, ForcesFound, Jam, Ladder, LargeForce, NoAnswer,
    NoBox, NoCensus, NoCertificate, Optimal, Place, Proved, Quantity, Reason, Rigidity, Room, Rung,
    SelfStresses, Statement, Status, UncertaintyCause, Verified, VerifiedSystem,
};
pub use input::open_input;
pub use problem::{Problem, STRAIGHT_TOLERANCE};
pub use solver_name::SolverName;
pub use stability::{InPlane, InSpace, Stability};
pub use steers::steers;
pub use sum::{Sum, sum};

/// A point or a vector in the world frame: `[x, y, z]`, unit as said where it is used.
pub type Vector = [f64; 3];
