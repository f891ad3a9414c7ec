//! What can go wrong in a solve.

use model::number::Brief;
use serde::Serialize;

use crate::settings::SettingsError;

/// Why no equilibrium was returned. `Ok` always means converged.
///
/// ```
/// use lagrange::{Seed, Settings, SolveError, solve_from};
/// let four = Seed::planar(&[0.0; 4]);
/// let error = solve_from(&model::cases::paper(), &four, &Settings::default()).unwrap_err();
/// assert_eq!(error, SolveError::SeedLength { expected: 3, got: 4 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum SolveError {
    /// Occurs when a setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// Occurs when the seed has not three angles for each bar.
    #[error("the seed holds the angles of {got} bars, the chain has {expected}")]
    SeedLength {
        /// Bars of the chain.
        expected: usize,
        /// Bars of the seed.
        got: usize,
    },
    /// Occurs when an angle of the seed is infinite or not a number.
    #[error("the seed of bar {bar} has an angle of {angle_rad} rad")]
    SeedNotFinite {
        /// Number of the bar, from 1.
        bar: usize,
        /// The angle as given.
        angle_rad: f64,
    },
    /// Occurs when every run of Newton's method stopped at a local minimum of the residual that is
    /// no root, or ran out of steps.
    #[error(
        "no equilibrium from this seed: residual {residual} (relative) after {iterations} steps \
         and {relaxations} relaxations",
        residual = Brief(*residual)
    )]
    Stagnated {
        /// Norm of the residual at the end, in units of the total weight and length.
        residual: f64,
        /// Steps of all kinds.
        iterations: usize,
        /// Relaxations among the runs.
        relaxations: usize,
    },
    /// Occurs when all equations of the paper hold and a bar is not in balance: a false root at
    /// cos θ = cos φ = 0, where the equations lose a moment balance. Only when
    /// [`Settings::lock_margin`](crate::Settings::lock_margin) is zero; otherwise the bar
    /// gets other angles and the solve goes on.
    #[error(
        "false root: the equations hold, and a moment of {moment} (in units of the largest force \
         times the mean length) acts on bar {bar}",
        moment = Brief(*moment)
    )]
    FalseRoot {
        /// Number of the bar, from 1.
        bar: usize,
        /// The moment that the equations do not see.
        moment: f64,
    },
    /// Occurs when every equilibrium that was found is unstable, though a stable one was asked for.
    #[error("only unstable equilibria found: {found} of them, the last of index {index}")]
    Unstable {
        /// How many.
        found: usize,
        /// Morse index of the last.
        index: usize,
    },
    /// Occurs when the singular value decomposition of the Jacobian does not converge.
    #[error("the singular values of the Jacobian (size {size}) did not converge")]
    Spectrum {
        /// Rows of the Jacobian.
        size: usize,
    },
}
