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
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            number: 1,
            source: Source::Uniform,
            chunk: 1 << 14,
            census: census::Settings::default(),
        }
    }
}

impl Settings {
    /// Most seeds in a chunk.
    pub const LARGEST_CHUNK: u64 = 1 << 24;

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
