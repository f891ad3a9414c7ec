//! The rung `converged`.

use serde::Serialize;

use super::finite;
use super::reason::Reason;
use super::status::Status;

/// How a solver ended.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Convergence {
    /// What the residual measures and in which units.
    pub residual_of: &'static str,
    /// The solver's own residual, dimensionless.
    #[serde(with = "finite")]
    pub residual: f64,
    /// What the residual may be; nothing for a proof by enclosure, which needs none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Iterations of the solver.
    pub iterations: usize,
    /// How far the solver's arithmetic leaves the forces open, where that is worth saying.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_uncertainty: Option<ForceUncertainty>,
}

impl Convergence {
    pub(super) fn new(
        residual_of: &'static str,
        residual: f64,
        tolerance: Option<f64>,
        iterations: usize,
    ) -> Self {
        Self { residual_of, residual, tolerance, iterations, force_uncertainty: None }
    }

    /// Reached if the residual is a number not above the tolerance.
    pub(super) fn judged(self) -> Status<Self> {
        let most = self.tolerance.unwrap_or(f64::MAX);
        if self.residual <= most {
            Status::Reached(self)
        } else {
            Status::Open(Reason::AboveTolerance(self))
        }
    }
}

/// How far double precision leaves the forces of an answer open, as the solver knows its own
/// arithmetic.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ForceUncertainty {
    /// Up to so much of the largest force.
    #[serde(with = "finite")]
    pub relative: f64,
    /// Where it comes from.
    pub cause: UncertaintyCause,
}

/// Why double precision does not determine forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum UncertaintyCause {
    /// The closure hardly depends on the pull at the anchor.
    WeakClosure,
    /// The bars are so nearly parallel that a rounding of their directions is large beside their
    /// angles.
    ParallelBars,
}
