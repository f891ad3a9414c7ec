//! The convex relaxation, by a primal-dual interior point method.
//!
//! With every bar taken for a cable the energy has one minimum, on a convex set of configurations.
//! Where all bars pull there, it is the global minimum for bars as well; elsewhere it is a start.
//! With slacks `s`,
//!
//! `sum F J = load,   c - phi F + s = 0,   F s = sigma,   F > 0, s > 0,   sigma -> 0`.
//!
//! Elimination of `s` and `F` leaves one system in the coordinates alone,
//!
//! `H + sum F / (s + phi F) J Jᵀ`,   `H` the second derivative of `sum F c`,
//!
//! which is positive definite all the way: no inertia has to be mended, and one sparse Cholesky
//! factorisation serves the predictor and the corrector.
//!
//! S. Mehrotra, SIAM J. Optim. 2 (1992) 575-601, doi:10.1137/0802028

use std::sync::Arc;

use model::system::Kind;

use crate::net::factor::Factor;
use crate::net::frame::Frame;
use crate::net::law::Excess;
use crate::net::shape::{NO_STRAIN, Shape};

/// First slack of a member that is as long as it may be or longer, over its length.
const FIRST_SLACK: f64 = 0.05;

/// The mean of `F s` over that of `F l` at which Newton's method does the rest: all bars are
/// active. Where cables may be slack it is [`NO_STRAIN`]: forces and slacks tell which are.
const GAP: f64 = 1e-7;

/// Part of the way to the boundary that a step may go.
const INSIDE: f64 = 0.99;

/// Diagonal added, over the size of the matrix: supports may leave a motion free.
const SHIFT: f64 = 1e-12;

/// Iterations of the interior point method: 8 to 15 are normal.
pub(super) const ITERATIONS: u64 = 60;

/// The interior point method.
pub(super) struct Interior {
    frame: Arc<Frame>,
    pub(super) factor: Factor,
    slack: Vec<f64>,
}

/// A step in all variables.
struct Step {
    coordinates: Vec<f64>,
    slack: Vec<f64>,
    force: Vec<f64>,
    /// Second-order part of the change of each excess.
    curved: Vec<f64>,
}

/// The largest part of a step, at most one over [`INSIDE`], that keeps all values positive.
fn part_inside(values: &[f64], step: &[f64]) -> f64 {
    let bound = |(value, step): (&f64, &f64)| if *step < 0.0 { -value / step } else { f64::MAX };
    values.iter().zip(step).map(bound).fold(1.0 / INSIDE, f64::min)
}

/// Whether the relaxation says something: struts have none that is convex.
pub(super) fn relaxable(frame: &Frame) -> bool {
    frame.rods.iter().all(|rod| rod.kind != Kind::Strut)
}

impl Interior {
    pub(super) fn new(frame: Arc<Frame>, factor: Factor, start: &Shape) -> Self {
        let excess = frame.excesses(&start.x);
        let slack = frame.rods.iter().zip(&excess).zip(&start.force).map(|((rod, c), force)| {
            (rod.flexibility * force - c.value).max(FIRST_SLACK * rod.length)
        });
        Self { slack: slack.collect(), frame, factor }
    }

    /// Mean of `F s`.
    fn gap(&self, force: &[f64]) -> f64 {
        let products = force.iter().zip(&self.slack).map(|(force, slack)| force * slack);
        products.sum::<f64>() / force.len() as f64
    }

    /// Whether the active members are known.
    pub(super) fn centred(&self, force: &[f64], misfit: f64) -> bool {
        let products = force.iter().zip(&self.frame.rods).map(|(force, rod)| force * rod.length);
        let cables = self.frame.rods.iter().any(|rod| rod.kind == Kind::Cable);
        let gap = if cables { NO_STRAIN } else { GAP };
        self.gap(force) <= gap * products.sum::<f64>() / force.len() as f64 && misfit < GAP.sqrt()
    }

