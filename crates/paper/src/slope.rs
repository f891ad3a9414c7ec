//! The slope of the energy along the closure curve, over a box of positions: rounded outward.

use census::Interval;
use model::Chain;

/// π lies between these neighbouring doubles.
const PI: [f64; 2] = [std::f64::consts::PI, std::f64::consts::PI.next_up()];

/// Terms of the series of sine and cosine; beyond, less than 4³³/33! = 9e-18 is left for |x| < 4.
const TERMS: u32 = 16;

/// An angle in degrees, in radians.
pub(crate) fn radians(degrees: Interval) -> Interval {
    degrees * (Interval::new(PI[0], PI[1]) / Interval::point(180.0))
}

/// An angle in radians, in degrees.
pub(crate) fn degrees(radians: Interval) -> Interval {
    radians * (Interval::point(180.0) / Interval::new(PI[0], PI[1]))
}

/// Sine and cosine by their series, for |x| < 4; beyond, all that they can be.
pub(crate) fn sin_cos(x: Interval) -> [Interval; 2] {
    let all = Interval::new(-1.0, 1.0);
    // False for NaN as well.
    let small = x.mag() < 4.0;
    if !small {
        return [all; 2];
    }
    // From the remainder, which is at most the first term left out, inward:
    // 1 − x²/(k (k+1)) (1 − x²/((k+2) (k+3)) (...)).
    let series = |first: u32| {
        let square = x.square();
        (0..TERMS).rev().fold(Interval::new(0.0, 1.0), |rest, term| {
            let k = f64::from(first + 2 * term);
            Interval::ONE - square / Interval::point(k * (k + 1.0)) * rest
        })
    };
    let within = |value: Interval| value.intersect(all).unwrap_or(all);
    [within(x * series(2)), within(series(1))]
}

/// dV/dφ₁ of a closed chain of three bars in a vertical plane, in units of the first bar's weight
/// times its length: φ₁ turns, and the two other bars follow so that the closure holds to first
/// order,
///
/// $$ \frac{dV}{d\varphi_1} = \sum_i W_i \sin\varphi_i \frac{t_i}{t_1}, \qquad
///    W_i = \Big(m_i r_i + l_i \sum_{j > i} m_j\Big) g, \qquad
///    t_1 = l_2 l_3 \sin(\varphi_3 - \varphi_2), \ldots $$
///
/// Where it does not vanish there is no equilibrium, neither in the plane nor in space. `None` for
/// other numbers of bars.
pub(crate) fn slope(chain: &Chain, angles_rad: [Interval; 3]) -> Option<Interval> {
    let [a, b, c] = chain.bars() else { return None };
    let bars = [a, b, c];
    let length = bars.map(|bar| Interval::point(bar.length_m()));
    let mass = bars.map(|bar| Interval::point(bar.mass_kg()));
    let mut slope = Interval::ZERO;
    let turn = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        length[j] * length[k] * sin_cos(angles_rad[k] - angles_rad[j])[0]
    };
    let first = turn(0);
    for i in 0..3 {
        let after: Interval = mass[i + 1..].iter().copied().sum();
        let weight = mass[i] * Interval::point(bars[i].centre_m()) + length[i] * after;
        slope = slope + weight * sin_cos(angles_rad[i])[0] * turn(i) / first;
    }
    Some(slope / (mass[0] * length[0]))
}
