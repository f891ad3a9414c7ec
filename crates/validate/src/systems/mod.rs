//! The judge of systems of bars: answers held against each other, against Newton's laws and the
//! laws of the members, and against a proof that no configuration has less energy; from the
//! observables alone.

#[cfg(test)]
mod altered_tests;
mod ask;
mod bodies;
#[cfg(feature = "cones")]
mod cables;
mod certificate;
pub(crate) mod compare;
mod completeness;
mod convex;
mod definite;
mod family;
mod floor;
mod forces;
pub(crate) mod free;
#[cfg(test)]
mod free_tests;
pub(crate) mod near;
pub(crate) mod placed;
mod proved;
mod scale;
mod sliding;
pub(crate) mod spans;
mod statics;
#[cfg(test)]
mod tests;
pub(crate) mod turn;
mod verified;
mod verticals;

pub use ask::{SystemAnswer, SystemFailure, ask, ask_with};
#[cfg(feature = "cones")]
pub use cables::{Cables, ConeError, hang_as_cables};
pub use certificate::certify;
pub use compare::{SystemAgreement, compare, judge_alone, judge_without};
pub use completeness::{certify_by_census, look_up, quick_census, wanted_census};
pub(crate) use forces::ABSURD;
pub use near::Near;
pub(crate) use scale::Scale;
pub use scale::energy_size_j;
pub(crate) use statics::STORED_ULPS;
pub use statics::{SystemStatics, judge, judge_chain};
pub use verified::verify;
