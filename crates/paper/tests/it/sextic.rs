//! The sextic of the example.

use paper::sextic::{polynomial, roots};

/// At a critical point of (vi) on the curve the gradients are parallel. With theta given, the
/// closure gives alpha, and the determinant of the two gradients vanishes exactly where p does:
/// both change sign at the same cosines and nowhere else.
#[test]
fn the_roots_are_the_critical_points_of_vi_on_the_closure_curve() {
    let determinant = |theta: f64, alpha: f64| {
        let across = 2.0 * (alpha - theta).sin();
        2.0 * theta.sin() * (4.0 * alpha.sin() - across)
            - alpha.sin() * (4.0 * theta.sin() + across)
    };
    let mut critical = Vec::new();
    for branch in energy::example::Branch::BOTH {
        let value = |theta: f64| {
            energy::example::alpha(theta, branch).map(|alpha| determinant(theta, alpha))
        };
        let largest = energy::example::LARGEST_THETA_COSINE.acos();
        // Strictly inside, where alpha exists; theta > 0, the mirror image is the other half.
        let steps = 5000;
        let grid = |k: i32| largest * f64::from(k) / f64::from(steps);
        for k in 1..steps - 1 {
            let (Some(a), Some(b)) = (value(grid(k)), value(grid(k + 1))) else { continue };
            if a * b < 0.0 {
                let (mut low, mut high) = (grid(k), grid(k + 1));
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if value(middle).is_some_and(|m| m * a > 0.0) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                critical.push(low.cos());
            }
        }
    }
    critical.sort_by(f64::total_cmp);
    let roots = roots().unwrap();
    assert_eq!(critical.len(), roots.len(), "{critical:?}");
    for (ours, root) in critical.iter().zip(roots) {
        assert!((ours - root).abs() < 1e-13, "{ours} {root}");
    }
}

#[test]
fn the_slope_is_that_of_the_polynomial() {
    for c in [-0.7, 0.1, 0.95] {
        let d = |h: f64| (polynomial(c + h)[0] - polynomial(c - h)[0]) / (2.0 * h);
        assert!((polynomial(c)[1] - (4.0 * d(5e-4) - d(1e-3)) / 3.0).abs() < 1e-6);
    }
}
