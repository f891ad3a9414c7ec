//! What can go wrong in a condensed solve.

use model::number::Brief;
use serde::Serialize;

use crate::settings::SettingsError;

/// Why no equilibrium was returned. `Ok` always means converged.
///
/// ```
/// use lagrange::condensed::{CondensedError, Settings, solve};
/// let hasty = Settings { max_passes: 1, ..Default::default() };
/// let error = solve(&model::cases::paper(), &hasty).unwrap_err();
/// assert!(matches!(error, CondensedError::NotClosed { .. }));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum CondensedError {
    /// Occurs when a setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// Occurs when the passes over the bars ran out, or the iteration stopped at rounding errors
    /// larger than the settings allow.
    #[error(
        "the chain does not close: off by {closure} of its length after {passes} passes",
        closure = Brief(*closure)
    )]
    NotClosed {
        /// Distance of the last joint from its anchor, relative to the total length; NaN when no
        /// closed shape was near.
        closure: f64,
        /// Passes over the bars.
        passes: usize,
    },
    /// Occurs when a force or the energy is larger than a double can hold.
    #[error("a force of this chain is larger than a double can hold")]
    Overflow,
}
