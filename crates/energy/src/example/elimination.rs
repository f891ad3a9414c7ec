//! The elimination of alpha: equation (viii) and its false roots.

use super::closure;

/// Coefficients of (viii), `a cos²(alpha) + b cos(alpha) + c = 0`, for a given theta.
///
/// ```
/// // Bar 1 straight down: 4 c² - 4 c + 1 = 0 has the double root 1/2, alpha = 60 degrees.
/// assert_eq!(energy::example::quadratic(0.0), [4.0, -4.0, 1.0]);
/// ```
///
/// Equation (viii) of the paper (the second one of that number).
pub fn quadratic(theta_rad: f64) -> [f64; 3] {
    let (sin, cos) = theta_rad.sin_cos();
    [
        20.0 - 16.0 * cos,
        2.0 * (26.0 * cos - 20.0 - 8.0 * cos * cos),
        16.0 * cos * cos + 25.0 - 40.0 * cos - 4.0 * sin * sin,
    ]
}

/// An angle alpha whose cosine solves (viii).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The root of (viii).
    pub cos_alpha: f64,
    /// One of the two angles with this cosine, rad.
    pub alpha_rad: f64,
    /// [`closure`] at this angle: how far bar 3 is from reaching *D*.
    pub closure: f64,
    /// Whether this is the angle of the two that closes.
    pub closes: bool,
}

/// All candidates for alpha at a given theta: two roots of (viii), two signs of the sine each.
///
/// Squaring to get rid of `sin(alpha)` made (viii) blind to its sign, so of the two angles that
/// share a root only one closes the chain. Before the squaring the closure reads
///
/// $$2 \sin\theta \sin\alpha = 4\cos\theta + 4\cos\alpha - 5 - 2\cos\theta\cos\alpha,$$
///
/// whose right-hand side decides the sign; [`Candidate::closure`] shows what the other sign leaves
/// by. Empty where theta is out of reach, `cos(theta) < 1/4`.
///
/// ```
/// let [minus, plus, ..] = energy::example::candidates(0.344)[..] else { panic!() };
/// assert_eq!(minus.cos_alpha, plus.cos_alpha);
/// assert!(!minus.closes && minus.closure.abs() > 0.4);
/// assert!(plus.closes && plus.closure.abs() < 1e-14);
/// ```
pub fn candidates(theta_rad: f64) -> Vec<Candidate> {
    let [a, b, c] = quadratic(theta_rad);
    let square = b * b - 4.0 * a * c;
    if square.is_nan() || square < 0.0 {
        return Vec::new();
    }
    // b is negative for every theta (26 x - 20 - 8 x² has no real root), so nothing cancels here.
    let sum = 0.5 * (square.sqrt() - b);
    let mut all = Vec::with_capacity(4);
    for cos_alpha in [sum / a, c / sum] {
        // Rounding may carry a root past 1 where alpha passes 0.
        let size = cos_alpha.clamp(-1.0, 1.0).acos();
        let pair = [-size, size].map(|alpha| (alpha, closure(theta_rad, alpha)));
        let closes = usize::from(pair[1].1.abs() <= pair[0].1.abs());
        for (k, (alpha_rad, closure)) in pair.into_iter().enumerate() {
            all.push(Candidate { cos_alpha, alpha_rad, closure, closes: k == closes });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quadratic_follows_from_the_closure() {
        // With s = sin(alpha) the closure is p - q s; (viii) is p² - q² (1 - cos²(alpha)).
        for theta in [0.001_f64, 0.344, 1.2, -0.7] {
            let [a, b, c] = quadratic(theta);
            let (t, u) = theta.sin_cos();
            for x in [-0.9_f64, 0.1, 0.8] {
                let p = 4.0 * u + 4.0 * x - 5.0 - 2.0 * u * x;
                let q = 2.0 * t;
                let squared = p * p - q * q * (1.0 - x * x);
                assert!((a * x * x + b * x + c - squared).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn one_sign_of_each_root_closes_and_the_other_does_not() {
        for theta in [0.001, 0.1, 0.344, 0.9, 1.2, -0.5] {
            let all = candidates(theta);
            assert_eq!(all.len(), 4);
            for pair in all.chunks(2) {
                let [x, y] = [pair[0], pair[1]];
                assert!(x.closes != y.closes);
                let (good, bad) = if x.closes { (x, y) } else { (y, x) };
                // The roots run together as theta goes to zero: the discriminant is of the size of
                // sin²(theta), and its root loses digits accordingly.
                let rounding = 1e-14 / f64::sin(theta).abs();
                assert!(good.closure.abs() < rounding, "theta {theta}: {good:?}");
                // The wrong sign leaves -4 sin(theta) sin(alpha).
                let gap = -4.0 * f64::sin(theta) * good.alpha_rad.sin();
                assert!((bad.closure - gap).abs() < rounding, "theta {theta}: {bad:?}");
            }
        }
        // Bar 1 straight down: (2 c - 1)², a double root.
        let all = candidates(0.0);
        assert_eq!(all.len(), 4);
        assert!(all.iter().all(|one| (one.cos_alpha - 0.5).abs() <= 0.0));
        assert!(candidates(1.4).is_empty());
        assert!(candidates(f64::NAN).is_empty());
    }
}
