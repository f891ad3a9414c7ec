//! Newton's method made global and safe at singular solutions: Levenberg and Marquardt's.

use crate::full::reduced::Reduced;
use crate::settings::Settings;
use crate::thresholds::EARNED;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The largest equation is below the tolerance.
    Converged,
    /// The residual no longer falls, or the steps ran out.
    Stagnated,
}

/// Damping in the first step, in units of the residual; the gain ratio corrects it at once.
const FIRST_DAMPING: f64 = 1.0;
/// Below this part of the promised decrease the damping grows, ...
const POOR: f64 = 0.25;
/// ... where no more than this part is missing it shrinks, by this factor: Fan and Yuan's rule.
const FACTOR: f64 = 4.0;
/// Least damping in units of the residual: keeps quadratic convergence and bounds the way back up.
const LEAST_FACTOR: f64 = 1e-3;
/// Least damping of all: the square of its ratio to the smallest non-zero singular values (1e-3 and
/// more) is at the rounding error, and beside the zero ones, known to 1e-16, it is large, so that
/// the solution does not drift along them.
const LEAST_DAMPING: f64 = 1e-9;
/// A run has stagnated when the residual has lost less than `PROGRESS` in `PATIENCE` steps.
const PATIENCE: usize = 15;
const PROGRESS: f64 = 0.02;
/// Steps after convergence, each of which must halve the residual: they reach the rounding error.
const POLISH: usize = 3;

/// One run from the point of the equations. Appends the norm of the residual at each step to
/// `history`.
pub(crate) fn newton(
    equations: &mut Reduced,
    settings: &Settings,
    history: &mut Vec<f64>,
) -> Ending {
    let start = history.len();
    let mut factor = FIRST_DAMPING;
    let mut norm = equations.norm();
    for iteration in 0..settings.max_iterations {
        if equations.largest() <= settings.tolerance {
            polish(equations, factor, history);
            return Ending::Converged;
        }
        history.push(norm);
        if iteration >= PATIENCE && norm > (1.0 - PROGRESS) * history[start + iteration - PATIENCE]
        {
            return Ending::Stagnated;
        }
        // Damping of the order of the residual: quadratic convergence without a regular Jacobian.
        let predicted = equations.step((factor * norm).max(LEAST_DAMPING));
        let trial = equations.attempt();
        let gain = (norm * norm - trial * trial) / (norm * norm - predicted * predicted);
        if gain > EARNED {
            equations.accept();
            norm = equations.norm();
        }
        if gain > 1.0 - POOR {
            factor = (factor / FACTOR).max(LEAST_FACTOR);
        } else if gain > POOR {
            // The model is fair: keep.
        } else {
            // Also when the gain is not a number.
            factor *= FACTOR;
        }
    }
    if equations.largest() <= settings.tolerance { Ending::Converged } else { Ending::Stagnated }
}

/// Steps on while each halves the residual.
fn polish(equations: &mut Reduced, factor: f64, history: &mut Vec<f64>) {
    for _ in 0..POLISH {
        let norm = equations.norm();
        equations.step((factor * norm).max(LEAST_DAMPING));
        let trial = equations.attempt();
        if trial.is_nan() || trial > 0.5 * norm {
            return;
        }
        history.push(norm);
        equations.accept();
    }
}
