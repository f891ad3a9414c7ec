//! The charts of the pulls: see [`cell`](crate::run::plane::cell).

use serde::Serialize;

/// A chart of pulls: a face of the half cube (H, V, w), the named coordinate being constant, or a
/// shifted copy of the nearest face. The pull is (H, V)/w in units of the census, V counted from
/// the middle of the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Face {
    /// w = 1, coordinates (H, V − V_g) with V_g the V at which the force of the bars of this group
    /// vanishes; bars in a row whose joints carry no weight are a group, any other bar is one
    /// alone.
    Around(u8),
    /// w = 1, coordinates (H, V).
    Near,
    /// H = −1, coordinates (V, w).
    Left,
    /// H = 1, coordinates (V, w).
    Right,
    /// V = −1, coordinates (H, w).
    Below,
    /// V = 1, coordinates (H, w).
    Above,
}
