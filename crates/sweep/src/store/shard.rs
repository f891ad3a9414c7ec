//! How the seeds are cut: into parts, the files, and into shards, the machines.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// Fewest and most seeds of a part. The most: a part of a slow solver is a quarter of a minute of
/// work, which is what an interruption can lose, and a file of some ten megabytes. The fewest:
/// below it a file is more description than content.
const PART_SEEDS: Range<u64> = 1 << 10..1 << 20;

/// Parts that a sweep is cut into if their size allows it: enough for as many shards, few enough to
/// list.
const PARTS: u64 = 64;

/// Parts above which they grow beyond the most of [`PART_SEEDS`], so that what has to be done for
/// each, and the summary, stay small.
const MANY_PARTS: u64 = 1 << 16;

/// Most seeds of a part of the largest sweeps: some 200 MB, and minutes of work.
const LARGEST_PART: u64 = 1 << 24;

/// Seeds of one part of a sweep of so many seeds: a power of two, and a function of their number
/// alone, so that every shard cuts at the same places.
///
/// ```
/// assert_eq!(sweep::part_seeds(1_000), 1 << 10);
/// assert_eq!(sweep::part_seeds(1_000_000), 1 << 14);
/// assert_eq!(sweep::part_seeds(100_000_000), 1 << 20);
/// assert_eq!(sweep::part_seeds(1_000_000_000_000), 1 << 24); // in 59,605 parts
/// ```
pub fn part_seeds(seeds: u64) -> u64 {
    let wanted = (seeds / PARTS).clamp(PART_SEEDS.start, PART_SEEDS.end);
    let part = wanted.next_power_of_two().min(PART_SEEDS.end);
    let large = seeds.div_ceil(MANY_PARTS).min(LARGEST_PART).next_power_of_two();
    part.max(large)
}

/// Most parts of a sweep: so many records are what a summary may be long.
pub(crate) const MOST_PARTS: u64 = 150_000;

/// Most seeds of a sweep: the summary lists every part, and must not be too long to be read.
pub const MOST_SEEDS: u64 = MOST_PARTS * LARGEST_PART;

/// The `number`-th of `of` shards.
///
/// ```
/// use sweep::{Shard, ShardError};
/// assert_eq!("2/7".parse(), Ok(Shard { number: 2, of: 7 }));
/// assert!(matches!("8/7".parse::<Shard>(), Err(ShardError::Range { .. })));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Which, from 1.
    pub number: u64,
    /// Of how many.
    pub of: u64,
}

/// Why a shard cannot be what it is said to be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum ShardError {
    /// Occurs when the text is not two whole numbers with a slash between.
    #[error("a shard is K/N, as 2/7 is the second of seven, not `{text}`")]
    Form { text: String },
    /// Occurs when there is no such shard.
    #[error("there is no shard {number} of {of}: the first is 1, the last {of}")]
    Range { number: u64, of: u64 },
}

impl Shard {
    /// The only one.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// The parts of this shard, of so many in all: every part is in exactly one shard, shards
    /// follow one another, and none has two parts more than another. With more shards than parts
    /// some are empty.
    ///
    /// ```
    /// let shard = |number| sweep::Shard { number, of: 3 }.parts(7);
    /// assert_eq!([shard(1), shard(2), shard(3)], [0..2, 2..4, 4..7]);
    /// ```
    pub fn parts(self, parts: u64) -> Range<u64> {
        let at = |number: u64| {
            let exact = u128::from(parts) * u128::from(number) / u128::from(self.of.max(1));
            u64::try_from(exact).unwrap_or(parts).min(parts)
        };
        at(self.number.saturating_sub(1))..at(self.number)
    }
}

impl std::str::FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let form = || ShardError::Form { text: text.to_owned() };
        let (number, of) = text.split_once('/').ok_or_else(form)?;
        let whole = |digits: &str| {
            // `parse` takes a plus sign.
            let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
            digits.parse::<u64>().ok().filter(|_| plain).ok_or_else(form)
        };
        let (number, of) = (whole(number)?, whole(of)?);
        if number == 0 || number > of {
            return Err(ShardError::Range { number, of });
        }
        Ok(Self { number, of })
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_in_exactly_one_shard() {
        for parts in [0, 1, 2, 6, 7, 8, 95, 96, u64::MAX] {
            for of in [1, 2, 3, 7, 100, 1000] {
                let mut next = 0;
                for number in 1..=of {
                    let range = Shard { number, of }.parts(parts);
                    assert_eq!(range.start, next);
                    assert!(range.end - range.start <= (parts / of).saturating_add(1));
                    next = range.end;
                }
                assert_eq!(next, parts);
            }
        }
    }

    #[test]
    fn shards_are_read_strictly() {
        assert_eq!("2/7".parse(), Ok(Shard { number: 2, of: 7 }));
        for text in ["", "2", "/", "2/", "/7", "2/7/1", "+2/7", "-1/7", " 2/7", "a/b", "1/1e3"] {
            assert!(matches!(text.parse::<Shard>(), Err(ShardError::Form { .. })), "{text}");
        }
        for text in ["0/7", "8/7", "0/0", "1/0"] {
            assert!(matches!(text.parse::<Shard>(), Err(ShardError::Range { .. })), "{text}");
        }
    }

    /// Every record as long as one can be.
    #[test]
    fn the_longest_summary_is_not_too_long_to_be_read() {
        let record = crate::store::finished::PartRecord {
            file: format!("part-{MOST_PARTS:06}.parquet"),
            seeds: MOST_SEEDS..MOST_SEEDS,
            bytes: 99_999_999_999,
            sha256: "f".repeat(64),
        };
        let list = serde_json::json!({ "parts": [record] });
        let text = serde_json::to_string_pretty(&list).unwrap();
        let parts = text.len() as u64 * MOST_PARTS;
        // A quarter is left for the counts of outcomes.
        assert!(parts < crate::store::description::MAX_DESCRIPTION / 4 * 3, "{parts} bytes");
    }

    #[test]
    fn parts_are_powers_of_two_within_bounds() {
        for seeds in [0, 1, 1 << 16, (1 << 16) + 1, 1_000_000, u64::MAX] {
            let part = part_seeds(seeds);
            assert!(part.is_power_of_two() && (1 << 10..=1 << 24).contains(&part));
        }
        // The largest part of ordinary sweeps, as long as there are not too many of them.
        let ordinary = (1 << 16) * (1 << 20);
        assert_eq!([ordinary, ordinary + 1].map(part_seeds), [1 << 20, 1 << 21]);
        assert_eq!(MOST_SEEDS.div_ceil(part_seeds(MOST_SEEDS)), MOST_PARTS);
    }

    /// A shard of few is as many neighbouring shards of more together.
    #[test]
    fn shards_of_more_make_shards_of_few() {
        for parts in [0, 1, 5, 59_605] {
            for (number, of) in [(1, 1), (2, 3), (7, 7)] {
                let few = Shard { number, of }.parts(parts);
                for times in [1, 2, 10] {
                    let of = of * times;
                    let first = Shard { number: (number - 1) * times + 1, of }.parts(parts);
                    let last = Shard { number: number * times, of }.parts(parts);
                    assert_eq!(few, first.start..last.end);
                }
            }
        }
    }
}
