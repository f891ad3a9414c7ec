//! Numbers that know their rounding error, what makes a computation a proof; [`vector`]s of three, and
//! [work that threads share](in_parallel()).
//!
//! ```
//! use numerics::{Interval, PI, atan2};
//! // 1/3 is no double; its enclosure is one rounding wide.
//! let third = Interval::ONE / Interval::point(3.0);
//! assert!(third.width() < 2e-16 && (third * Interval::point(3.0)).contains(1.0));
//! // 4 atan 1 = π, without the system's libm.
//! let pi = atan2(Interval::ONE, Interval::ONE).scale(4.0);
//! assert!(!pi.disjoint(PI) && pi.width() < 2e-14);
//! ```
//!
//! | type | a number is | for |
//! |---|---|---|
//! | [`Interval`] | all numbers between two doubles | every proof |
//! | [`IntervalSum`] | an interval | sums of many terms |
//! | [`DoubleDouble`] | two doubles and an error | residuals of ill-conditioned systems |
//!
//! Of mechanics only the [lever rule](lever()) lives here, which every proof needs; the two solvers
//! use nothing of this crate: what judges their answers shares nothing with them.

mod angle;
mod double_double;
mod interval;
mod interval_sum;
mod lever;
mod parallel;
mod rounding;
pub mod vector;

pub use angle::{PI, atan2};
pub use double_double::DoubleDouble;
pub use interval::Interval;
pub use interval_sum::IntervalSum;
pub use lever::lever;
pub use parallel::in_parallel;
pub use rounding::{down, two_sum, up};
