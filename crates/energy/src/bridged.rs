//! Bars that carry nothing because they just bridge a gap.
//!
//! Bars without load between them whose lengths add up to the distance of their ends, in a chain
//! that is in balance without them, lie straight and carry nothing. The energy then rises only with
//! the fourth power of their angles, and a minimiser leaves them by the fourth root of rounding off
//! the line. On the line the rest of the chain answers for itself: its gradient is rounding, and
//! the chain closes. Of a single bar without force the closure alone knows the direction.

use std::ops::Range;

use crate::refine::{NO_FORCE, Point};
use crate::slope::Slope;
use crate::vector::{along, dot, norm, unit};

/// Force along bars, over the largest of the chain, by which a minimiser leaves bars unsettled that
/// carry nothing: their angle is the fourth root of rounding, the force its square.
const SOFT: f64 = 1e-6;

/// Angle, rad, within which such bars are left of their line.
const NEARLY_STRAIGHT: f64 = 1e-3;

/// Corrections of the closure.
const CORRECTIONS: usize = 12;

/// A gap, in the solver's unit of length, that is rounding of a sum of directions.
const CLOSED: f64 = 1e-13;

/// A gap that is too large for an answer, some ten times the tolerance of the closure.
const OPEN: f64 = 1e-12;

impl Point {
    /// Lay bars that just bridge a gap on a line, if the chain is in balance and closed there. The
    /// angle, rad, by which roundings of lengths leave such bars unknown.
    pub(crate) fn straightened(&mut self) -> Option<f64> {
        let pull = norm(self.multiplier).max(1.0);
        let mut shape = self.shape.clone();
        let mut laid = Vec::new();
        for run in self.unloaded_runs() {
            let soft = |i: usize| {
                let load = self.links.load(i, self.multiplier);
                dot(load, shape.u[i]).abs() <= SOFT * pull
            };
            let sum =
                run.clone().fold([0.0; 3], |sum, i| along(sum, self.links.length[i], shape.u[i]));
            let Some(line) = unit(sum) else { continue };
            let near = |i: usize| norm(along(shape.u[i], -1.0, line)) < NEARLY_STRAIGHT;
            if run.clone().all(|i| soft(i) && near(i)) {
                shape.u[run.clone()].fill(line);
                laid.extend(run);
            }
        }
        if laid.is_empty() {
            return None;
        }
        shape.moments = self.links.measure(&shape.u);
        let shape = self.links.close(shape, CORRECTIONS).ok()?;
        let slope = Slope::new(&self.links, &shape);
        let empty = laid.iter().all(|&i| slope.axial[i].abs() <= NO_FORCE * slope.pull);
        if !empty || slope.residual() > NO_FORCE || norm(shape.moments.gap) > CLOSED {
            return None;
        }
        self.multiplier = slope.multiplier;
        self.shape = shape;
        Some(f64::EPSILON.sqrt())
    }

    /// Runs of two and more bars without any load between them.
    fn unloaded_runs(&self) -> Vec<Range<usize>> {
        let (mut runs, mut first) = (Vec::new(), 0);
        for run in self.links.carried.chunk_by(|a, b| (a - b).abs() <= 0.0) {
            if run.len() > 1 {
                runs.push(first..first + run.len());
            }
            first += run.len();
        }
        runs
    }

    /// Whether the chain is closed, or can be by turns that only bars without force notice.
    pub(crate) fn closed(&mut self) -> bool {
        if norm(self.shape.moments.gap) <= CLOSED {
            return true;
        }
        if let Ok(shape) = self.links.close(self.shape.clone(), CORRECTIONS) {
            self.shape = shape;
        }
        norm(self.shape.moments.gap) <= OPEN
    }
}
