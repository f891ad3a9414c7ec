//! The judge of systems of bars: Newton's laws and the laws of the members, from the observables of an
//! answer alone.

mod statics;

pub use statics::{Place, SystemStatics, judge};
