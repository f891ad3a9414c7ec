//! A third way to the planar equilibria of the example: the roots of a polynomial.
//!
//! With everything but $c = \cos\theta$ eliminated from "critical point of (vi) on the closure
//! curve $5 - 4\cos\theta - 4\cos\alpha + 2\cos(\alpha - \theta) = 0$" there remains
//!
//! $$ p(c) = 2048 c^6 - 8192 c^5 + 9472 c^4 + 2080 c^3 - 11348 c^2 + 7120 c - 1189 = 0 . $$
//!
//! Each root in [-1, 1] belongs to one equilibrium and its mirror image. A test derives p from the
//! closure and (vi) by evaluation.

/// Coefficients of p, constant term first: integers, exact.
const COEFFICIENTS: [f64; 7] = [-1189.0, 7120.0, -11348.0, 2080.0, 9472.0, -8192.0, 2048.0];

/// p and its derivative.
pub fn polynomial(c: f64) -> [f64; 2] {
    COEFFICIENTS.iter().rev().fold([0.0, 0.0], |[p, slope], a| [p * c + a, slope * c + p])
}

/// Bounds of |p'| and |p''| on [-1, 1]: sums of the absolute values of their terms.
fn slopes() -> [f64; 2] {
    let mut bounds = [0.0, 0.0];
    for (k, a) in COEFFICIENTS.iter().enumerate() {
        let k = k as f64;
        bounds[0] += k * a.abs();
        bounds[1] += k * (k - 1.0) * a.abs();
    }
    bounds
}

/// All roots of p in [-1, 1], found and counted: an interval is dropped when the bound of the slope
/// says that p cannot reach zero in it, and holds exactly one root when p changes its sign and the
/// bound of the second derivative says that the slope does not.
///
/// `None` if an interval stays undecided; roundings (1e-12 here) are far below what decides.
///
/// ```
/// let roots = paper::sextic::roots().unwrap();
/// assert_eq!(roots.len(), 2);
/// // Real-root counting and 20 digits by others: 0.27696938689753988505, 0.94150073489823487574.
/// assert!((roots[0] - 0.276_969_386_897_539_9).abs() < 1e-15);
/// assert!((roots[1] - 0.941_500_734_898_234_9).abs() < 1e-15);
/// ```
pub fn roots() -> Option<Vec<f64>> {
    let bounds = slopes();
    let mut found = Vec::new();
    // Reversed, so that the roots come out in order.
    let mut open = vec![(-1.0_f64, 1.0_f64)];
    while let Some((low, high)) = open.pop() {
        let half = 0.5 * (high - low);
        let middle = low + half;
        let [p, slope] = polynomial(middle);
        if p.abs() > bounds[0] * half {
            continue;
        }
        if slope.abs() > bounds[1] * half {
            // Monotone here: one root or none.
            if polynomial(low)[0] * polynomial(high)[0] <= 0.0 {
                found.push(bisected(low, high));
            }
            continue;
        }
        if half < SMALLEST {
            return None;
        }
        open.push((middle, high));
        open.push((low, middle));
    }
    Some(found)
}

/// An interval this small that is still undecided holds a double root or rounding.
const SMALLEST: f64 = 1e-9;

/// The root between two ends of different sign, to the last place.
fn bisected(mut low: f64, mut high: f64) -> f64 {
    let falls = polynomial(low)[0] > 0.0;
    // Bisection ends when nothing lies between; 64 halvings of an interval below 2 suffice.
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if (polynomial(middle)[0] > 0.0) == falls {
            low = middle;
        } else {
            high = middle;
        }
    }
    let root = 0.5 * (low + high);
    // One Newton step: Horner's rule is good to a few roundings on either side of the root.
    let [p, slope] = polynomial(root);
    root - p / slope
}
