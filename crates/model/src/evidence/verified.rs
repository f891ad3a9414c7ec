//! The rung `verified`.

use serde::{Deserialize, Serialize};

use super::finite;

/// Exactly one equilibrium lies in a box (Krawczyk's test in interval arithmetic), and this is it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Verified {
    /// Largest relative width of the enclosures.
    #[serde(with = "finite")]
    pub box_width: f64,
    /// How far outside of the box the answer lies, in units of the total length; 0 inside.
    #[serde(with = "finite")]
    pub distance: f64,
    /// Whether the box stands for a circle of equilibria, turned about the vertical through both
    /// anchors.
    pub circle: bool,
}
