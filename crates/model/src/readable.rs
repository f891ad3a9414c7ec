//! Numbers in sentences.

use std::fmt;

/// Sizes that are written digit by digit; beyond them zeros would have to be counted.
const PLAIN: std::ops::Range<f64> = 1e-6..1e9;

/// A number as people read it: plain where it is of ordinary size, with a power of ten where it is
/// not. Both forms have the fewest digits that read back to the same double.
pub(crate) struct Readable(pub(crate) f64);

impl fmt::Display for Readable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = self;
        let plain = *number == 0.0 || !number.is_finite() || PLAIN.contains(&number.abs());
        if plain { write!(f, "{number}") } else { write!(f, "{number:e}") }
    }
}

/// A number that was worked out from others, with the fewest digits that its rounding allows: `6`,
/// not `5.999999999999998`.
pub(crate) struct Computed {
    value: f64,
    /// What rounding may have changed.
    rounding: f64,
}

impl Computed {
    /// Roundings of a sum or a distance that are allowed for, in units of [`f64::EPSILON`]: twice
    /// those of a square root of three squares, after a compensated sum.
    const ROUNDINGS: f64 = 8.0;

    /// A sum, or a distance.
    pub(crate) fn of(value: f64) -> Self {
        Self { value, rounding: Self::ROUNDINGS * f64::EPSILON * value.abs() }
    }

    /// The difference of two of them, which has the rounding of both.
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        let rounding = Self::ROUNDINGS * f64::EPSILON * a.abs().max(b.abs());
        Self { value: a - b, rounding }
    }
}

impl fmt::Display for Computed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Digits that tell every double from the next.
        const MOST: usize = 17;
        let near = |digits: usize| {
            let shown: f64 = format!("{:.*e}", digits - 1, self.value).parse().ok()?;
            ((shown - self.value).abs() <= self.rounding).then_some(shown)
        };
        write!(f, "{}", Readable((1..=MOST).find_map(near).unwrap_or(self.value)))
    }
}
