//! Zeros that are not simple: how many there can be, counted with multiplicity.

pub(crate) mod arc;
pub(crate) mod bound;
pub(crate) mod maps;
pub(crate) mod series;
pub(crate) mod straightened;
pub(crate) mod unloaded;
