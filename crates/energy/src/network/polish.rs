//! Newton's method for places and forces together, down to rounding level.
//!
//! The springs of the augmented Lagrangian are stiff here and every step updates the forces, so that a step
//! leaves next to nothing of the springs: it is the step of the system of balances and lengths. Its matrix is
//! positive definite exactly where the second derivative of the energy is, on the motions that keep the lengths:
//! at saddles and maxima it is refused. Which cables and struts resist follows from the signs of their
//! forces, afresh for each factorisation.

use std::sync::Arc;

use crate::network::frame::Frame;
use crate::network::law::{Excess, Softened};
use crate::network::newton::{NEAR, Newton};
use crate::network::shape::Shape;
use crate::vector::{dot, scaled};

/// Strain of the springs in Newton's method for places and forces: what a step leaves of the error.
const STIFF_STRAIN: f64 = 1e-6;

/// Diagonal added there, over the size of the matrix: where a motion is neutral the step has no part of it.
pub(super) const NEUTRAL: f64 = 1e-10;

/// Steps of Newton's method for places and forces, and with one factorisation.
const POLISH: usize = 12;
const CHORDS: usize = 6;

/// Misfit above which members have turned too far for the factorisation of the step before: its stiff springs
/// point the old way.
const CHORD_NEAR: f64 = 1e-8;

/// A chord step must leave at most this part of the residual.
const CHORD_PROGRESS: f64 = 0.3;

impl Newton {
    /// Newton's method for places and forces. Nothing where it does not converge, or not to a minimum.
    pub(super) fn polish(&mut self, shape: &Shape) -> Option<Shape> {
        let frame = Arc::clone(&self.frame);
        let (mut shape, mut slope) = (shape.clone(), frame.slope(shape));
        let stiffness = frame.largest_force(&shape.force) / STIFF_STRAIN;
        for _ in 0..POLISH {
            let start = slope.residual();
            let active = self.factorise_stiff(&shape, stiffness)?;
            for chord in 0..CHORDS {
                let Some(next) = self.chord(&shape, stiffness, &active) else { break };
                let there = frame.slope(&next);
                let (before, after) = (slope.residual(), there.residual());
                if !after.is_finite() {
                    return None;
                }
                if after >= before && before <= self.tolerance(&shape) {
                    return Some(shape);
                }
                if chord > 0 && after > CHORD_PROGRESS * before {
                    break;
                }
                (shape, slope) = (next, there);
                if slope.misfit > CHORD_NEAR {
                    break;
                }
            }
            // Below the tolerance it goes on as long as that brings something.
            let rounded = slope.residual() <= rounding_floor(&frame, &shape);
            let slow = slope.residual() > CHORD_PROGRESS * start;
            if rounded || (slow && slope.residual() <= self.tolerance(&shape)) {
                return Some(shape);
            }
            if slope.residual() > 2.0 * start.max(NEAR) {
                return None;
            }
        }
        None
    }

    /// Which members resist, with stiff springs; the matrix is factorised. Nothing where it is not positive
    /// definite.
    fn factorise_stiff(&mut self, shape: &Shape, stiffness: f64) -> Option<Vec<bool>> {
        let frame = Arc::clone(&self.frame);
        let excess = frame.excesses(&shape.x);
        let active: Vec<bool> = (0..frame.rods.len())
            .map(|e| stiff(&frame, &excess[e], shape.force[e], e, stiffness).stiffness > 0.0)
            .collect();
        let largest = frame.largest_force(&shape.force);
        let sizes = frame.sizes(|e| if active[e] { largest } else { 0.0 });
        let block = |e: usize| {
            let spring = stiff(&frame, &excess[e], shape.force[e], e, stiffness);
            excess[e].block(if active[e] { shape.force[e] } else { 0.0 }, spring.stiffness)
        };
        frame.fill(&mut self.factor, block, |joint| {
            NEUTRAL * if sizes[joint] > 0.0 { sizes[joint] } else { largest }
        });
        self.factor.cholesky().then_some(active)
    }

    /// One step with the factorisation at hand; nothing where other members resist than in it.
    fn chord(&mut self, shape: &Shape, stiffness: f64, active: &[bool]) -> Option<Shape> {
        let frame = Arc::clone(&self.frame);
        let excess = frame.excesses(&shape.x);
        let soft: Vec<Softened> = (0..frame.rods.len())
            .map(|e| stiff(&frame, &excess[e], shape.force[e], e, stiffness))
            .collect();
        if soft.iter().zip(active).any(|(soft, active)| (soft.stiffness > 0.0) != *active) {
            return None;
        }
        let mut step = frame.gradient(|e| scaled(soft[e].force, excess[e].gradient));
        for value in &mut step {
            *value = -*value;
        }
        self.factor.solve(&mut step);
        let force = (0..frame.rods.len()).map(|e| {
            soft[e].force + soft[e].stiffness * excess[e].change(frame.relative(&step, e))
        });
        Some(Shape { force: force.collect(), x: frame.moved(&shape.x, 1.0, &step) })
    }

    /// The tolerance, or what rounding of the places leaves where that is more.
    pub(super) fn tolerance(&self, shape: &Shape) -> f64 {
        self.settings.tolerance.max(rounding_floor(&self.frame, shape))
    }
}

/// A member with a spring of strain [`STIFF_STRAIN`] under the largest force.
fn stiff(frame: &Frame, excess: &Excess, force: f64, rod: usize, stiffness: f64) -> Softened {
    let rod = &frame.rods[rod];
    rod.softened(excess.value, force, stiffness / rod.length)
}

/// What roundings of the places leave of the lengths: some units in the last place of the largest
/// coordinate over the length of a member.
pub(super) fn rounding_floor(frame: &Frame, shape: &Shape) -> f64 {
    let extent = shape.x.iter().map(|x| dot(*x, *x)).fold(0.0, f64::max).sqrt();
    let shortest = frame.rods.iter().map(|rod| rod.length).fold(f64::INFINITY, f64::min);
    8.0 * f64::EPSILON * (1.0 + extent / shortest)
}
