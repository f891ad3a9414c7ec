//! The routines called from outside as clarabel calls them, in one program.

use dense_lapack as _;

#[macro_use]
mod support;
#[macro_use]
mod triangles;

mod factors;
mod others;
mod products;
mod ranges;
mod spectral;
