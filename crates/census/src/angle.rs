//! The angle of a vector, enclosed, without the system's libm.

use crate::Interval;

/// π: the double below and the one above (3.14159265358979311 < π < 3.14159265358979357).
pub(crate) const PI: Interval =
    Interval::ordered(std::f64::consts::PI, f64::from_bits(std::f64::consts::PI.to_bits() + 1));

/// How often the angle is halved: then |x| < tan(π/16) < 0.2.
const HALVINGS: usize = 3;

/// Terms of the series for |x| < 0.2: the first one left out is below 0.2²⁷/27 < 2⁻⁶⁷.
const TERMS: u32 = 13;

/// The angle of (x, y) from the first axis, in (−π, π]; both ends may lie in (π, 2π) if the vectors
/// straddle the negative axis. The vectors must not contain zero, else nothing is known.
///
/// # References
///
/// The alternating series and the halving formula atan x = 2 atan(x/(1 + √(1 + x²))): NIST Digital
/// Library of Mathematical Functions, 4.24.3 and 4.24.17, <https://dlmf.nist.gov/4.24>
pub(crate) fn of_vector([x, y]: [Interval; 2]) -> Interval {
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
    // x (1 - x²/3 + x⁴/5 - ...): the error is less than the first term left out.
    let square = x.square();
    let mut sum = Interval::around(0.0, square.mag().powi(TERMS.cast_signed()));
    for term in (0..TERMS).rev() {
        let coefficient = Interval::ONE / Interval::point(f64::from(2 * term + 1));
        sum = coefficient - square * sum;
    }
    // Horner's scheme gave the sum with its first term positive whatever the number of terms.
    (x * sum).scale(f64::from(1 << HALVINGS))
}

#[cfg(test)]
mod tests {
    use super::*;
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
                let angle = of_vector([x, y]).abs();
                let expected = PI / Interval::point(parts);
                assert!(!angle.misses(expected), "{angle:?} {expected:?}");
                assert!(angle.width() < 4e-15, "{:e}", angle.width());
            }
            let obtuse = of_vector([-vector[0], vector[1]]);
            let expected = PI - PI / Interval::point(parts);
            assert!(!obtuse.misses(expected) && obtuse.width() < 8e-15);
        }
        assert_eq!(of_vector([Interval::ZERO, Interval::ZERO]), Interval::new(-PI.hi(), PI.hi()));
    }

    proptest! {
        /// An independent method: the system's `atan2`, good to a unit or two in the last place.
        #[test]
        fn the_systems_atan2_is_enclosed(x in -2.0..2.0f64, y in -2.0..2.0f64) {
            prop_assume!(x.hypot(y) > 1e-3);
            let angle = of_vector([Interval::point(x), Interval::point(y)]);
            let reference = y.atan2(x);
            let slack = 4.0 * f64::EPSILON * reference.abs().max(1e-300);
            prop_assert!(angle.lo() - slack <= reference && reference <= angle.hi() + slack);
            prop_assert!(angle.width() < 1e-14);
        }
    }
}
