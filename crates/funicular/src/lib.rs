//! Where does a system of bars, cables and springs come to rest, and how sure can we be?
//!
//! Where a system comes to rest is found twice, by two solvers that share no mechanics; a third judge checks
//! both from Newton's laws; and every answer says how far it is proved.
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
//! // As a scan over the angle of the first bar finds it.
//! assert!((hanging.joints_m[1][2] + 0.6743).abs() < 1e-4);
//! # Ok::<(), Error>(())
//! ```
//!
//! | to do | with |
//! |---|---|
//! | the hanging equilibrium of a chain, or of bars, cables and struts, elastic or not, by both solvers, judged and proved | [`Solve`] |
//! | the same of many systems in parallel | [`Solve::run_all`] |
//! | guaranteed ranges of places and forces over tolerances | [`Solve::tolerances`] |
//! | every equilibrium, stable or not, and the proof that there is no other | [`Census`] |
#![cfg_attr(
    feature = "branches",
    doc = "| the hanging shape over a parameter: sag, forces, angles | [`Study`] |"
)]
#![cfg_attr(
    feature = "branches",
    doc = "| how it changes with every number of its file | [`Derivatives`] |"
)]
#![cfg_attr(
    feature = "branches",
    doc = "| all equilibria over a parameter: branches, folds, exchanges of stability | [`Trace`] |"
)]
#![cfg_attr(feature = "sweep", doc = "| which start leads where, by millions | [`Sweep`] |")]
#![cfg_attr(feature = "sweep", doc = "| the same as a picture | [`Basins`] |")]
//! | small oscillations, and how fast unstable equilibria are left | [`Modes`] |
//! | the system in motion | [`Simulate`] |
//! | an answer from elsewhere, judged | [`Judge`] |
#![cfg_attr(feature = "paper", doc = "| the paper, judged | [`Reproduce`] |")]
//!
//! Each is a builder: `new`, what differs from the defaults, `run`. The program `funicular` does
//! nothing but read its arguments, call these, and print.
//!
//! A solver of one's own is held against ours by [`compare()`]. The [guide] has chapters on all of this.
//!
//! # Features
//!
//! All are on by default. A program that solves chains takes `default-features = false` and few
//! dependencies.
//!
//! | feature | what |
//! |---|---|
//! | `columns` | bars from Parquet |
//! | `sweep` | `Sweep`, `Basins`, `Ensemble` |
//! | `png-pdf` | pictures also as PNG, PDF and DXF ([`picture::Format`]) |
//! | `branches` | `Study`, `Derivatives`, `Trace` |
//! | `live` | `live::Ask` |
//! | `paper` | `Reproduce` |
//! | `program` | the program `funicular` |
//!
//! # Conventions
//!
//! World frame *OXYZ*, *Z* up, gravity along −*Z*; SI units, named in every field. Joint 0 is the
//! start anchor, joint *n* the end anchor; bar *i* = 1..n runs from joint *i*−1 to joint *i*.

#[macro_use]
mod setters;

mod animation;
#[cfg(feature = "sweep")]
mod basins;
pub mod census;
mod compare;
mod csv;
#[cfg(feature = "branches")]
mod derivatives;
mod draws;
mod enclosed;
#[cfg(feature = "sweep")]
mod ensemble;
mod equilibria;
mod error;
mod extremes;
#[cfg(feature = "sweep")]
mod followed;
#[cfg(feature = "columns")]
mod frames;
pub mod judge;
#[cfg(feature = "live")]
pub mod live;
mod load_cases;
mod losses;
mod modes;
mod moving_page;
mod object;
#[cfg(feature = "branches")]
mod observable;
mod page;
#[cfg(feature = "branches")]
mod parameters;
pub mod picture;
mod problem;
#[cfg(feature = "paper")]
mod reproduce;
mod resting;
mod sag;
mod settled;
mod shown;
mod simulate;
mod solve;
#[cfg(feature = "sweep")]
pub mod starts;
#[cfg(feature = "branches")]
mod study;
#[cfg(feature = "sweep")]
mod sweep;
#[doc(hidden)]
pub mod text;
mod threads;
mod tolerances;
#[cfg(feature = "branches")]
mod trace;
mod track;
#[cfg(feature = "branches")]
mod varied;
mod weakest;

pub mod guide;
pub mod prelude;

