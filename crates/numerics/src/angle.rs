//! The angle of a vector, enclosed, without the system's libm.

use std::sync::LazyLock;

use crate::interval::Interval;

/// π: the double below and the one above (3.14159265358979311 < π < 3.14159265358979357).
///
/// ```
/// assert!(numerics::PI.width() < 5e-16);
/// ```
pub const PI: Interval =
    Interval::ordered(std::f64::consts::PI, f64::from_bits(std::f64::consts::PI.to_bits() + 1));

/// How often the angle is halved: then |x| < tan(π/16) < 0.2.
const HALVINGS: usize = 3;

/// Terms of the series for |x| < 0.2: the first one left out is below 0.2²⁷/27 < 2⁻⁶⁷, far below
/// the last place of x.
const TERMS: usize = 13;

/// The angle of the vector (x, y) from the first axis, rad, in (−π, π]; both ends may lie in (π,
/// 2π) if the vectors straddle the negative axis. If they contain zero nothing is known: all of
/// [−π, π].
///
/// ```
/// use numerics::{Interval, PI, atan2};
/// let angle = atan2(Interval::ONE, Interval::ONE);
/// assert!(!angle.disjoint(PI.scale(0.25)) && angle.width() < 4e-15);
/// ```
///
/// # References
///
/// The alternating series and the halving formula atan x = 2 atan(x/(1 + √(1 + x²))): NIST Digital
/// Library of Mathematical Functions, 4.24.3 and 4.24.17, <https://dlmf.nist.gov/4.24>
pub fn atan2(y: Interval, x: Interval) -> Interval {
    let half_pi = PI.scale(0.5);
    if x.mid().abs() >= y.mid().abs() {
        if x.lo() > 0.0 {
            return tangent_inverse(y / x);
        }
        if x.hi() < 0.0 {
            let turn = if y.mid() < 0.0 { -PI } else { PI };
            return turn + tangent_inverse(y / x);
        }
    } else if y.lo() > 0.0 {
        return half_pi - tangent_inverse(x / y);
    } else if y.hi() < 0.0 {
        return -half_pi - tangent_inverse(x / y);
    }
    Interval::new(-PI.hi(), PI.hi())
}

/// The inverse tangent; it grows with its argument.
fn tangent_inverse(x: Interval) -> Interval {
    let low = at(x.lo());
    if x.width() > 0.0 { Interval::new(low.lo(), at(x.hi()).hi()) } else { low }
}

fn at(x: f64) -> Interval {
    let mut x = Interval::point(x);
    for _ in 0..HALVINGS {
        x = x / (Interval::ONE + (Interval::ONE + x.square()).sqrt());
    }
    (x * series(x.square(), TERMS)).scale(f64::from(1 << HALVINGS))
}

/// (atan √s)/√s = 1 − s/3 + s²/5 − ... for the numbers s of 0..1 in the interval.
///
/// With the rests R_k = 1/(2k + 1) − s/(2k + 3) + ... it is R_0, and R_k = 1/(2k + 1) − s R_{k+1}.
/// The terms of `R_k` alternate in sign and do not grow for s ≤ 1, so `R_k` lies between 0 and its
/// first term 1/(2k + 1). From that enclosure of the first rest left out, k = `terms`, Horner's
/// scheme goes down to k = 0; each step multiplies its width by s, and in the end it is
/// s^`terms`/(2 `terms` + 1), the first term left out.
fn series(square: Interval, terms: usize) -> Interval {
    let first_of_rest: &[Interval; TERMS + 1] = &FIRST_OF_REST;
    let rest = Interval::ZERO.hull(first_of_rest[terms]);
    first_of_rest[..terms].iter().rev().fold(rest, |rest, first| *first - square * rest)
}

