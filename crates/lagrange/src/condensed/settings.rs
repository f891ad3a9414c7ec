use crate::settings::{SettingsError, within};

/// Settings of [`solve`](super::solve()) and [`Condensed::pull`](super::Condensed::pull).
///
/// ```
/// use lagrange::condensed::Settings;
/// assert!(Settings::default().validate().is_ok());
/// assert!(Settings { closure: 0.0, ..Default::default() }.validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// How far the last joint may be from its anchor, relative to the total length.
    ///
    /// Newton's method always goes on to the rounding errors, some 1e-15; this bounds them where a
    /// chain amplifies them. Default 1e-13. Range 1e-15 to 1e-3.
    pub closure: f64,
    /// Passes over all bars, at most.
    ///
    /// Most chains take 5 to 10, large ones 1 or 2 after some over a coarser chain; a nested search
    /// that never fails may take some hundreds. Default 20,000. Range 1 to 1e9.
    pub max_passes: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { closure: 1e-13, max_passes: 20_000 }
    }
}

impl Settings {
    /// Check every range.
    ///
    /// # Errors
    ///
    /// [`SettingsError`] with the first field that is out of range; NaN is out of every range.
    ///
    /// ```
    /// let settings = lagrange::condensed::Settings { max_passes: 0, ..Default::default() };
    /// let error = settings.validate().unwrap_err();
    /// assert_eq!((error.name, error.low), ("max_passes", 1.0));
    /// ```
    pub fn validate(&self) -> Result<(), SettingsError> {
        within(&[
            ("closure", self.closure, 1e-15, 1e-3),
            ("max_passes", self.max_passes as f64, 1.0, 1e9),
        ])
    }
}
