//! The units in which differences between answers are judged.

use model::{Chain, Vector};

use crate::statics::stored_rounding_m;
use crate::vector::norm;

/// Units in which differences are judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Total length, m.
    pub length_m: f64,
    /// The larger of the total weight and the largest joint force, N.
    pub force_n: f64,
    /// Total weight × total length, J.
    pub energy_j: f64,
    /// Rounding of a joint's coordinates: they are stored in the world frame, however far from its
    /// origin the anchors are, m.
    pub rounding_m: f64,
}

impl Units {
    /// The units of a chain whose largest joint force is known.
    #[must_use]
    pub fn new(chain: &Chain, multipliers_n: &[Vector]) -> Self {
        let length_m = chain.total_length_m();
        let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
        Self {
            length_m,
            force_n: multipliers_n.iter().map(|f| norm(*f)).fold(weight_n, f64::max),
            energy_j: weight_n * length_m,
            rounding_m: stored_rounding_m(chain),
        }
    }
}
