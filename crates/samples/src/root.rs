//! Closed forms that are given by an equation.

/// Where a function changes its sign between two places, to the last digit.
///
/// ```
/// let two = samples::root(|x| x * x - 2.0, [1.0, 2.0]);
/// assert!((two - 2_f64.sqrt()).abs() < 1e-15);
/// ```
pub fn root(f: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    assert!(f(low) * f(high) < 0.0, "no change of sign between {low} and {high}");
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}
