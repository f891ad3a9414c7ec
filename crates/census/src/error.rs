//! What can go wrong.

/// Why a census was not taken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CensusError {
    /// Occurs when a setting is out of its range.
    #[error("setting {name} must be {allowed}, got {value}")]
    Setting {
        /// Name of the field.
        name: &'static str,
        /// The value as given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Occurs when the chain has more bars than [`Settings::max_bars`](crate::Settings::max_bars).
    #[error(
        "{bars} bars have {patterns:.1e} patterns of tension and compression; the limit is {max_bars} \
         bars. A census of this chain would take about {estimate_s:.0e} s on one core and \
         {estimate_gb:.0e} GB of memory"
    )]
    TooManyBars {
        /// Number of bars of the chain.
        bars: usize,
        /// The limit.
        max_bars: usize,
        /// 2^n.
        patterns: f64,
        /// Estimated time on one core, s; good to an order of magnitude.
        estimate_s: f64,
        /// Estimated memory, GB; good to an order of magnitude.
        estimate_gb: f64,
    },
    /// Occurs when all the weight rests on the two anchors: no joint between them carries any, and
    /// the energy is the same in every position.
    #[error(
        "all the weight of this chain rests on its two anchors: the energy is the same in every \
         position, and every position is an equilibrium"
    )]
    WeightOnAnchors,
}
