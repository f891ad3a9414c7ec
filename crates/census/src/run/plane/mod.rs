//! The chain in the plane of its anchors, and the pulls that may hold it.

pub(crate) mod cell;
pub(crate) mod face;
pub(crate) mod loads;
pub(crate) mod system;
