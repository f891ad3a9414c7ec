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
    /// Tests of one cell for one pattern, per pattern on average, after which all cells left are
    /// listed as undecided. Generic chains need a few hundred; default 20,000, from 1 to 10⁹. A net whose members
    /// may be slack shares them among the sets of slack members.
    pub max_tests_per_pattern: u64,
    /// Nets of several closures whose knots have more independent motions than this are refused: the cost grows with the
    /// power of their number. Default 3, from 1 to 6.
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
        let fields = [
            ("max_bars", self.max_bars as u64, Self::MAX_BARS as u64, "from 1 to 24"),
            ("max_tests_per_pattern", self.max_tests_per_pattern, 1_000_000_000, "from 1 to 1e9"),
            ("max_motions", self.max_motions as u64, Self::MAX_MOTIONS as u64, "from 1 to 6"),
        ];
        match fields.into_iter().find(|(_, value, most, _)| !(1..=*most).contains(value)) {
            Some((name, value, _, allowed)) => {
                Err(CensusError::Setting { name, value: value as f64, allowed })
            }
            None => Ok(()),
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self { max_bars: 16, max_tests_per_pattern: 20_000, max_motions: 3 }
    }
}

#[cfg(test)]
mod tests;
