use model::Chain;
use nalgebra::DVector;

use crate::full::constraints::PER_BAR;
use crate::full::mechanism::Mechanism;

/// Load vector $\mathbf{T}$, size 6n, N: $-m_i g$ in the row of every $Z_{C_i}$, zero elsewhere.
///
/// The paper prints (41) without the entry $-m_2 g$ of the second bar.
///
/// Paper, eqs. (34)-(36) and (41).
///
/// ```
/// let t = lagrange::load_vector(model::cases::paper().chain());
/// assert_eq!((t.len(), t[2], t[8], t[14]), (18, -9.80665, -9.80665, -9.80665));
/// ```
pub fn load_vector(chain: &Chain) -> DVector<f64> {
    load_vector_of(&Mechanism::si(chain))
}

pub(crate) fn load_vector_of(mechanism: &Mechanism) -> DVector<f64> {
    let mut load = DVector::zeros(mechanism.coordinates());
    for (bar, weight) in mechanism.weights.iter().enumerate() {
        load[PER_BAR * bar + 2] = -weight;
    }
    load
}
