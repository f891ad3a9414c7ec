//! Steps of RATTLE composed to a higher order.
//!
//! A symmetric method of order two, taken in steps of the lengths `γ_i h` with `γ_i = γ_{s+1−i}`
//! and `Σ γ_i = 1`, stays symmetric and symplectic, and has the order four where `Σ γ_i³ = 0`; for
//! the order eight `Σ γ_i⁵ = Σ γ_i⁷ = 0` are the next of 16 conditions (E. Hairer, C. Lubich, G.
//! Wanner, *Geometric Numerical Integration*, 2nd ed., Springer 2006, section V.3).

use crate::settings::Order;

/// First half and middle of the 17 steps of the order eight (W. Kahan, R.-C. Li, Math. Comp. 66
/// (1997) 1089-1099).
const EIGHTH: [f64; 9] = [
    0.130_202_483_088_890_07, 0.561_162_981_775_108_4, -0.389_474_962_644_847_27,
    0.158_841_906_555_155_6, -0.395_903_894_133_237_57, 0.184_539_640_978_315_7,
    0.258_374_387_686_322_04, 0.295_011_723_609_310_3, -0.605_508_533_830_034_6,
];

/// Lengths of the steps of RATTLE that make one step, in units of it.
pub(crate) fn parts(order: Order) -> Vec<f64> {
    match order {
        Order::Second => vec![1.0],
        Order::Fourth => {
            let p = 1.0 / (4.0 - 4.0_f64.cbrt());
            vec![p, p, 1.0 - 4.0 * p, p, p]
        }
        Order::Eighth => {
            let half = EIGHTH.iter().copied();
            half.chain(EIGHTH.iter().rev().skip(1).copied()).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_meet_the_conditions_of_their_orders() {
        let orders = [(Order::Second, 1, 1), (Order::Fourth, 5, 3), (Order::Eighth, 17, 7)];
        for (order, steps, highest) in orders {
            let parts = parts(order);
            assert_eq!(parts.len(), steps);
            for (a, b) in parts.iter().zip(parts.iter().rev()) {
                assert!((a - b).abs() < f64::EPSILON);
            }
            assert!((model::sum(parts.iter().copied()) - 1.0).abs() < 1e-15);
            for power in (3..=highest).step_by(2) {
                let sum = model::sum(parts.iter().map(|part| part.powi(power)));
                assert!(sum.abs() < 1e-15, "{order:?}: powers {power} sum up to {sum:e}");
            }
        }
    }
}
