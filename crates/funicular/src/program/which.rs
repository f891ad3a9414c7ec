//! Which of the two solvers a command asks.

use clap::ValueEnum;

/// Which solvers to ask.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Which {
    /// Forces first: constraints and multipliers
    Lagrange,
    /// Energy first: minimisation
    Energy,
    /// Both, and the comparison
    Both,
}
