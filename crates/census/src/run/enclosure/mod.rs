//! Boxes that hold exactly one zero of the closure, proved, and shrunk to double precision.

pub(crate) mod krawczyk;
pub(crate) mod polish;
