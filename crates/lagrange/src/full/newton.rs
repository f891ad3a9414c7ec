//! Newton's method made global and safe at singular solutions: Levenberg and Marquardt's.

use crate::full::reduced::Reduced;
use crate::settings::Settings;
use crate::thresholds::EARNED;

/// Below this part of the promised decrease the damping is divided by it; where no more than this part is missing it is
/// multiplied by it: Fan and Yuan's rule.
const POOR: f64 = 0.25;
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
/// `history`. Whether the largest equation is below the tolerance: else the residual no longer falls, or the steps ran out.
pub(crate) fn newton(equations: &mut Reduced, settings: &Settings, history: &mut Vec<f64>) -> bool {
    let start = history.len();
    // Damping in units of the residual; the gain ratio corrects it at once.
    let mut factor = 1.0_f64;
    let mut norm = equations.norm();
    for iteration in 0..settings.max_iterations {
        if equations.largest() <= settings.tolerance {
            polish(equations, factor, history);
            return true;
        }
        history.push(norm);
        if iteration >= PATIENCE && norm > (1.0 - PROGRESS) * history[start + iteration - PATIENCE]
        {
            return false;
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
            factor = (factor * POOR).max(LEAST_FACTOR);
        } else if gain > POOR {
            // The model is fair: keep.
        } else {
            // Also when the gain is not a number.
            factor /= POOR;
        }
    }
    equations.largest() <= settings.tolerance
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
