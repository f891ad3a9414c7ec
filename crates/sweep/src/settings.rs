//! What can be chosen for a sweep over seeds.

use crate::error::SweepError;
use crate::starts::Source;

/// A sweep over seeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// The seed number: with it and the source, seed k is fixed. Default 1.
    pub number: u64,
    /// How the seeds are spread. Default uniform.
    pub source: Source,
    /// Seeds in a chunk of [`Sweep::run`](crate::Sweep::run). Default 16,384, from 1 to 2²⁴: small
    /// enough for the memory of a processor core, large enough to cost nothing.
    pub chunk: u64,
    /// Of the census that the outcomes are identified against. Default: that of the crate.
    pub census: census::Settings,
    /// Random seeds through all solvers that make the list where the census does not: see
    /// [`Members`](crate::Members); of what they reach at most [`DISCOVERED`](crate::DISCOVERED)
    /// are listed. Default 20,000; 0 for none. Of chains of more than 60 bars fewer of them do:
    /// [`discovering`](Self::discovering).
    pub discover: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            number: 1,
            source: Source::Uniform,
            chunk: 1 << 14,
            census: census::Settings::default(),
            discover: 20_000,
        }
    }
}

impl Settings {
    /// Most seeds in a chunk.
    pub const LARGEST_CHUNK: u64 = 1 << 24;

    /// How many seeds make the list for a chain of so many bars: a seed takes a time that grows
    /// with the square of the bars, and nearly every seed of a long chain reaches another
    /// equilibrium, so that the list identifies few.
    ///
    /// ```
    /// let settings = sweep::Settings::default();
    /// assert_eq!([17, 60, 120, 6_000].map(|n| settings.discovering(n)), [20_000, 20_000, 5_000, 2]);
    /// ```
    #[must_use]
    pub fn discovering(&self, bars: usize) -> u32 {
        const ALL: f64 = 60.0;
        let part = (ALL / bars.max(1) as f64).min(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part")]
        let seeds = (f64::from(self.discover) * part * part).round() as u32;
        seeds
    }

    /// Check every range.
    ///
    /// # Errors
    ///
    /// [`SweepError`] for the first setting out of range.
    ///
    /// ```
    /// use sweep::Settings;
    /// assert!(Settings::default().validate().is_ok());
    /// let large = Settings { chunk: Settings::LARGEST_CHUNK + 1, ..Settings::default() };
    /// assert!(large.validate().is_err());
    /// ```
    pub fn validate(&self) -> Result<(), SweepError> {
        if !(1..=Self::LARGEST_CHUNK).contains(&self.chunk) {
            return Err(SweepError::Chunk { seeds: self.chunk, most: Self::LARGEST_CHUNK });
        }
        self.census.validate()?;
        Ok(())
    }
}
