//! Vectors of three components.

use model::Vector;

/// `a + b`.
#[inline]
pub(crate) fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a − b`.
#[inline]
pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `c a`.
#[inline]
pub(crate) fn times(c: f64, a: Vector) -> Vector {
    [c * a[0], c * a[1], c * a[2]]
}

/// `a + c b`.
#[inline]
pub(crate) fn add_times(a: Vector, c: f64, b: Vector) -> Vector {
    [a[0] + c * b[0], a[1] + c * b[1], a[2] + c * b[2]]
}

/// `a · b`.
#[inline]
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a × b`.
#[inline]
pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `|a|`, free of overflow in between.
#[inline]
pub(crate) fn norm([x, y, z]: Vector) -> f64 {
    x.hypot(y).hypot(z)
}

/// The larger of two sizes; NaN is the largest of all (`f64::max` would forget it).
#[inline]
pub(crate) fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
