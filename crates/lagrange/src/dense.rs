//! The full system of the paper, stepped by its singular value decomposition.
//!
//! The readable form of the method and what tests hold the reduced one against: the same equations,
//! all 6n + 3(n+1) of them, and a step for which nothing about their structure is known.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::constraints::{PER_BAR, bar_coordinates};
use crate::larger::larger;
use crate::mechanism::Mechanism;
use crate::multipliers::all_multipliers;
use crate::newton::Equations;
use crate::point::Point;
use crate::system::{jacobian_of, residual_of};

/// Steps of the iteration behind a singular value decomposition, per row; a few are usual.
const SVD_STEPS: usize = 100;

/// The full system at a point.
#[derive(Debug, Clone)]
pub(crate) struct Dense<'a> {
    mechanism: &'a Mechanism,
    q: DVector<f64>,
    lambda: DVector<f64>,
    residual: DVector<f64>,
    step: DVector<f64>,
    there: Option<(DVector<f64>, DVector<f64>, DVector<f64>)>,
}

impl<'a> Dense<'a> {
    /// The full system at the reduced one's point.
    pub fn new(mechanism: &'a Mechanism, point: &Point) -> Self {
        let q = coordinates(mechanism, &point.angles);
        let lambda = all_multipliers(mechanism, &point.pull);
        let residual = residual_of(mechanism, &q, &lambda);
        let step = DVector::zeros(residual.len());
        Self { mechanism, q, lambda, residual, step, there: None }
    }

    /// Angles of the bars.
    pub fn angles(&self) -> Vec<[f64; 3]> {
        (0..self.mechanism.bars()).map(|bar| bar_coordinates(&self.q, bar).1).collect()
    }

    /// Pull of the first anchor, $-(\lambda_1, \lambda_2, \lambda_3)$.
    pub fn pull(&self) -> Vector3<f64> {
        -Vector3::new(self.lambda[0], self.lambda[1], self.lambda[2])
    }
}

impl Equations for Dense<'_> {
    fn norm(&self) -> f64 {
        self.residual.norm()
    }

    fn largest(&self) -> f64 {
        let bars = self.mechanism.bars() as f64;
        let force = self.lambda.amax().max(1.0 / bars);
        let coordinates = self.q.len();
        self.residual.iter().enumerate().fold(0.0, |largest: f64, (row, value)| {
            let unit = if row >= coordinates {
                1.0
            } else if row % PER_BAR < 3 {
                force
            } else {
                force / bars
            };
            larger(largest, (value / unit).abs())
        })
    }

    fn step(&mut self, damping: f64) -> f64 {
        let jacobian = jacobian_of(self.mechanism, &self.q, &self.lambda);
        let predicted = match damped_step(&jacobian, &self.residual, damping) {
            Some(step) => {
                self.step = step;
                (&self.residual + jacobian * &self.step).norm()
            }
            None => f64::NAN,
        };
        self.there = None;
        predicted
    }

    fn attempt(&mut self) -> f64 {
        let q = &self.q + self.step.rows(0, self.q.len());
        let lambda = &self.lambda + self.step.rows(self.q.len(), self.lambda.len());
        let residual = residual_of(self.mechanism, &q, &lambda);
        let norm = residual.norm();
        self.there = Some((q, lambda, residual));
        norm
    }

    fn accept(&mut self) {
        if let Some((q, lambda, residual)) = self.there.take() {
            (self.q, self.lambda, self.residual) = (q, lambda, residual);
        }
    }
}

/// $d = -(J^T J + s^2)^{-1} J^T r = -\sum_i v_i\\,\frac{\sigma_i}{\sigma_i^2 + s^2}\\,(u_i \cdot
/// r)$ from the singular values of J; with s = 0 and the zero ones left out it would be the
/// minimum-norm step. `None` when the decomposition does not converge.
pub(crate) fn damped_step(
    jacobian: &DMatrix<f64>,
    residual: &DVector<f64>,
    damping: f64,
) -> Option<DVector<f64>> {
    let steps = SVD_STEPS * jacobian.nrows();
    let svd = jacobian.clone().try_svd(true, true, f64::EPSILON, steps)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    let mut parts = u.tr_mul(residual);
    for (part, sigma) in parts.iter_mut().zip(svd.singular_values.iter()) {
        *part *= -sigma / (sigma * sigma + damping * damping);
    }
    Some(v_t.tr_mul(&parts))
}

/// The coordinates `q` of eq. (21): the centres follow from the angles along the chain, so that
/// every constraint but the last three holds.
pub(crate) fn coordinates(mechanism: &Mechanism, angles: &[[f64; 3]]) -> DVector<f64> {
    let mut q = DVector::zeros(mechanism.coordinates());
    let mut joint = mechanism.start;
    for (bar, &[psi, theta, phi]) in angles.iter().enumerate() {
        let u = crate::rotation::direction(psi, theta, phi);
        let centre = joint + u * mechanism.centres[bar];
        joint += u * mechanism.lengths[bar];
        let part = [centre.x, centre.y, centre.z, psi, theta, phi];
        q.rows_mut(PER_BAR * bar, PER_BAR).copy_from_slice(&part);
    }
    q
}

#[cfg(test)]
mod tests;
