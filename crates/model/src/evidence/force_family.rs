//! Forces that equilibrium does not determine.

use serde::{Deserialize, Serialize};

use crate::Vector;

/// The forces in the bars of an equilibrium whose bars are all parallel to one line, as far as the
/// rounding of lengths can tell: a force along the line may be added to the forces between all
/// bars, and every bar stays in balance. The chain then has one self-stress; in any other position
/// it has none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ForceFamily {
    /// Number of independent self-stresses.
    pub dimension: usize,
    /// Unit vector along the line, world frame, upwards (level: towards the last joint).
    pub direction: Vector,
    /// Force of the ground on the chain at joint 0 along that direction, N: between these ends all
    /// bars are in tension. Nothing where some bar is pushed whatever is added.
    pub start_force_n: Option<[f64; 2]>,
    /// Which of the forces the answer names.
    pub choice: ForceChoice,
}

/// Which forces of a family an answer names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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
