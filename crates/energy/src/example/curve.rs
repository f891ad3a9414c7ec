//! The closed chains of the example as a curve.

use std::f64::consts::PI;

use super::{closure_gradient, potential, potential_gradient};

/// The smallest cosine of theta on the curve: beyond it bars 2 and 3, drawn out, do not reach *D*.
pub const LARGEST_THETA_COSINE: f64 = 0.25;

/// The two solutions of (viii), named after the quadrant of alpha at small positive theta, as in
/// the paper. They meet where theta is largest (and smallest).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Branch {
    /// The larger alpha: the paper's `alpha_1`.
    FirstQuadrant,
    /// The smaller alpha: the paper's `alpha_2`.
    FourthQuadrant,
}

impl Branch {
    /// Both, in the paper's order.
    pub const BOTH: [Self; 2] = [Self::FirstQuadrant, Self::FourthQuadrant];
}

/// Alpha on a branch, rad, in (-pi, pi); `None` out of reach.
///
/// By geometry, without the squaring of (viii): bars 2 and 3 span the vector from *A* to *D*,
/// `(2 - cos(theta), -sin(theta))`, of length `rho` and angle `phi`; being equal they lean from it
/// by `arccos(rho / 2)` to either side.
///
/// ```
/// use energy::example::{Branch, alpha};
/// let third = std::f64::consts::FRAC_PI_3;
/// assert!((alpha(0.0, Branch::FirstQuadrant).unwrap() - third).abs() < 1e-15);
/// assert!((alpha(0.0, Branch::FourthQuadrant).unwrap() + third).abs() < 1e-15);
/// // Bars 2 and 3 drawn out reach no farther than cos(theta) = 1/4.
/// assert!(alpha(0.25_f64.acos() + 1e-6, Branch::FirstQuadrant).is_none());
/// ```
pub fn alpha(theta_rad: f64, branch: Branch) -> Option<f64> {
    let (sin, cos) = theta_rad.sin_cos();
    if cos.is_nan() || cos < LARGEST_THETA_COSINE {
        return None;
    }
    let (down, across) = (2.0 - cos, -sin);
    let lean = (0.5 * down.hypot(across)).min(1.0).acos();
    let phi = across.atan2(down);
    Some(match branch {
        Branch::FirstQuadrant => phi + lean,
        Branch::FourthQuadrant => phi - lean,
    })
}

/// Beta that closes the chain, by (iii) and (iv), rad, in (-pi, pi].
///
/// ```
/// let third = std::f64::consts::FRAC_PI_3;
/// assert!((energy::example::beta(0.0, third) + third).abs() < 1e-15);
/// ```
pub fn beta(theta_rad: f64, alpha_rad: f64) -> f64 {
    (-theta_rad.sin() - alpha_rad.sin()).atan2(2.0 - theta_rad.cos() - alpha_rad.cos())
}

/// Slope `dV/dtheta` of the energy along the curve, `mgl` per rad.
///
/// $$\frac{dV}{d\theta} = V_\theta - V_\alpha \frac{f_\theta}{f_\alpha}$$
///
/// Infinite at the ends of the curve, where it turns back in theta; NaN off it.
///
/// ```
/// use energy::example::{Branch, slope};
/// // What the paper prints as its second equilibrium, theta = 0.001 rad, lies on a slope ...
/// assert!((slope(0.001, Branch::FourthQuadrant) - 0.867_521_5).abs() < 1e-7);
/// // ... that is sin(60 deg) where the scan begins, and goes on beyond.
/// assert!((slope(0.0, Branch::FourthQuadrant) - 0.75_f64.sqrt()).abs() < 1e-14);
/// ```
pub fn slope(theta_rad: f64, branch: Branch) -> f64 {
    let Some(alpha_rad) = alpha(theta_rad, branch) else { return f64::NAN };
    let v = potential_gradient([theta_rad, alpha_rad]);
    let f = closure_gradient([theta_rad, alpha_rad]);
    v[0] - v[1] * f[0] / f[1]
}

