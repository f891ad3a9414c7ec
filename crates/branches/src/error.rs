//! What can go wrong as a whole.

/// Why no equilibrium could be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum ContinuationError {
    /// Occurs when a setting of the census is out of range, or the chain is too long for one.
    #[error(transparent)]
    Census(#[from] census::CensusError),
    /// Occurs when the system is no row of rigid bars between two anchors under upright loads.
    #[error(
        "all equilibria are followed of one row of rigid bars between two anchors, under upright loads alone"
    )]
    NoRow,
    /// Occurs when a path, or several together, have more points than the settings allow.
    #[error(
        "{points} points are more than the {most} allowed: all that is found is held in memory, about {} kB for \
         each equilibrium at each point", crate::continuation::ContinuationSettings::BYTES / 1000
    )]
    TooManyPoints { points: usize, most: usize },
    /// Occurs when the path of the variation that was asked for does not exist.
    #[error("the variation has {paths} paths, there is no path {path}")]
    NoPath {
        /// The path as asked for, from 0.
        path: usize,
        paths: usize,
    },
}
