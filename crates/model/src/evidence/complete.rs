//! The rung `complete`.

use serde::{Deserialize, Serialize};

/// A census has listed every equilibrium, and this is one of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Complete {
    /// Equilibria in one vertical plane.
    pub in_plane: usize,
    /// Families of equilibria with slack bars besides.
    pub families: usize,
    /// Patterns of tension and compression that were excluded everywhere else.
    pub patterns: u64,
    /// Cells of pulls that this took.
    pub cells: u64,
}

/// Why there is no census.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "because", rename_all = "snake_case")]
#[non_exhaustive]
pub enum NoCensus {
    /// Nobody asked for one.
    NotAsked,
    /// The chain has more bars than the census takes.
    TooManyBars {
        /// Number of bars.
        bars: usize,
        /// The limit.
        limit: usize,
    },
    /// The census refuses its settings.
    Settings,
}
