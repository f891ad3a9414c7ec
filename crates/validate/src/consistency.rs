//! Whether the numbers of one answer belong together: its energy, reactions and axial forces follow
//! from its joints and joint forces.

use model::{Chain, Equilibrium, sum};
use serde::Serialize;

use crate::lever::{centre_part, far_kg};
use crate::statics::stored_rounding_m;
use crate::vector::{minus, norm};

/// Largest differences between what an answer says and what follows from its joints and forces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Consistency {
    /// `energy_j` less the energy of the joints, in units of total weight × total length.
    pub energy: f64,
    /// `axial_n` less the forces along the bars, in units of force.
    pub axial: f64,
    /// `reactions_n` less the first and last joint force, in units of force.
    pub reactions: f64,
}

impl Consistency {
    /// The largest difference in forces; NaN if a number is missing or not finite.
    #[must_use]
    pub fn forces(&self) -> f64 {
        worse(self.axial, self.reactions)
    }
}

/// Hold the numbers of an answer against each other. Forces are measured as in
/// [`Statics`](crate::statics::Statics); of the energy and of the axial forces counts what the
/// rounding of the coordinates leaves unexplained.
///
/// Arrays that do not fit the chain, and numbers that are not finite, give NaN.
#[must_use]
pub fn consistency(chain: &Chain, answer: &Equilibrium) -> Consistency {
    let bars = chain.bars();
    let (joints, forces) = (&answer.joints_m, &answer.multipliers_n);
    let sizes = [joints.len(), forces.len(), answer.axial_n.len() + 1];
    if sizes != [bars.len() + 1; 3] {
        return Consistency { energy: f64::NAN, axial: f64::NAN, reactions: f64::NAN };
    }
    let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
    let unit_n = forces.iter().map(|force| norm(*force)).fold(weight_n, worse);

    let heights = bars.iter().enumerate().map(|(i, bar)| {
        let part = centre_part(bar);
        let from = joints[i][2] - joints[0][2];
        bar.mass_kg() * chain.gravity_m_s2() * (from + part * (joints[i + 1][2] - joints[i][2]))
    });
    let off_j = (answer.energy_j - sum(heights)).abs();
    let stored_m = stored_rounding_m(chain);
    let rounding_j = weight_n * stored_m;
    // Not `f64::max`, which would forget a NaN.
    let energy_j = if off_j <= rounding_j { 0.0 } else { off_j - rounding_j };

    let axial = bars.iter().enumerate().map(|(i, bar)| {
        let along = minus(joints[i + 1], joints[i]);
        let mut force = forces[i + 1];
        // The part of the weight that the lever rule gives to the far joint.
        force[2] -= far_kg(bar) * chain.gravity_m_s2();
        let found = (0..3).map(|k| force[k] * (along[k] / norm(along))).sum::<f64>();
        // Rounded coordinates turn a short bar, and a force along it loses by the square of the
        // angle.
        let turn = 2.0 * stored_m / bar.length_m();
        let off_n = (answer.axial_n[i] - found).abs() - norm(force) * (turn * turn).min(2.0);
        // Not `f64::max`, which would forget a NaN.
        if off_n <= 0.0 { 0.0 } else { off_n }
    });
    let ends = [
        norm(minus(answer.reactions_n.start, forces[0])),
        norm(minus(answer.reactions_n.end, forces[bars.len()])),
    ];
    Consistency {
        energy: energy_j / (weight_n * chain.total_length_m()),
        axial: axial.fold(0.0, worse) / unit_n,
        reactions: ends.into_iter().fold(0.0, worse) / unit_n,
    }
}

/// The larger of two differences; NaN is the worst of all.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests;
