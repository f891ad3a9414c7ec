//! The spin of a bar about its own axis: what makes the paper's system singular, and the choice of
//! angles that keeps it harmless.
//!
//! A bar has three angles and only two of them can be felt: a turn about its own axis moves nothing
//! ("three of them being useless", section III). In angles this turn is the kernel of
//! $\partial u/\partial(\psi,\theta,\varphi)$,
//!
//! $$ v = (\cos\varphi,\ \cos\theta\sin\varphi,\ -\sin\theta\cos\varphi), $$
//!
//! the solution of $\mathbf{Q}\\,v \parallel e_x$ with $\mathbf{Q}$ of eq. (23). No moment row of
//! (40) has a component along it and no equation of the system changes with it, so it is a *gauge*:
//! the solver takes no step along it.
//!
//! Where $\cos\theta = \cos\varphi = 0$ the vector vanishes. Two angles then turn the bar in the
//! same way and the third does not turn it at all: the paper's equations lose one of the two moment
//! balances of that bar and admit **false roots**, states that satisfy all 6n + 3(n+1) equations
//! and are no equilibria. They are isolated, and Newton's method converges to them like to any
//! other root: on the paper's chain from 4 % of random spatial seeds. The cure is to describe the
//! bar by other angles ([`regular_angles`]): the same direction, another spin.

use nalgebra::Vector3;

use crate::full::rotation::Frame;

/// Angles $(\dot\psi, \dot\theta, \dot\varphi)$ of a spin about the bar's own axis: the kernel of
/// [`direction_gradient`](crate::direction_gradient).
///
/// Its length is the product of the two singular values of that gradient: 0 where a moment balance
/// is lost, at most √2.
///
/// ```
/// use nalgebra::Vector3;
/// let (psi, theta, phi) = (0.3, 1.1, -0.7);
/// let lost = lagrange::direction_gradient(psi, theta, phi) * lagrange::spin(theta, phi);
/// assert!(lost.norm() < 1e-15);
/// ```
pub fn spin(theta: f64, phi: f64) -> Vector3<f64> {
    // The axis does not depend on psi, the first turn.
    Frame::new([0.0, theta, phi]).spin()
}

/// Angles of a bar with the given direction, as far from a lost moment balance as they can be:
/// $\varphi = 0$, where $|v| \ge 1$.
pub(crate) fn regular_angles(direction: &Vector3<f64>) -> [f64; 3] {
    let across = direction.y.hypot(direction.z);
    // At the poles u = ±e_x any psi serves; atan2(0, 0) = 0 and atan2(0, -0) = pi both do.
    [direction.y.atan2(-direction.z), across.atan2(direction.x), 0.0]
}

/// Two orthonormal directions of angle space across the spin: all that a step may use.
///
/// `v` need not be normalised; a zero vector gives some orthonormal pair.
pub(crate) fn across(v: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let norm = v.norm();
    let axis = if norm > 0.0 { v / norm } else { Vector3::x() };
    // Duff et al., J. Comput. Graph. Tech. 6(1) (2017) 1-8: an orthonormal basis without a branch
    // that could divide by a small number.
    let sign = 1.0_f64.copysign(axis.z);
    let a = -1.0 / (sign + axis.z);
    let b = axis.x * axis.y * a;
    [
        Vector3::new(1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x),
        Vector3::new(b, sign + axis.y * axis.y * a, -axis.y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_angles_have_their_direction_and_a_long_spin() {
        // The axes, +Y where the paper's psi = 0, theta = pi/2 loses a moment balance, and all
        // around.
        let axes = [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::z()];
        let around = (0..200)
            .map(f64::from)
            .map(|k| Vector3::new(k.sin(), (2.0 * k).cos(), (3.0 * k).sin()).normalize());
        for u in axes.into_iter().chain(around) {
            let angles = regular_angles(&u);
            assert!((Frame::new(angles).direction() - u).norm() < 1e-15);
            assert!(spin(angles[1], angles[2]).norm() >= 1.0 - 1e-15);
        }
    }

    #[test]
    fn directions_across_are_a_right_handed_pair() {
        let vectors =
            [[2.0, 3.0, 6.0], [-6.0, 2.0, -3.0], [0.0, 0.0, -1.0], [1e-200, 0.0, 0.0], [0.0; 3]];
        for v in vectors.map(Vector3::from) {
            let [a, b] = across(&v);
            let axis = if v.norm() > 0.0 { v / v.norm() } else { Vector3::x() };
            assert!((a.cross(&b) - axis).norm() < 1e-15, "{v}");
            assert!((a.norm() - 1.0).abs() < 1e-15 && a.dot(&b).abs() < 1e-15, "{v}");
        }
    }
}