/// 1/(2k + 1), the first term of each rest.
static FIRST_OF_REST: LazyLock<[Interval; TERMS + 1]> =
    LazyLock::new(|| std::array::from_fn(|k| Interval::ONE / Interval::point((2 * k + 1) as f64)));

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double_double::DoubleDouble;
    use proptest::prelude::*;

    #[test]
    fn known_angles_are_enclosed_and_narrow() {
        // tan(π/6) = 1/√3, tan(π/8) = √2 − 1: both angles are π over an integer.
        let three = Interval::point(3.0).sqrt();
        let eighth = Interval::point(2.0).sqrt() - Interval::ONE;
        for (vector, parts) in [
            ([three, Interval::ONE], 6.0),
            ([Interval::ONE, three], 3.0),
            ([Interval::ONE, Interval::ONE], 4.0),
            ([Interval::ONE, eighth], 8.0),
            ([Interval::ZERO, Interval::ONE], 2.0),
        ] {
            for [x, y] in [vector, [vector[0], -vector[1]]] {
                let angle = atan2(y, x).abs();
                let expected = PI / Interval::point(parts);
                assert!(!angle.disjoint(expected), "{angle:?} {expected:?}");
                assert!(angle.width() < 4e-15, "{:e}", angle.width());
            }
            let obtuse = atan2(vector[1], -vector[0]);
            let expected = PI - PI / Interval::point(parts);
            assert!(!obtuse.disjoint(expected) && obtuse.width() < 8e-15);
        }
        assert_eq!(atan2(Interval::ZERO, Interval::ZERO), Interval::new(-PI.hi(), PI.hi()));
    }

    /// The sine is above zero before π and below it after.
    #[test]
    fn pi_is_between_its_ends() {
        let sine = |angle: f64| turn(angle)[1].interval();
        assert!(sine(PI.lo()).lo() > 0.0 && sine(PI.hi()).hi() < 0.0, "{PI:?}");
    }

    /// On the axes, and where a box ends in the origin's line: the upper half has the angle π, and
    /// of what may point anywhere nothing is known.
    #[test]
    fn ends_on_the_axes() {
        let level = atan2(Interval::ZERO, Interval::point(-1.0));
        assert!(level.contains(std::f64::consts::PI) && level.width() < 4e-15, "{level:?}");
        let everything = Interval::new(-PI.hi(), PI.hi());
        for [x, y] in
            [[[-1.0, 1.0], [0.0, 4.0]], [[-1.0, 1.0], [-4.0, 0.0]], [[0.0, 4.0], [-1.0, 1.0]]]
        {
            let angle = atan2(Interval::new(y[0], y[1]), Interval::new(x[0], x[1]));
            assert_eq!(angle, everything);
        }
    }

    /// With few terms the rest that is left out is far above all roundings: the enclosure must hold
    /// it, and be no wider than the first term left out.
    #[test]
    fn the_rest_of_the_series_is_enclosed() {
        for terms in 1..TERMS {
            for x in [0.02, 0.1, 0.2, 0.5, 0.9_f64] {
                let sum = series(Interval::point(x).square(), terms);
                let reference = inverse_tangent(x) / DoubleDouble::point(x);
                let below = (reference - DoubleDouble::point(sum.lo())).interval().lo();
                let above = (DoubleDouble::point(sum.hi()) - reference).interval().lo();
                assert!(
                    below.min(above) >= -1e-26,
                    "{terms} terms at {x}: {sum:?}, off by {below:e} and {above:e}"
                );
                let left_out =
                    x.powf(2.0 * terms as f64) / (2 * terms + 1) as f64 + 64.0 * f64::EPSILON;
                assert!(sum.width() <= left_out, "{terms} terms at {x}: {:e}", sum.width());
            }
        }
    }

    /// The angle whose tangent is x, to 30 digits: one step of Newton's method from the system's.
    fn inverse_tangent(x: f64) -> DoubleDouble {
        let first = x.atan();
        let ([cos, sin], x) = (turn(first), DoubleDouble::point(x));
        // The sine of what is missing, over its cosine; the cube of it is below 1e-45.
        DoubleDouble::point(first) + (x * cos - sin) / (cos + x * sin)
    }

    /// Cosine and sine to 30 digits: Taylor's series of a 64th of the angle, doubled six times.
    fn turn(angle: f64) -> [DoubleDouble; 2] {
        let one = DoubleDouble::point(1.0);
        let t = DoubleDouble::point(angle).scale(1.0 / 64.0);
        let (mut cos, mut sin, mut term) = (one, t, t);
        for k in 1..12 {
            term = term * t / DoubleDouble::point(f64::from(2 * k));
            cos = if k % 2 == 1 { cos - term } else { cos + term };
            term = term * t / DoubleDouble::point(f64::from(2 * k + 1));
            sin = if k % 2 == 1 { sin - term } else { sin + term };
        }
        for _ in 0..6 {
            sin = (sin * cos).scale(2.0);
            cos = cos.square().scale(2.0) - one;
        }
        [cos, sin]
    }

    /// Whether the vector (x, y) lies to the left of the angle, at most half a turn.
    fn is_left(x: f64, y: f64, angle: f64) -> bool {
        let [cos, sin] = turn(angle);
        let cross = DoubleDouble::point(y) * cos - DoubleDouble::point(x) * sin;
        cross.interval().lo() >= -1e-26 * x.hypot(y)
    }

    proptest! {
        /// By the sine and cosine of both ends, without any slack but the 26th digit: the vector
        /// lies to the left of the lower end and to the right of the upper one.
        #[test]
        fn the_angle_is_between_the_ends(x in -2.0..2.0f64, y in -2.0..2.0f64) {
            prop_assume!(x.hypot(y) > 1e-3);
            let angle = atan2(Interval::point(y), Interval::point(x));
            prop_assert!(is_left(x, y, angle.lo()), "{x} {y}: {angle:?}");
            prop_assert!(is_left(x, -y, -angle.hi()), "{x} {y}: {angle:?}");
            prop_assert!((angle.mid() - y.atan2(x)).abs() < 1e-14);
            prop_assert!(angle.width() < 1e-14);
        }

        /// Of vectors that are not known exactly all angles are enclosed.
        #[test]
        fn angles_of_boxes_are_enclosed(
            x in -2.0..2.0f64, y in -2.0..2.0f64, s in 0.0..1.0f64, t in 0.0..1.0f64,
        ) {
            prop_assume!(x.hypot(y) > 0.2);
            let wide = |from: f64| Interval::new(from - 0.05, from + 0.05);
            let angle = atan2(wide(y), wide(x));
            let (u, v) = (x - 0.05 + 0.1 * s, y - 0.05 + 0.1 * t);
            let one = v.atan2(u);
            let turned = one + 2.0 * std::f64::consts::PI;
            let slack = 1e-14;
            let within = |a: f64| angle.lo() - slack <= a && a <= angle.hi() + slack;
            prop_assert!(within(one) || within(turned) || within(one - 2.0 * std::f64::consts::PI));
            // A tenth across, a fifth away.
            prop_assert!(angle.width() < 1.6);
        }
    }
}
