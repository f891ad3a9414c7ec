//! What the caller may choose.

use crate::error::Error;
use crate::net::stability::DENSE;

/// How to minimise. Valid settings come from [`Default`] and pass [`Settings::validate`].
///
/// ```
/// let settings = energy::net::Settings { max_iterations: 50, ..Default::default() };
/// assert!(settings.validate().is_ok());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Largest unbalanced force at a joint over the largest force of the system, and largest misfit
    /// of a length over the length, that count as none (lengths that overdetermine the shape have
    /// their own tolerances). An answer is refused besides where a joint is out of balance by 2.5e-10 of
    /// its own or the mean load. Where the rounding of the places leaves
    /// more, the run ends there and says so in the residual. Default 1e-12; from 1e-15 to 1e-3.
    pub tolerance: f64,
    /// Iterations of Newton's method. Default 1000; at least 1.
    pub max_iterations: u64,
    /// Numbers in all sparse factors that a minimisation computes, restarts included: iterations
    /// times size. Default 1e10, a hundred times what a net of 38,000 cables
    /// takes, or what [`limit_work`](model::budget::limit_work) says; at least 1.
    pub max_work: u64,
    /// Coordinates up to which the equilibrium is looked at with dense matrices: the rank of its lengths, its
    /// self-stresses, the eigenvalues of its second derivative. Default 240. What has more, all with 0, has the signs of
    /// sparse pivots alone: a minimum a few times sooner.
    pub dense: usize,
}

impl Default for Settings {
    fn default() -> Self {
        let max_work = model::budget::max_work();
        Self { tolerance: 1e-12, max_iterations: 1000, max_work, dense: DENSE }
    }
}

impl Settings {
    /// Check every range once.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with the first field that is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        let check = Error::unless_within;
        check("tolerance", self.tolerance, 1e-15, 1e-3)?;
        check("max_iterations", self.max_iterations as f64, 1.0, u64::MAX as f64)?;
        check("max_work", self.max_work as f64, 1.0, u64::MAX as f64)
    }
}
