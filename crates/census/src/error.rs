//! What can go wrong.

use model::NoCensus;

/// Why a census was not taken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum CensusError {
    /// Occurs when a setting is out of its range.
    #[error("setting {name} must be {allowed}, got {value}")]
    Setting { name: &'static str, value: f64, allowed: &'static str },
    /// Occurs when the chain has more bars than
    /// [`Settings::max_bars`](crate::settings::Settings::max_bars).
    #[error(
        "{bars} bars have {} patterns of tension and compression; the limit is {max_bars} bars. A census of \
         this chain would take about {} of one processor and {} of memory",
        count(*patterns),
        rough_time(*estimate_s),
        rough_memory(*estimate_gb)
    )]
    TooManyBars {
        bars: usize,
        max_bars: usize,
        /// 2^n.
        patterns: f64,
        /// Estimated time of one processor, s: see [`Estimate`](crate::Estimate).
        estimate_s: f64,
        /// Estimated memory, GB.
        estimate_gb: f64,
    },
}

impl CensusError {
    /// The same as evidence.
    pub fn reason(&self) -> NoCensus {
        match self {
            Self::TooManyBars { bars, max_bars, .. } => {
                NoCensus::TooManyBars { bars: *bars, limit: *max_bars }
            }
            Self::Setting { .. } => NoCensus::Settings,
        }
    }
}

/// Numbers from here on are read more easily as a power of ten.
const MANY: f64 = 1e4;

/// A number that is an integer, or so large that its last digits do not matter.
fn count(number: f64) -> String {
    /// As many digits as are counted in words.
    const LONG: f64 = 1e6;
    if number < LONG { format!("{number:.0}") } else { format!("{number:.1e}") }
}

/// The number in the largest of these units, largest first, of which there are two at least.
fn rough(number: f64, units: &[(f64, &str)]) -> String {
    let fitting = units.iter().find(|(unit, _)| number >= 2.0 * unit).or(units.last());
    let (unit, name) = fitting.copied().unwrap_or((1.0, ""));
    let number = number / unit;
    if number >= MANY { format!("{number:.0e} {name}") } else { format!("{number:.0} {name}") }
}

/// A time that is good to an order of magnitude, in the unit that people would use.
///
/// ```
/// assert_eq!(census::rough_time(0.002), "2 ms");
/// assert_eq!(census::rough_time(3.0e8), "10 years");
/// ```
pub fn rough_time(seconds: f64) -> String {
    /// The year is the Julian one.
    const UNITS: [(f64, &str); 6] = [
        (365.25 * 86_400.0, "years"),
        (86_400.0, "days"),
        (3_600.0, "hours"),
        (60.0, "minutes"),
        (1.0, "s"),
        (1e-3, "ms"),
    ];
    // A thousand milliseconds are a second; less than one is not worth telling.
    match seconds {
        ..1e-3 => "a millisecond".to_owned(),
        0.7..2.0 => format!("{seconds:.0} s"),
        _ => rough(seconds, &UNITS),
    }
}

/// Memory that is good to an order of magnitude.
fn rough_memory(gigabytes: f64) -> String {
    const UNITS: [(f64, &str); 4] = [(1e3, "TB"), (1.0, "GB"), (1e-3, "MB"), (1e-6, "kB")];
    rough(gigabytes, &UNITS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_are_in_units_that_people_use() {
        for (seconds, words) in [
            (1e-9, "a millisecond"),
            (0.0016, "2 ms"),
            (0.3, "300 ms"),
            (0.9, "1 s"),
            (1.6, "2 s"),
            (90.0, "90 s"),
            (130.0, "2 minutes"),
            (3.0 * 3_600.0, "3 hours"),
            (1e6, "12 days"),
            (1e9, "32 years"),
            (1e30, "3e22 years"),
        ] {
            assert_eq!(rough_time(seconds), words);
        }
        for (gigabytes, words) in [
            (3.2e-5, "32 kB"),
            (0.5, "500 MB"),
            (16.0, "16 GB"),
            (16_250.0, "16 TB"),
            (1e20, "1e17 TB"),
        ] {
            assert_eq!(rough_memory(gigabytes), words);
        }
    }

    #[test]
    fn a_refusal_is_read_without_powers_of_ten_where_numbers_are_small() {
        let refusal = |bars, patterns, estimate_s, estimate_gb| {
            let max_bars = 2;
            let error =
                CensusError::TooManyBars { bars, max_bars, patterns, estimate_s, estimate_gb };
            error.to_string()
        };
        assert_eq!(
            refusal(3, 8.0, 1.7e-3, 3.2e-5),
            "3 bars have 8 patterns of tension and compression; the limit is 2 bars. A census of this chain \
             would take about 2 ms of one processor and 32 kB of memory"
        );
        let long = refusal(30, 1_073_741_824.0, 8.3e5, 1.6e4);
        assert!(long.contains("1.1e9 patterns") && long.contains("10 days"), "{long}");
        assert!(long.ends_with("16 TB of memory"), "{long}");
    }
}
