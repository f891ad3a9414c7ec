use model::number::Brief;
use serde::Serialize;

/// Settings of [`solve_from`](crate::solve_from) and [`solve`](crate::solve()).
///
/// ```
/// let settings = lagrange::Settings { max_iterations: 50, ..Default::default() };
/// assert!(settings.validate().is_ok());
/// let settings = lagrange::Settings { tolerance: f64::NAN, ..Default::default() };
/// assert!(settings.validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// A state has converged when its largest equation is at most this: moment rows relative to the
    /// largest force times the mean length, constraint rows relative to the total length; the rows
    /// of the centres are solved exactly.
    ///
    /// Default 1e-13, some hundred rounding errors. Range 1e-15 to 1e-3.
    pub tolerance: f64,
    /// Steps of one run of Newton's method.
    ///
    /// Default 200; from good seeds it takes 5, from random ones of three bars about 15. At least
    /// 1.
    pub max_iterations: usize,
    /// How many times the chain is relaxed from the seed, in viscous motion, when Newton's method
    /// has stopped at a local minimum of the residual that is no root; each time another run of
    /// Newton's method follows. With 0 Newton's method from the seed is all.
    ///
    /// Default 8. Range 0 to 1000.
    pub relaxations: usize,
    /// Steps of one such relaxation.
    ///
    /// Default 500. At least 1.
    pub max_relaxation_steps: usize,
    /// A bar is described by other angles when the length of its [`spin`](crate::spin()) falls
    /// below this, near gimbal lock. With 0 the paper's angles are kept whatever happens, and its
    /// false roots are met: they end in [`Error::FalseRoot`](crate::Error::FalseRoot).
    ///
    /// Default 0.1. Range 0 to 0.9.
    pub lock_margin: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-13,
            max_iterations: 200,
            relaxations: 8,
            max_relaxation_steps: 500,
            lock_margin: 0.1,
        }
    }
}

/// Why settings cannot be used.
///
/// ```
/// let settings = lagrange::Settings { tolerance: 1.0, ..Default::default() };
/// let error = settings.validate().unwrap_err();
/// assert_eq!((error.name, error.value, error.high), ("tolerance", 1.0, 1e-3));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[error("setting {name} = {value} is outside its range, {} to {}", Brief(*low), Brief(*high))]
pub struct SettingsError {
    /// The field.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Smallest value allowed.
    pub low: f64,
    /// Largest value allowed.
    pub high: f64,
}

/// Check names, values and ranges; NaN is out of every range.
pub(crate) fn within(ranges: &[(&'static str, f64, f64, f64)]) -> Result<(), SettingsError> {
    for &(name, value, low, high) in ranges {
        if !(low..=high).contains(&value) {
            return Err(SettingsError { name, value, low, high });
        }
    }
    Ok(())
}

impl Settings {
    /// Check every range.
    ///
    /// # Errors
    ///
    /// [`SettingsError`] with the first field that is out of range; NaN is out of every range.
    ///
    /// ```
    /// assert!(lagrange::Settings { lock_margin: 1.0, ..Default::default() }.validate().is_err());
    /// ```
    pub fn validate(&self) -> Result<(), SettingsError> {
        within(&[
            ("tolerance", self.tolerance, 1e-15, 1e-3),
            ("max_iterations", self.max_iterations as f64, 1.0, 1e9),
            ("relaxations", self.relaxations as f64, 0.0, 1000.0),
            ("max_relaxation_steps", self.max_relaxation_steps as f64, 1.0, 1e9),
            ("lock_margin", self.lock_margin, 0.0, 0.9),
        ])
    }
}
