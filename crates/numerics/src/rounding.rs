//! One step outward, and sums with their rounding error.
//!
//! # Why it is rigorous
//!
//! IEEE 754 rounds +, −, ×, ÷ and √ correctly: the computed value is a neighbour of the exact one,
//! so the next double below and the next double above it enclose the exact result. Stepping to the
//! next double is done without branches by the formula of Rump, Zimmermann, Boldo and Melquiond:
//! with `u` = 2⁻⁵³, `φ = u(1 + 2u)` and the smallest subnormal number `η`,
//!
//! $$ \mathrm{fl}(x - \mathrm{fl}(\varphi |x| + \eta)) \le \mathrm{pred}(x), \qquad
//!    \mathrm{succ}(x) \le \mathrm{fl}(x + \mathrm{fl}(\varphi |x| + \eta)) $$
//!
//! for every finite `x`, subnormal numbers included. Overflow gives an infinite end, which is still
//! an enclosure; whatever is not a number becomes the whole line, with which nothing can be proved.
//! No rounding mode is set, no fused operation and no function of the system's libm is used, so the
//! ends are the same bits on every processor.
//!
//! # References
//!
//! - S. M. Rump, P. Zimmermann, S. Boldo, G. Melquiond, "Computing predecessor and successor in
//!   rounding to nearest", BIT 49 (2009) 419-431, doi:10.1007/s10543-009-0218-z
//! - D. E. Knuth, "The Art of Computer Programming", vol. 2, 3rd ed. (1997), 4.2.2, theorem B

/// `u(1 + 2u)` with `u = 2⁻⁵³`: the successor of `u`.
const PHI: f64 = f64::EPSILON / 2.0 * (1.0 + f64::EPSILON);

/// The smallest subnormal number, 2⁻¹⁰⁷⁴.
const ETA: f64 = f64::from_bits(1);

/// At or above the double after `x`.
///
/// ```
/// assert!(numerics::up(1.0) >= 1.0_f64.next_up());
/// assert!(numerics::up(0.0) > 0.0);
/// ```
#[inline]
pub fn up(x: f64) -> f64 {
    x + (PHI * x.abs() + ETA)
}

/// At or below the double before `x`.
///
/// ```
/// assert!(numerics::down(1.0) <= 1.0_f64.next_down());
/// assert!(numerics::down(0.0) < 0.0);
/// ```
#[inline]
pub fn down(x: f64) -> f64 {
    x - (PHI * x.abs() + ETA)
}

/// The rounded sum of two doubles and its rounding error, both exactly (Knuth's two-sum).
///
/// ```
/// let (sum, error) = numerics::two_sum(1.0, 1e-20);
/// assert_eq!([sum, error], [1.0, 1e-20]);
/// ```
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}
