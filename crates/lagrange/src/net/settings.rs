use crate::settings::{SettingsError, within};

/// Settings of [`solve`](super::solve()) and [`solve_from`](super::solve_from()).
///
/// ```
/// use lagrange::net::Settings;
/// assert!(Settings::default().validate().is_ok());
/// assert!(Settings { tolerance: 0.0, ..Default::default() }.validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// An answer has converged when every joint is in balance to this part of its loads, or of the
    /// mean load where that is more, and every length is right to this part of it. Beside a singular
    /// shape, where forces are far larger than loads, a hundredth of the forces at a joint counts as
    /// load, up to a million times the load: rounding. (Places of far joints are rounded to doubles after
    /// that.)
    ///
    /// Default 1e-12. Range 1e-14 to 1e-3.
    pub tolerance: f64,
    /// Newton steps of one run on places and forces.
    ///
    /// Default 100. At least 1.
    pub max_iterations: usize,
    /// Up to this number of free directions mechanisms, self-stresses and the Morse index are
    /// counted from dense decompositions, cubic in the number; above, from the pivots of sparse
    /// factors.
    ///
    /// Default 300. Range 0 to 3000.
    pub dense_freedoms: usize,
    /// Work of one solve: entries of all sparse factors that it computes, which is iterations times
    /// size. A net of 38,000 cables is answered with less than 10^8.
    ///
    /// Default 10^10, up to an hour or so, or what
    /// [`limit_work`](model::budget::limit_work) says. At least 1.
    pub max_work: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-12,
            max_iterations: 100,
            dense_freedoms: 300,
            max_work: model::budget::max_work(),
        }
    }
}

impl Settings {
    /// Check every range.
    ///
    /// # Errors
    ///
    /// [`SettingsError`] with the first field that is out of range; NaN is out of every range.
    pub fn validate(&self) -> Result<(), SettingsError> {
        within(&[
            ("tolerance", self.tolerance, 1e-14, 1e-3),
            ("max_iterations", self.max_iterations as f64, 1.0, 1e9),
            ("dense_freedoms", self.dense_freedoms as f64, 0.0, 3000.0),
            ("max_work", self.max_work as f64, 1.0, u64::MAX as f64),
        ])
    }
}