/// A closed chain of the example.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Angle of bar 1 from the descending vertical, rad.
    pub theta_rad: f64,
    /// Angle of bar 2, rad.
    pub alpha_rad: f64,
    /// Angle of bar 3, rad.
    pub beta_rad: f64,
    /// Potential energy (vi), `mgl`.
    pub energy_mgl: f64,
    /// The branch of (viii).
    pub branch: Branch,
}

impl CurvePoint {
    fn at(theta_rad: f64, branch: Branch) -> Option<Self> {
        let alpha_rad = alpha(theta_rad, branch)?;
        Some(Self {
            theta_rad,
            alpha_rad,
            beta_rad: beta(theta_rad, alpha_rad),
            energy_mgl: potential(theta_rad, alpha_rad),
            branch,
        })
    }
}

/// The closed curve once around, `points` on each branch, for plotting: the first branch from the
/// largest theta to the smallest, the second one back.
///
/// Theta goes like a cosine, so that the points stay evenly spread where the curve turns back.
///
/// ```
/// let curve = energy::example::curve(500);
/// let lowest = curve.iter().map(|p| p.energy_mgl).fold(f64::INFINITY, f64::min);
/// assert!((lowest - 2.335_468_65).abs() < 1e-4);
/// ```
pub fn curve(points: usize) -> Vec<CurvePoint> {
    let largest = LARGEST_THETA_COSINE.acos();
    let theta = |k: usize| largest * (PI * (k as f64 + 0.5) / points as f64).cos();
    let back = (0..points).rev().map(|k| (theta(k), Branch::FourthQuadrant));
    (0..points)
        .map(|k| (theta(k), Branch::FirstQuadrant))
        .chain(back)
        .filter_map(|(theta, branch)| CurvePoint::at(theta, branch))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{candidates, closure, potential_of_three};

    #[test]
    fn every_point_closes_by_iii_and_iv_and_has_the_energy_v() {
        let curve = curve(100);
        assert_eq!(curve.len(), 200);
        for p in curve {
            let [t, a, b] = [p.theta_rad, p.alpha_rad, p.beta_rad];
            assert!(closure(t, a).abs() < 1e-14);
            assert!((t.cos() + a.cos() + b.cos() - 2.0).abs() < 1e-14);
            assert!((t.sin() + a.sin() + b.sin()).abs() < 1e-14);
            assert!((potential_of_three(t, a, b) - p.energy_mgl).abs() < 1e-14);
        }
    }

    #[test]
    fn the_branches_are_the_closing_candidates_of_viii() {
        for theta in [0.001, 0.344, 0.7, 1.2] {
            let closing: Vec<f64> =
                candidates(theta).iter().filter(|c| c.closes).map(|c| c.alpha_rad).collect();
            for branch in Branch::BOTH {
                let alpha = alpha(theta, branch).unwrap();
                // arccos loses half the digits where a branch passes alpha = 0.
                assert!(closing.iter().any(|c| (c - alpha).abs() < 1e-8), "{theta} {branch:?}");
            }
        }
    }

    #[test]
    fn the_slope_is_its_difference_quotient() {
        for branch in Branch::BOTH {
            for theta in [-1.0, -0.3, 0.001, 0.344, 1.1] {
                let v = |h: f64| CurvePoint::at(theta + h, branch).unwrap().energy_mgl;
                let d = |h: f64| (v(h) - v(-h)) / (2.0 * h);
                let quotient = (4.0 * d(5e-4) - d(1e-3)) / 3.0;
                assert!((slope(theta, branch) - quotient).abs() < 1e-9, "{branch:?} {theta}");
            }
        }
    }

    /// Chebyshev's points between the ends of the curve, there on one branch and back on the other.
    #[test]
    fn points_are_those_of_chebyshev() {
        let end = 0.25_f64.acos();
        // cos(pi/8) and cos(3 pi/8).
        let (far, near) = (0.923_879_532_511_286_7 * end, 0.382_683_432_365_089_8 * end);
        let thetas = [far, near, -near, -far, -far, -near, near, far];
        let found = curve(4);
        assert_eq!(found.len(), 8);
        for (point, theta) in found.iter().zip(thetas) {
            assert!((point.theta_rad - theta).abs() < 1e-15);
        }
    }
}
