//! Vectors of three components, and maxima that remember NaN.

use model::Vector;

/// `a + b`.
pub(crate) fn plus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] + b[k])
}

/// `a − b`.
pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

/// `c a`.
pub(crate) fn times(c: f64, a: Vector) -> Vector {
    a.map(|x| c * x)
}

/// `a · b`.
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a × b`.
pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `|a|`, free of overflow in between.
pub(crate) fn norm([x, y, z]: Vector) -> f64 {
    x.hypot(y).hypot(z)
}

/// The larger of two violations; NaN is the worst of all (`f64::max` would forget it).
pub(crate) fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// What of a violation is beyond the rounding; NaN stays NaN.
pub(crate) fn beyond(violation: f64, rounding: f64) -> f64 {
    if violation <= rounding { 0.0 } else { violation - rounding }
}
