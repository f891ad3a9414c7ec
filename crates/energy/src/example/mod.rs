//! The paper's example (section VIII, Solution 1): three equal bars, the anchors `2 l` apart on one
//! vertical, in the paper's own two unknowns.
//!
//! Angles are measured from the descending vertical, in radians; energies are in `mgl`, with the
//! paper's zero: `V` is 6 less when measured from the height of *O*.
//!
//! - [`potential`] and [`closure`]: (vi), and what (iii) and (iv) leave when beta is eliminated;
//! - [`candidates`]: the elimination of alpha (viii), false roots included, and which one closes;
//! - [`curve`]: the closed chains as a curve, with the energy and its slope along it;
//! - [`scan`]: the numbers (ix) and (x) the way the paper got them;
//! - [`minimise`]: the minimum the scan was looking for.

mod curve;
mod elimination;
mod minimise;
mod scan;

pub use curve::{Branch, CurvePoint, LARGEST_THETA_COSINE, alpha, beta, curve, slope};
pub use elimination::{Candidate, candidates, quadratic};
pub use minimise::{ExampleMinimum, minimise};
pub use scan::{PAPER_STEP_RAD, Printed, Scan, ScanMinimum, scan};

/// Potential energy (v) of the three angles, in `mgl`.
///
/// ```
/// use energy::example::{potential, potential_of_three};
/// // On a closed chain (iii) makes (v) and (vi) the same: theta = 0, alpha = beta = 60 deg.
/// let third = std::f64::consts::FRAC_PI_3;
/// assert!((potential_of_three(0.0, third, -third) - 2.5).abs() < 1e-15);
/// assert!((potential(0.0, third) - 2.5).abs() < 1e-15);
/// ```
pub fn potential_of_three(theta_rad: f64, alpha_rad: f64, beta_rad: f64) -> f64 {
    6.0 - 2.5 * theta_rad.cos() - 1.5 * alpha_rad.cos() - 0.5 * beta_rad.cos()
}

/// Potential energy (vi) of the two angles, in `mgl`.
///
/// ```
/// use energy::example::potential;
/// let [theta, alpha] = [19.694_867_976_133_02_f64, 38.599_136_184_451_89].map(f64::to_radians);
/// assert!((potential(theta, alpha) - 2.335_468_651_999_305).abs() < 1e-15);
/// ```
pub fn potential(theta_rad: f64, alpha_rad: f64) -> f64 {
    5.0 - 2.0 * theta_rad.cos() - alpha_rad.cos()
}

/// What (iii) and (iv) leave when beta is eliminated: the chain closes if and only if
///
/// $$f(\theta, \alpha) = (2 - \cos\theta - \cos\alpha)^2 + (\sin\theta + \sin\alpha)^2 - 1
///   = 5 - 4\cos\theta - 4\cos\alpha + 2\cos(\alpha - \theta) = 0 .$$
///
/// ```
/// use energy::example::closure;
/// // Bar 1 straight down: *A* and *D* are 1 l apart, and the other two stand at 60 degrees.
/// assert!(closure(0.0, std::f64::consts::FRAC_PI_3).abs() < 1e-15);
/// // Bars 1 and 2 straight down end at *D*, which bar 3 then misses by its length.
/// assert_eq!(closure(0.0, 0.0), -1.0);
/// ```
pub fn closure(theta_rad: f64, alpha_rad: f64) -> f64 {
    5.0 - 4.0 * theta_rad.cos() - 4.0 * alpha_rad.cos() + 2.0 * (alpha_rad - theta_rad).cos()
}

/// Gradient of [`potential`] by theta and alpha.
fn potential_gradient([theta, alpha]: [f64; 2]) -> [f64; 2] {
    [2.0 * theta.sin(), alpha.sin()]
}

/// Gradient of [`closure`] by theta and alpha.
fn closure_gradient([theta, alpha]: [f64; 2]) -> [f64; 2] {
    let across = 2.0 * (alpha - theta).sin();
    [4.0 * theta.sin() + across, 4.0 * alpha.sin() - across]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Central differences with one extrapolation.
    fn difference(f: impl Fn(f64) -> f64) -> f64 {
        let d = |h: f64| (f(h) - f(-h)) / (2.0 * h);
        (4.0 * d(5e-4) - d(1e-3)) / 3.0
    }

    #[test]
    fn gradients_are_their_difference_quotients() {
        for (t, a) in [(0.3, 0.7), (-1.1, 2.5), (3.0, -0.2), (0.0, 0.0)] {
            for (gradient, f) in [
                (potential_gradient([t, a]), potential as fn(f64, f64) -> f64),
                (closure_gradient([t, a]), closure as fn(f64, f64) -> f64),
            ] {
                assert!((gradient[0] - difference(|h| f(t + h, a))).abs() < 1e-11);
                assert!((gradient[1] - difference(|h| f(t, a + h))).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn the_closure_is_the_squared_distance_that_bar_three_has_to_bridge() {
        for (t, a) in [(0.3_f64, 0.7_f64), (-1.1, 2.5), (3.0, -0.2)] {
            let (x, y) = (2.0 - t.cos() - a.cos(), t.sin() + a.sin());
            assert!((closure(t, a) - (x * x + y * y - 1.0)).abs() < 1e-14);
        }
    }
}
