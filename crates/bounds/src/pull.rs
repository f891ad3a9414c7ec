//! A bound from the pull alone: the chain as if its bars were cables.

use intervals::{Interval, IntervalSum};
use model::{Problem, Vector};

use crate::data::{Data, Sense};

/// A rigorous bound on the energy of every configuration, from any guess of the pull.
///
/// Let bars be shorter than they are, $|d_i| \le l_i$, as cables are. With the multiplier q of the
/// closure $\sum d_i = D$ the energy $\sum c_i d_{iZ}$ is, for every q,
///
/// $$ V = q \cdot D - \sum_i F_i \cdot d_i \;\ge\; q \cdot D - \sum_i l_i |F_i|,
///    \qquad F_i = q - c_i e_Z , $$
///
/// where c_i is the weight that the joints i..n carry by the lever rule. At an equilibrium q is the
/// force of the ground on the chain at the last anchor, the derivative of the least energy with
/// respect to D, and F_i the axial force of bar i. The right-hand side is concave in q; where all
/// bars are in tension its greatest value is the least energy. It is evaluated in interval
/// arithmetic: what is returned is a bound whatever q and whatever the rounding.
///
/// `pull_n`: q, world frame, N; −∞ (or +∞, for an upper bound) when it is not finite.
///
/// ```
/// use bounds::{Sense, pull_bound};
/// // The paper's chain is propped up by a bar in compression, which no cable can be: two cables
/// // hang straight down to the last anchor and the third is slack, V = -4 mgl (2 mgl in the paper's
/// // terms).
/// let problem = model::cases::paper();
/// let mg = problem.chain().gravity_m_s2();
/// let bound = pull_bound(&problem, Sense::Lower, [0.0, 0.0, 0.5 * mg]) / mg;
/// assert!(bound <= -4.0 && bound > -4.0 - 1e-14, "{bound}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
///
/// R. T. Rockafellar, Convex Analysis, Princeton 1970, section 31 (Fenchel duality).
#[must_use]
pub fn pull_bound(problem: &Problem, sense: Sense, pull_n: Vector) -> f64 {
    let data = Data::new(problem, sense);
    let q = pull_n.map(|x| sense.sign() * x / data.scale.weight);
    sense.rigorous(data.scale, lower_bound(&data, q))
}

/// The bound without units; −∞ when q is not finite.
pub(crate) fn lower_bound(data: &Data, q: Vector) -> f64 {
    let q = q.map(Interval::point);
    let across = q[0].square() + q[1].square();
    let mut total = IntervalSum::ZERO;
    for (q, difference) in q.iter().zip(&data.difference) {
        total.add(*q * *difference);
    }
    for (length, tail) in data.length.iter().zip(&data.tail_weight) {
        let force = (across + (q[2] - *tail).square()).sqrt();
        total.add(-(*length * force));
    }
    let value = total.value().lo();
    if value.is_nan() { f64::NEG_INFINITY } else { value }
}
