//! The largest of some values.

use super::worst;

#[test]
fn the_worst_value_is_the_largest_or_none_at_all() {
    let of = |values: &[f64]| worst(values.iter().copied());
    assert_eq!(of(&[0.5, 2.0, 1.0]).to_bits(), 2.0_f64.to_bits());
    assert_eq!(of(&[]).to_bits(), 0.0_f64.to_bits());
    for values in [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]] {
        assert!(of(&values).is_nan(), "{values:?}");
    }
}
