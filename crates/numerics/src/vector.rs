//! Vectors of three components: of doubles, or of anything that has the arithmetic of numbers.

use std::ops::{Add, Mul, Sub};

/// `a + b`.
#[inline]
pub fn plus<T: Copy + Add<Output = T>>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a − b`.
#[inline]
pub fn minus<T: Copy + Sub<Output = T>>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `c a`.
#[inline]
pub fn times<T: Copy + Mul<Output = T>>(c: T, a: [T; 3]) -> [T; 3] {
    [c * a[0], c * a[1], c * a[2]]
}

/// `a + c b`.
#[inline]
pub fn add_times<T: Copy + Add<Output = T> + Mul<Output = T>>(
    a: [T; 3],
    c: T,
    b: [T; 3],
) -> [T; 3] {
    plus(a, times(c, b))
}

/// `a · b`.
///
/// ```
/// use numerics::vector::{cross, dot};
/// let [a, b] = [[3.0, 4.0, 12.0], [1.0, -2.0, 0.5]];
/// assert_eq!(dot(a, b), 1.0);
/// assert_eq!(cross(a, b), [26.0, 10.5, -10.0]);
/// ```
#[inline]
pub fn dot<T: Copy + Add<Output = T> + Mul<Output = T>>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a × b`.
#[inline]
pub fn cross<T: Copy + Sub<Output = T> + Mul<Output = T>>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `|a|`, free of overflow in between.
#[inline]
pub fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

/// The larger of two sizes; NaN is the largest of all (`f64::max` would forget it).
#[inline]
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// What of a size is beyond the rounding; NaN stays NaN.
#[inline]
pub fn beyond(size: f64, rounding: f64) -> f64 {
    if size <= rounding { 0.0 } else { size - rounding }
}