    /// The linear system with right sides `target` for `F s` and `curved` for the excess.
    fn step(&mut self, shape: &Shape, excess: &[Excess], target: &[f64], curved: &[f64]) -> Step {
        let frame = &self.frame;
        let (rods, slack) = (&frame.rods, &self.slack);
        let softness = |e: usize| slack[e] + rods[e].flexibility * shape.force[e];
        let off = |e: usize| {
            excess[e].value + curved[e] - rods[e].flexibility * shape.force[e] + slack[e]
        };
        let constant = |e: usize| {
            (target[e] - shape.force[e] * slack[e] + shape.force[e] * off(e)) / softness(e)
        };
        let mut force: Vec<f64> = (0..rods.len()).map(constant).collect();
        let trial: Vec<f64> = shape.force.iter().zip(&force).map(|(a, b)| a + b).collect();
        let coordinates = self.factor.step_against(frame.lagrangian_gradient(excess, &trial));
        let mut change = Step {
            slack: vec![0.0; rods.len()],
            curved: vec![0.0; rods.len()],
            force: Vec::new(),
            coordinates,
        };
        for e in 0..rods.len() {
            let first_order = frame.change(excess, e, &change.coordinates);
            force[e] += shape.force[e] / softness(e) * first_order;
            change.slack[e] = rods[e].flexibility * force[e] - off(e) - first_order;
        }
        change.force = force;
        change
    }

    /// Predictor: straight to the boundary. Corrector: towards the centre, with the second order of
    /// the predictor.
    pub(super) fn mehrotra(&mut self, shape: &Shape) -> Option<Shape> {
        let frame = Arc::clone(&self.frame);
        let excess = frame.excesses(&shape.x);
        let sizes = frame.sizes(|e| shape.force[e]);
        let slack = &self.slack;
        let stiffness =
            |e: usize| shape.force[e] / (slack[e] + frame.rods[e].flexibility * shape.force[e]);
        let block = |e: usize| excess[e].block(shape.force[e], stiffness(e));
        frame.fill(&mut self.factor, block, |joint| SHIFT * sizes[joint]);
        if !self.factor.definite() {
            return None;
        }
        let zero = vec![0.0; frame.rods.len()];
        let mut predictor = self.step(shape, &excess, &zero, &zero);
        let part_x = part_inside(&self.slack, &predictor.slack).min(1.0);
        let part_f = part_inside(&shape.force, &predictor.force).min(1.0);
        let there = frame.moved(&shape.x, part_x, &predictor.coordinates);
        let mut left = 0.0;
        for e in 0..frame.rods.len() {
            let first_order = frame.change(&excess, e, &predictor.coordinates);
            let now = frame.excess(&there, e).value;
            predictor.curved[e] = now - excess[e].value - part_x * first_order;
            left += (shape.force[e] + part_f * predictor.force[e])
                * (self.slack[e] + part_x * predictor.slack[e]);
        }
        let gap = self.gap(&shape.force);
        let centring = (left / frame.rods.len() as f64 / gap).powi(3) * gap;
        let target: Vec<f64> = (0..frame.rods.len())
            .map(|e| centring - part_x * part_f * predictor.slack[e] * predictor.force[e])
            .collect();
        let corrector = self.step(shape, &excess, &target, &predictor.curved);
        let part_x = (INSIDE * part_inside(&self.slack, &corrector.slack)).min(1.0);
        let part_f = (INSIDE * part_inside(&shape.force, &corrector.force)).min(1.0);
        let force = shape.force.iter().zip(&corrector.force).map(|(f, df)| f + part_f * df);
        for (slack, change) in self.slack.iter_mut().zip(&corrector.slack) {
            *slack += part_x * change;
        }
        let x = frame.moved(&shape.x, part_x, &corrector.coordinates);
        Some(Shape { x, force: force.collect() })
    }

    /// The shape with the forces of slack cables taken for zero. Bars keep theirs: small or not,
    /// they have to keep their lengths.
    pub(super) fn settled(&self, shape: &Shape) -> Shape {
        let mean = shape.force.iter().sum::<f64>() / shape.force.len() as f64;
        let force = self.frame.rods.iter().enumerate().map(|(e, rod)| {
            let slack = self.slack[e] / rod.length > shape.force[e] / mean;
            if slack && rod.kind == Kind::Cable { 0.0 } else { shape.force[e] }
        });
        Shape { x: shape.x.clone(), force: force.collect() }
    }
}

#[cfg(test)]
mod tests;
