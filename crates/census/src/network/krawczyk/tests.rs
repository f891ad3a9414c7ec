//! Boxes around points.

use super::*;

/// A quarter of the size of the part, four units in the last place of the point, and nothing besides.
#[test]
fn a_box_is_inflated_by_its_size_and_by_rounding() {
    let close = |found: Interval, [low, high]: [f64; 2]| {
        assert!((found.lo() - low).abs() < 1e-15 && (found.hi() - high).abs() < 1e-15, "{found:?}");
    };
    close(inflated(Interval::new(0.5, 1.0), 0.0), [-0.25, 1.25]);
    close(inflated(Interval::new(-2.0, -1.0), 0.0), [-2.5, 0.5]);
    let size = 2.0_f64.powi(40);
    let ulps = 4.0 * f64::EPSILON * size;
    close(inflated(Interval::new(0.5, 1.0), size), [-0.25 - ulps, 1.25 + ulps]);
    let least = inflated(Interval::ZERO, 0.0);
    assert!(least.lo() < 0.0 && least.hi() > 0.0 && least.width() < 1e-300);
}

#[test]
fn a_box_is_where_its_point_is() {
    let around = [Interval::ZERO, Interval::new(-0.25, 0.5)];
    let [point, part] = boxed(&[3.0, -2.0], &around)[..] else { panic!() };
    assert_eq!(point, Interval::point(3.0));
    assert!(part.encloses(Interval::new(-2.25, -1.5)) && part.width() < 0.75 + 1e-14, "{part:?}");
}
