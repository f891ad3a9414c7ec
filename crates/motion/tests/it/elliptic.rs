//! Jacobi's amplitude, by which pendulums move.

/// The quarter period `K` and the amplitude `am(u, k)` by arithmetic-geometric means (Abramowitz
/// and Stegun 16.4, 17.6).
///
/// The phase is to be reduced to a period, where the recursion keeps its digits.
pub fn elliptic(k: f64) -> (f64, impl Fn(f64) -> f64) {
    let (mut a, mut c) = (vec![1.0_f64], vec![k]);
    let mut b = (1.0 - k * k).sqrt();
    while c[c.len() - 1].abs() > 1e-15 {
        let last = a[a.len() - 1];
        a.push(0.5 * (last + b));
        c.push(0.5 * (last - b));
        b = (last * b).sqrt();
    }
    let top = a.len() - 1;
    let quarter = std::f64::consts::FRAC_PI_2 / a[top];
    let amplitude = move |u: f64| {
        let mut phi = f64::powi(2.0, i32::try_from(top).unwrap()) * a[top] * u;
        for n in (1..=top).rev() {
            phi = 0.5 * (phi + (c[n] / a[n] * phi.sin()).asin());
        }
        phi
    };
    (quarter, amplitude)
}
