//! The energy of all configurations.

use paper::bounds::Bounds;

use crate::claims::solved;

#[test]
fn e1_is_the_global_minimum_and_e2_the_global_maximum() {
    let bounds = Bounds::compute(&solved().0).unwrap();
    assert!(bounds.are_tight(), "{bounds:?}");
    // The roots of the sextic, to 30 digits.
    assert!((bounds.lower_mgl - 2.335_468_651_999_305).abs() < 1e-12, "{bounds:?}");
    assert!((bounds.upper_mgl - 3.664_531_348_000_695).abs() < 1e-12, "{bounds:?}");
    // Closed form: with slack cables the chain hangs straight down, V = 6 - 2.5 - 1.5 = 2.
    // clarabel's tolerance is 1e-9.
    assert!((bounds.cables_mgl - 2.0).abs() < 1e-8, "{bounds:?}");
    for gap in [f64::NAN, -1e-6, 1e-6] {
        assert!(!Bounds { gap_to_e1_mgl: gap, ..bounds }.are_tight());
        assert!(!Bounds { gap_to_e2_mgl: gap, ..bounds }.are_tight());
    }
}
