//! What a system file may describe.

use crate::Problem;
use crate::system::System;

/// An equilibrium problem as a system file describes it.
#[derive(Debug, Clone, PartialEq)]
pub enum Described {
    /// A chain of bars between two anchors, under its own weight.
    Chain(Problem),
    /// Any other system: joints by name, or a chain with loads at its joints.
    System(System),
}
