//! Numbers of a census.

use super::*;
use crate::settings::Settings;

#[test]
fn patterns_are_a_power_of_two_or_too_many() {
    let mut census = Census::take(&model::cases::paper(), &Settings::default()).unwrap();
    for (bars, patterns) in [(3, 8), (1, 2), (63, 1 << 63), (64, u64::MAX), (usize::MAX, u64::MAX)]
    {
        census.statistics.bars = bars;
        assert_eq!(census.patterns(), patterns, "{bars}");
    }
}
