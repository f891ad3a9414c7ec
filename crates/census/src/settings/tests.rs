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
        assert_eq!(told(Settings { max_bridle_bars: bars, ..usual }), name("max_bridle_bars"));
    }
    for (min_width, right) in [
        (0.99 * 2.0_f64.powi(-48), false),
        (2.0_f64.powi(-48), true),
        (2.0_f64.powi(-4), true),
        (1.01 * 2.0_f64.powi(-4), false),
        (f64::NAN, false),
    ] {
        assert_eq!(told(Settings { min_width, ..usual }), if right { "" } else { "min_width" });
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
    assert_eq!(usual.min_width.to_bits(), 2.0_f64.powi(-40).to_bits());
}
