//! How much memory the program may come to need.

use std::num::NonZeroU64;

use crate::sweep::count;

/// Units of `--max-memory`, bytes.
const UNITS: [(&str, u64); 3] = [("GB", 1_000_000_000), ("MB", 1_000_000), ("kB", 1_000)];

/// What `--max-memory` takes: a whole number of GB, MB, kB, or bytes without a unit.
pub fn parse(text: &str) -> Result<u64, String> {
    let unit = UNITS.iter().find_map(|(unit, bytes)| Some((text.strip_suffix(unit)?, *bytes)));
    let (number, unit) = unit.unwrap_or((text, 1));
    let plain = number.trim_end().bytes().all(|byte| byte.is_ascii_digit());
    let number = number.trim_end().parse::<u64>().ok().filter(|_| plain);
    number
        .and_then(|number| number.checked_mul(unit))
        .ok_or_else(|| "a whole number of GB, MB or kB is required, as 4GB".to_owned())
}

/// What `--max-work` takes: a whole number, with or without an exponent.
pub fn work(text: &str) -> Result<NonZeroU64, String> {
    count(text).map(|number| NonZeroU64::new(number).unwrap_or(NonZeroU64::MIN))
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn sizes_are_read_with_their_units() {
        for (text, bytes) in
            [("4GB", 4_000_000_000), ("300 MB", 300_000_000), ("1kB", 1000), ("77", 77)]
        {
            assert_eq!(parse(text), Ok(bytes));
        }
        for text in ["", "GB", "-1GB", "+1", "1.5GB", "1TB", "99999999999GB", "4gb", "4 G B"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