/// The crates whose types stand in the answers and errors here, and of which systems are built: none of them need be
/// a dependency of its own.
///
/// ```
/// use funicular::model::system::{LoadCase, LoadOn, NamedLoad, Strength};
/// use funicular::prelude::*;
/// // 100 N at the end of a rope that bears 200 N, and twice the 75 N of a gust.
/// let rope = Bar::homogeneous(1.0, 0.0)?;
/// let strength = Strength::new(Some(200.0), None, 1.0)?;
/// let lamp = System::builder("lamp")
///     .gravity_m_s2(10.0)
///     .joint(Joint::anchor("hook", [0.0; 3]))
///     .joint(Joint::free("lamp").with_mass(10.0))
///     .member("hook", "lamp", move |a, b| Member::cable(a, b, rope).bearing(Some(strength)))
///     .build()?;
/// let gust = LoadOn::Joints { joints: vec![1], mass_kg: 0.0, force_n: [75.0, 0.0, 0.0] };
/// let storm = LoadCase { name: "storm".into(), factors: vec![("gust".into(), 2.0)] };
/// let lamp = lamp.with_loads(vec![NamedLoad { name: "gust".into(), on: gust }], vec![storm])?;
/// let found = Solve::new().load_cases(&lamp.into())?;
/// let used = found.bars()[0].utilisation.as_ref().expect("a strength");
/// assert!((used.value - 100.0_f64.hypot(150.0) / 200.0).abs() < 1e-9 && used.case == "storm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(no_inline)]
pub use {energy, formats, lagrange, model, motion, validate};

/// The Rust of the README is run with the tests of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub use self::animation::Animation;
#[cfg(feature = "sweep")]
pub use self::basins::{Basins, BasinsAnswer, Plane};
pub use self::census::{Census, CensusAnswer, LargeCensusAnswer};
#[cfg(feature = "branches")]
pub use self::derivatives::{
    AnchorStiffness, Derivative, Derivatives, DerivativesAnswer, DerivativesError, NumberGradient,
    ParameterChange,
};
#[cfg(feature = "sweep")]
pub use self::ensemble::{Ensemble, PreparedEnsemble};
pub use self::load_cases::{BarEnvelope, CaseAnswer, Governing, LoadCasesAnswer, SupportEnvelope};
pub use self::losses::{Loss, LossesAnswer};
pub use self::page::{Page, PageAnswer};
#[cfg(feature = "branches")]
pub use self::parameters::Parameters;
#[cfg(feature = "paper")]
pub use self::reproduce::{Reproduce, ReproduceAnswer};
#[cfg(feature = "branches")]
pub use self::study::{NoShape, Study, StudyAnswer, StudyPoint, StudyShape};
#[cfg(feature = "sweep")]
pub use self::sweep::{Format, PreparedSweep, Spread, Sweep, SweepAnswer};
#[cfg(feature = "branches")]
pub use self::trace::load::{
    BranchesFrom, LoadEnd, LoadError, LoadEvent, LoadPath, LoadPaths, LoadPoint,
};
#[cfg(feature = "branches")]
pub use self::trace::{Confirmed, PathProved, Trace, TraceAnswer};
pub use ::census::boxes::{NoRanges, Range, ToleranceRanges};
#[cfg(feature = "sweep")]
pub use ::sweep::Field;
#[cfg(feature = "branches")]
pub use branches::load::Kind as LoadEventKind;
#[cfg(feature = "branches")]
pub use branches::{Combine, JointField, Number, PointError};
pub use compare::compare;
pub use draws::{Distribution, Drawn, Draws};
pub use enclosed::{Enclosed, Inertia};
pub use error::Error;
pub use extremes::Extremes;
pub use formats::ForceTable;
pub use formats::export;
#[cfg(feature = "columns")]
pub use frames::Frames;
pub use judge::{Judge, Judged};
#[cfg(feature = "branches")]
pub use lagrange::net::Gradient;
pub use model::budget::limit_work;
pub use model::system::{SystemBuilder, SystemStability};
pub use model::{AxialForce, Evidence, InPlane, InSpace};
pub use modes::{JointAt, Mode, Modes, ModesAnswer, WithModes};
pub use motion::Order;
pub use object::{SCHEMA_VERSION, Summary};
pub use picture::drawn_modes;
pub use problem::{Problem, Reading, case, case_text};
pub use sag::Sag;
pub use settled::{Outcome, Settled, Unsettled};
pub use simulate::{Motion, Simulate, SimulateError, Start};
pub use solve::{Failure, Lists, Solve, SolveAnswer};
pub use threads::MOST_THREADS;
pub use tolerances::TolerancesAnswer;
pub use weakest::{Unjudged, Weakest};
