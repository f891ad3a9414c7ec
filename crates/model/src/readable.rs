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

#[cfg(test)]
mod tests {
    use super::Readable;

    #[test]
    fn only_numbers_of_unusual_size_have_exponents() {
        for (number, text) in [
            (0.0, "0"),
            (-1.5, "-1.5"),
            (1e-6, "0.000001"),
            (-9.9e-7, "-9.9e-7"),
            (999_999_999.5, "999999999.5"),
            (1e9, "1e9"),
            (1e-300, "1e-300"),
            (-5e-324, "-5e-324"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(Readable(number).to_string(), text);
        }
    }
}
