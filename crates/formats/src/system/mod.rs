//! Systems of other programs.
//!
//! | reader | what is read |
//! |---|---|
//! | [`parse_moordyn`] | MoorDyn input files, the statics of them |
//! | [`parse_compas`] | COMPAS JSON of a network, graph or mesh with force densities `q` |
//! | [`parse_net`] | CSV of nodes and of edges with force densities |
//!
//! A net of force densities is no system of lengths: see [`ForceDensityNet::system_at`] for the one
//! that is judged.

mod compas;
mod force_density;
mod moordyn;
mod nodes;

use model::system::System;

pub use compas::parse_compas;
pub use force_density::{Edge, ForceDensityNet, Node};
pub use moordyn::parse_moordyn;
pub use nodes::parse_net;

/// A system of another program, and what the reader has to say about it.
#[derive(Debug, Clone, PartialEq)]
pub struct ForeignSystem {
    /// The system.
    pub system: System,
    /// How its parts were read: sentences.
    pub notes: Vec<String>,
    /// Height of a floor that is not part of the system, m: joints must stay above it.
    pub floor_m: Option<f64>,
}
