//! Axial forces of a system that equilibrium does not determine.

use serde::{Deserialize, Serialize};

use super::ForceChoice;

/// Forces of members in balance with no load at all: any sum of them may be added to the forces of
/// an equilibrium without a change of shape or balance (as far as cables keep pulling and struts
/// pushing).
///
/// A solver states those that it found by its own method; the judge counts them by its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SelfStresses {
    /// Number of independent ones.
    pub dimension: usize,
    /// An orthonormal basis of them: axial forces, tension positive, one for each member.
    pub basis: Vec<Vec<f64>>,
    /// Which of the forces the answer names.
    pub choice: ForceChoice,
}
