//! The lever rule in any arithmetic.

use std::ops::{Div, Sub};

/// What the ends of a bar carry of a load on it: `[(l - a) / l, a / l]` for a load at the distance
/// `a` from the first end of a bar of length `l`.
///
/// A weight is linear in the places of the ends, so it weighs on them as two point loads do. This
/// is the one place of the rule outside the two solvers, each of which derives its own.
///
/// ```
/// use numerics::{Interval, lever};
/// assert_eq!(lever(2.0, 0.5), [0.75, 0.25]);
/// let [near, far] = lever(Interval::point(3.0), Interval::ONE);
/// assert!(near.contains(2.0 / 3.0) && far.contains(1.0 / 3.0));
/// ```
pub fn lever<T>(length: T, at: T) -> [T; 2]
where
    T: Copy + Sub<Output = T> + Div<Output = T>,
{
    [(length - at) / length, at / length]
}
