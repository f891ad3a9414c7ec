//! The judge of answers from elsewhere: joint positions, and member forces if there are some, from
//! any program or publication.
//!
//! # What is judged
//!
//! An answer has as many digits as its file. Its positions are taken to be known to within
//! $\\delta$, the tolerance times the size of the system, and its forces to within $\\tau$, the
//! tolerance times the largest of them. What an equilibrium within these distances of the answer
//! would explain is no violation; what is above that refutes it:
//!
//! * a length: both ends of a member moved by $\\delta$ change it by at most $2\\delta$;
//! * the direction of a member of length $d$: by at most $2\\delta/(d - \\delta)$, since
//!   $|a/|a| - b/|b|| \\le 2|a - b|/(|a| + |b|)$ (Dunkl and Williams), so that a joint in
//!   equilibrium is told to be out of balance by no more than
//!   $$ \\sum_{\\text{its members}} \\Big(\\tau + |N_e| \\frac{2\\delta}{d_e - \\delta}\\Big) ; $$
//! * the force of an elastic member by $2\\delta\\, EA/l$.
//!
//! The length of a rope is the sum of its spans, each of which may be off by that of a member; its force is
//! one, and two that are given on both sides of a ring differ by no more than $2\\tau$.
//!
//! Every violation is thus a proof that no equilibrium is within the tolerance of the answer.
//!
//! # Without forces
//!
//! The forces that leave the joints least out of balance are found ([`best_forces`]): a linear
//! least-squares problem under the sign conditions of cables and struts, with slack members at zero
//! and elastic ones at the force of their elongation. Its smallest residual $r$ refutes the
//! positions for all forces up to the size at which $\\delta$ would explain it, and counts as a
//! refutation where that is at least [`IMPLAUSIBLE`](bounds::IMPLAUSIBLE) times the forces found
//! and all loads together.
//!
//! A span of a rope whose joints have run together has no direction: its pull is three unknowns more. Forces
//! with a pull larger than the tension leave the answer undecided.
//!
//! # Digits
//!
//! Given forces that break a law of force alone, and that were printed to a few digits, are judged as
//! known to half a unit of the last digit of the largest ([`Judgement::force_digits`]). Of an answer
//! that is not confirmed the smallest power of ten is told at which it would be
//! ([`Judgement::confirmed_at`]).
//!
//! # How large the error is
//!
//! Both solvers start at the answer's positions; the equilibrium that is nearest says how large the
//! error is, and its own evidence how far that is proved. Where interval arithmetic proves that
//! exactly one equilibrium lies in a box next to it, the error is enclosed ([`ProvedError`]).
//!
//! # References
//!
//! C. F. Dunkl, K. S. Williams, A simple norm inequality, Amer. Math. Monthly 71 (1964) 53-54,
//! doi:10.2307/2311304.

pub mod best_forces;
pub mod bounds;
mod digits;
mod floor;
mod given;
mod judgement;
mod least_squares;
mod nearest;
mod proved;
mod sentence;
#[cfg(test)]
mod sliders_tests;
#[cfg(test)]
mod tests;
mod violation;

pub use given::{ForeignAnswer, GivenError};
pub use judgement::{Finding, ForcesJudged, Judgement, ToleranceError, judge_foreign};
pub use nearest::{Nearest, NearestEquilibrium};
pub use proved::ProvedError;
pub use violation::{Law, Violation};
