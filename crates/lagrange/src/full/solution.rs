//! The answer: an equilibrium in observables, and in the paper's own unknowns.

use model::{Equilibrium, Evidence, Reactions, SolverName, Vector};
use nalgebra::{DVector, Vector3};

use crate::effort::Effort;
use crate::error::Error;
use crate::full::constraints::coordinates;
use crate::full::mechanism::{Mechanism, Units};
use crate::full::multipliers::all_multipliers;
use crate::full::reduced::Reduced;
use crate::full::spectrum::{LARGEST_DECOMPOSED, LARGEST_FULL, Spectrum, spectrum};
use crate::full::stability::stability;
use crate::full::system::relative_residual;
use crate::settings::Settings;

/// An equilibrium of the full system. That it exists means converged.
///
/// ```
/// let found = lagrange::solve(&model::cases::paper(), &Default::default())?;
/// assert_eq!((found.q.len(), found.lambda.len(), found.nullity), (18, 12, 4));
/// // lambda_3, the vertical reaction at the first anchor, mg.
/// assert!((found.lambda[2] / 9.80665 - 2.312944292241838).abs() < 1e-13);
/// # Ok::<(), lagrange::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The equilibrium as everyone reads it.
    pub equilibrium: Equilibrium,
    /// Angles ψ, θ, φ of each bar, rad.
    pub angles_rad: Vec<[f64; 3]>,
    /// The coordinates of eq. (21): centre of weight (m, world frame) and angles (rad) of each bar.
    pub q: DVector<f64>,
    /// The multipliers in the paper's order, N: see
    /// [`multipliers_n`](Equilibrium::multipliers_n).
    pub lambda: DVector<f64>,
    /// What it took.
    pub effort: Effort,
    /// Norm of the residual at each step of Newton's method, in the solver's units; a relaxation
    /// shows as a jump.
    pub residual_history: Vec<f64>,
    /// Dimension of the null space of the Jacobian.
    pub nullity: usize,
    /// Largest singular value of the Jacobian divided by the smallest that is not zero.
    pub condition: f64,
}

impl Solution {
    /// Everything that follows from a root of the reduced system.
    pub(crate) fn new(
        problem: &model::Problem,
        settings: &Settings,
        reduced: &Reduced,
        effort: Effort,
        residual_history: Vec<f64>,
    ) -> Result<Self, Error> {
        let chain = problem.chain();
        let units = Units::total(chain);
        let (mechanism, point) = (Mechanism::si(chain), &reduced.here);
        let q = coordinates(&mechanism, &point.angles);
        let lambda = all_multipliers(&mechanism, &(point.pull * units.weight));
        let residual = relative_residual(chain, &q, &lambda);
        let spectrum = match chain.bars().len() {
            bars if bars <= LARGEST_FULL => spectrum(chain, &q, &lambda)?,
            bars if bars <= LARGEST_DECOMPOSED => Spectrum::reduced(&reduced.mechanism, point)?,
            _ => Spectrum::estimated(&reduced.mechanism, point),
        };
        let mut evidence = Evidence::new(
            "largest of the 6n + 3(n+1) equations, in mg, mgl and l",
            residual,
            settings.tolerance * tolerance_unit(chain, &lambda),
            effort.iterations,
        );
        evidence.nullity = spectrum.nullity;
        evidence.condition = spectrum.condition;
        evidence.solve_s = effort.solve_s;
        let multipliers_n: Vec<Vector> =
            lambda.as_slice().chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect();
        let equilibrium = Equilibrium {
            solver: SolverName::LAGRANGE,
            energy_j: energy(reduced) * units.weight * units.length,
            joints_m: joints(&mechanism, reduced),
            reactions_n: Reactions {
                start: multipliers_n[0],
                end: multipliers_n[multipliers_n.len() - 1],
            },
            axial_n: point.bars.iter().map(|b| b.force.dot(&b.u) * units.weight).collect(),
            stability: stability(&reduced.mechanism, point),
            multipliers_n,
            evidence,
        };
        Ok(Self {
            equilibrium,
            angles_rad: point.angles.clone(),
            q,
            lambda,
            effort,
            residual_history,
            nullity: spectrum.nullity,
            condition: spectrum.condition,
        })
    }
}

/// What the tolerance of the reduced equations is in units of the full ones: those measure moments
/// in the largest force times the mean length and closure in the total length, these in *mgl* and
/// *l*.
fn tolerance_unit(chain: &model::Chain, lambda: &DVector<f64>) -> f64 {
    let bars = chain.bars().len() as f64;
    let mean_weight_n = chain.total_mass_kg() * chain.gravity_m_s2() / bars;
    let forces = lambda.as_slice().chunks_exact(3);
    let largest_n = forces.map(|f| f[0].hypot(f[1]).hypot(f[2])).fold(0.0, f64::max);
    bars.max(largest_n / mean_weight_n)
}

/// Potential energy from joint 0, $V = \sum m_i g\\,Z_{C_i}$, in units of the total weight and
/// length.
pub(crate) fn energy(reduced: &Reduced) -> f64 {
    let mechanism = &reduced.mechanism;
    let mut height = 0.0;
    let bars = reduced.here.bars.iter().enumerate().map(|(i, bar)| {
        let centre = height + mechanism.centres[i] * bar.u.z;
        height += mechanism.lengths[i] * bar.u.z;
        mechanism.weights[i] * centre
    });
    model::sum(bars)
}

/// Joints 0..=n, m, from the first anchor along the bars.
fn joints(mechanism: &Mechanism, reduced: &Reduced) -> Vec<Vector> {
    let mut joint = mechanism.start;
    let bars = reduced.here.bars.iter().zip(&mechanism.lengths);
    let ends = bars.map(|(bar, length)| {
        joint += bar.u * *length;
        joint.into()
    });
    std::iter::once(Vector::from(mechanism.start)).chain(ends).collect()
}

/// Horizontal position of joint 1 beside joint 0, in units of the total length: tells an
/// equilibrium from its mirror image.
pub(crate) fn first_offset(reduced: &Reduced) -> Vector3<f64> {
    let first = reduced.here.bars[0].u * reduced.mechanism.lengths[0];
    Vector3::new(first.x, first.y, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of three bars of 1, 2 and 6 kg at 10 m/s² the mean weight is 30 N; the largest force, (60, 80, 240) N, is 260 N.
    #[test]
    fn tolerances_go_with_the_largest_force() {
        let bars = [1.0, 2.0, 6.0].map(|kg| model::Bar::homogeneous(1.0, kg).unwrap()).to_vec();
        let anchors = model::Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
        let chain = model::Chain::new("three", 10.0, anchors, bars).unwrap();
        let unit = |z: f64| {
            let forces = [1.0, 0.0, 2.0, 60.0, 80.0, z, 3.0, 0.0, 5.0, 0.0, 7.0, 1.0];
            tolerance_unit(&chain, &DVector::from_row_slice(&forces))
        };
        assert!((unit(240.0) - 26.0 / 3.0).abs() < 1e-14);
        // 100 N are 10/3, and no less than the number of bars.
        assert!((unit(0.0) - 10.0 / 3.0).abs() < 1e-14);
    }
}
