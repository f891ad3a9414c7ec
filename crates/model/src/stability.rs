//! Second-order behaviour of an equilibrium.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

/// Second-order behaviour of an equilibrium.
///
/// The index is the number of independent directions in which the energy falls (Morse index of the
/// energy on the configurations that keep every bar whole and both ends in place).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Stability {
    /// Character among the motions in the vertical plane of the equilibrium.
    pub in_plane: InPlane,
    /// Morse index among those motions.
    pub index_in_plane: usize,
    /// Stability among all motions. The neutral turn of the whole chain about vertical anchors does
    /// not count against it.
    pub in_space: InSpace,
    /// Morse index among all motions.
    pub index_in_space: usize,
}

impl Stability {
    /// Of the Morse indices in the plane, which has so many motions, and in space; `is_degenerate` where the second order
    /// does not decide in the plane.
    pub fn of(
        [index_in_plane, index_in_space]: [usize; 2],
        motions: usize,
        is_degenerate: bool,
    ) -> Self {
        Self {
            in_plane: match index_in_plane {
                _ if is_degenerate => InPlane::Degenerate,
                0 => InPlane::Minimum,
                index if index == motions => InPlane::Maximum,
                _ => InPlane::Saddle,
            },
            index_in_plane,
            in_space: if index_in_space == 0 { InSpace::Stable } else { InSpace::Unstable },
            index_in_space,
        }
    }
}

/// Character of an equilibrium among the motions in its own vertical plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum InPlane {
    /// No direction of falling energy.
    Minimum,
    /// The energy falls in some directions and rises in others.
    Saddle,
    /// The energy falls in every direction.
    Maximum,
    /// The second derivative has a zero eigenvalue: the second order does not decide.
    Degenerate,
}

/// Stability of an equilibrium among all motions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum InSpace {
    /// No direction of falling energy.
    Stable,
    /// At least one direction of falling energy.
    Unstable,
}

impl Display for InPlane {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Minimum => "minimum",
            Self::Saddle => "saddle",
            Self::Maximum => "maximum",
            Self::Degenerate => "degenerate",
        })
    }
}

impl Display for Stability {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let in_space = match self.in_space {
            InSpace::Stable => "stable",
            InSpace::Unstable => "unstable",
        };
        let Self { in_plane, index_in_plane, index_in_space, .. } = self;
        write!(
            f,
            "{in_plane} in the plane (index {index_in_plane}), {in_space} in space (index {index_in_space})"
        )
    }
}
