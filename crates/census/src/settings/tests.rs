//! Every field at both ends of its range.

use super::*;

#[test]
fn fields_out_of_range_are_named() {
    let usual = Settings::default();
    let told = |settings: Settings| match settings.validate() {
        Ok(()) => "",
        Err(CensusError::Setting { name, .. }) => name,
        Err(other) => panic!("{other}"),
    };
    for (bars, right) in [(0, false), (1, true), (24, true), (25, false)] {
        let name = |name: &'static str| if right { "" } else { name };
        assert_eq!(told(Settings { max_bars: bars, ..usual }), name("max_bars"));
    }
    for (tests, right) in [(0, false), (1, true), (1_000_000_000, true), (1_000_000_001, false)] {
        let settings = Settings { max_tests_per_pattern: tests, ..usual };
        assert_eq!(told(settings), if right { "" } else { "max_tests_per_pattern" });
    }
    for (max_motions, right) in [(0, false), (1, true), (6, true), (7, false)] {
        let settings = Settings { max_motions, ..usual };
        assert_eq!(told(settings), if right { "" } else { "max_motions" });
    }
    assert_eq!(told(usual), "");
}
