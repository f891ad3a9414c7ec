//! Second-order behaviour of an equilibrium.

use std::fmt::{self, Display, Formatter};

use serde::{Deserialize, Serialize};

/// Second-order behaviour of an equilibrium.
///
/// The index is the number of independent directions in which the energy falls (Morse index of the
/// energy on the configurations that keep every bar whole and both ends in place).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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
    /// Whether both can be said of one equilibrium: they are the same, or count the same directions
    /// of falling energy, and one of them does not tell the least curvature in the plane from zero
    /// ([`InPlane::Degenerate`]) where the other does.
    ///
    /// ```
    /// use model::{InPlane, InSpace, Stability};
    /// let minimum = Stability {
    ///     in_plane: InPlane::Minimum,
    ///     index_in_plane: 0,
    ///     in_space: InSpace::Stable,
    ///     index_in_space: 0,
    /// };
    /// let flat = Stability { in_plane: InPlane::Degenerate, ..minimum };
    /// assert!(minimum.is_compatible_with(&flat) && flat.is_compatible_with(&minimum));
    /// let falling = Stability { in_space: InSpace::Unstable, index_in_space: 1, ..flat };
    /// assert!(!minimum.is_compatible_with(&falling));
    /// // Two names for the same count contradict each other.
    /// let saddle = Stability { in_plane: InPlane::Saddle, ..minimum };
    /// assert!(!minimum.is_compatible_with(&saddle));
    /// ```
    #[must_use]
    pub fn is_compatible_with(&self, other: &Self) -> bool {
        let flat = [self, other].map(|one| one.in_plane == InPlane::Degenerate);
        self == other || flat[0] != flat[1] && Self { in_plane: other.in_plane, ..*self } == *other
    }
}

/// Character of an equilibrium among the motions in its own vertical plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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
