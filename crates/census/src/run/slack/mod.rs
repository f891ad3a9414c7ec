//! Bars that carry no force, so that the direction of their force says nothing of theirs.

pub(crate) mod axial;
pub(crate) mod exact;
pub(crate) mod exclusion;
pub(crate) mod families;
pub(crate) mod moments;
pub(crate) mod straight;
pub(crate) mod unloaded;
pub(crate) mod upright;
