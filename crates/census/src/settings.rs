//! What can be chosen.

use crate::error::CensusError;

/// How far a census goes before it calls a cell undecided or a chain too long.
///
/// ```
/// let settings = census::Settings { max_bars: 20, ..Default::default() };
/// assert!(settings.validate().is_ok());
/// assert!(census::Settings { max_bars: 0, ..settings }.validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Chains with more bars are refused with an estimate of the cost. Default 16 (some seconds of a
    /// processor, and up to 100,000 equilibria), from 1 to [`Settings::MAX_BARS`].
    pub max_bars: usize,
    /// Joints held by three long strands of more bars together are refused with an estimate of the
    /// cost. Default 12 (a minute), from 1 to [`Settings::MAX_BARS`].
    pub max_bridle_bars: usize,
    /// A cell narrower than this, on a face of the half cube of pulls (whose edges have length 2),
    /// is not cut any more but listed as undecided. Default 2⁻⁴⁰, from 2⁻⁴⁸ to 2⁻⁴: below, rounding
    /// errors decide.
    pub min_width: f64,
    /// Tests of one cell for one pattern, per pattern on average, after which all cells left are
    /// listed as undecided. Generic chains need a few hundred; default 20,000, from 1 to 10⁹. A net whose members
    /// may be slack shares them among the sets of slack members.
    pub max_tests_per_pattern: u64,
    /// Nets of several closures whose knots have more independent motions than this are refused,
    /// bridles of three strands excepted: the cost grows with the power of their number. Default 3,
    /// from 1 to 6.
    pub max_motions: usize,
}

impl Settings {
    /// No census of more bars, whatever the settings: patterns are the bits of a 32-bit number, and
    /// time and memory are exhausted long before.
    pub const MAX_BARS: usize = 24;

    /// Chains of up to so many bars have their census taken beside a solution without being asked
    /// for: milliseconds.
    pub const UNASKED_BARS: usize = 8;

    /// Chains of up to so many bars have their census taken where equilibria are sought for another
    /// purpose: tenths of a second.
    pub const SOUGHT_BARS: usize = 12;

    /// No census of nets whose knots have more motions.
    pub const MAX_MOTIONS: usize = 6;

    /// Check every field.
    ///
    /// # Errors
    ///
    /// [`CensusError::Setting`] for the first field out of range.
    ///
    /// ```
    /// let settings = census::Settings::default();
    /// assert!(settings.validate().is_ok());
    /// assert!(census::Settings { max_bars: 1000, ..settings }.validate().is_err());
    /// ```
    pub fn validate(&self) -> Result<(), CensusError> {
        /// 2⁻⁴⁸ and 2⁻⁴.
        const WIDTHS: std::ops::RangeInclusive<f64> =
            f64::from_bits((1023 - 48) << 52)..=f64::from_bits((1023 - 4) << 52);
        const TESTS: std::ops::RangeInclusive<u64> = 1..=1_000_000_000;
        if !(1..=Self::MAX_BARS).contains(&self.max_bars) {
            return Err(CensusError::Setting {
                name: "max_bars",
                value: self.max_bars as f64,
                allowed: "from 1 to 24",
            });
        }
        if !(1..=Self::MAX_BARS).contains(&self.max_bridle_bars) {
            return Err(CensusError::Setting {
                name: "max_bridle_bars",
                value: self.max_bridle_bars as f64,
                allowed: "from 1 to 24",
            });
        }
        if !WIDTHS.contains(&self.min_width) {
            return Err(CensusError::Setting {
                name: "min_width",
                value: self.min_width,
                allowed: "from 2^-48 to 2^-4",
            });
        }
        if !TESTS.contains(&self.max_tests_per_pattern) {
            return Err(CensusError::Setting {
                name: "max_tests_per_pattern",
                value: self.max_tests_per_pattern as f64,
                allowed: "from 1 to 1e9",
            });
        }
        if !(1..=Self::MAX_MOTIONS).contains(&self.max_motions) {
            return Err(CensusError::Setting {
                name: "max_motions",
                value: self.max_motions as f64,
                allowed: "from 1 to 6",
            });
        }
        Ok(())
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            max_bars: 16,
            max_bridle_bars: 12,
            min_width: f64::from_bits((1023 - 40) << 52),
            max_tests_per_pattern: 20_000,
            max_motions: 3,
        }
    }
}

#[cfg(test)]
mod tests;
