//! The names of the rungs.

use serde::Serialize;

/// The rungs, lowest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Rung {
    /// A solver's own residual is below its tolerance.
    Converged,
    /// Both solvers agree, and the statics judge finds every bar in balance.
    Agreed,
    /// Interval arithmetic proves that exactly one equilibrium lies in a stated box.
    Verified,
    /// A census proves that there is no other equilibrium outside the listed boxes.
    Complete,
    /// A certificate proves that no configuration has less energy.
    Optimal,
}

impl Rung {
    /// All rungs, lowest first.
    pub const ALL: [Self; 5] =
        [Self::Converged, Self::Agreed, Self::Verified, Self::Complete, Self::Optimal];
}
