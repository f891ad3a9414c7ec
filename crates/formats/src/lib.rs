//! Files of other programs.
//!
//! [`answer`] reads joint positions, and forces if there are some: our own JSON, CSV, VTU.
//! [`system`] reads systems: lines of DXF and OBJ, MoorDyn, MAP++ and OpenSees input files, COMPAS JSON, CSV of nodes
//! and edges with force densities. [`ForceTable`] reads forces over time. [`export`](mod@export) writes systems with their equilibrium. What a file holds and this crate does not
//! understand is named and refused, never dropped; an error has the line it is about.
//!
//! Only data is moved here: nothing is solved and nothing judged.

/// Words, or pairs of them, as texts.
macro_rules! names {
    ($($name:ident)*) => { &[$(stringify!($name)),*] };
    ($($other:ident: $name:ident)*) => { &[$((stringify!($other), stringify!($name))),*] };
}

pub mod answer;
mod error;
pub mod export;
mod force_table;
mod json;
mod sheet;
pub mod system;

pub use error::{FormatError, Result};
pub use force_table::{ForceOverTime, ForceTable};
