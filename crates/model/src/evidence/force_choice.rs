//! Forces that equilibrium does not determine.

use serde::Serialize;

/// Which forces of a family an answer names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ForceChoice {
    /// The limit of the forces between anchors that are moved apart level, as they come back: a
    /// convention of `lagrange` and `energy`.
    AnchorsMovedApart,
    /// Of a system, those with the least `sum F² l`: the limit of the forces in members of equal
    /// stiffness as these become rigid, between supports and above a floor that are; a convention of
    /// `lagrange` and `energy`.
    EquallyStiff,
    /// The solver's own, of which nothing is known.
    Unknown,
}
