//! The reduced system in motion: where we are, the step, and where it leads.

use nalgebra::{Complex, Vector3};

use crate::full::mechanism::Mechanism;
use crate::full::multipliers::estimate_pull;
use crate::full::point::{Metric, Point};
use crate::full::spin::regular_angles;
use crate::full::step::Matrix;

/// All memory of a solve; nothing is allocated while it runs.
#[derive(Debug, Clone)]
pub(crate) struct Reduced {
    /// The chain in units of its total length and weight.
    pub mechanism: Mechanism,
    /// Weights between joint 0 and the bars.
    pub carried: Vec<f64>,
    /// Where we are.
    pub here: Point,
    /// Where the step leads.
    pub there: Point,
    /// The matrix and the step.
    pub matrix: Matrix,
    /// How the residual is measured.
    metric: Metric,
    /// Bars whose spin axis is shorter get other angles.
    pub lock_margin: f64,
    /// How many times a bar got other angles.
    pub reparametrisations: usize,
    /// Whether the matrix is that of the point.
    assembled: bool,
}

impl Reduced {
    pub fn new(mechanism: Mechanism, lock_margin: f64) -> Self {
        Self {
            carried: mechanism.carried_weights(),
            here: Point::new(mechanism.bars()),
            there: Point::new(mechanism.bars()),
            matrix: Matrix::new(&mechanism),
            metric: Metric { force: 1.0, gap: mechanism.chord_metric() },
            mechanism,
            lock_margin,
            reparametrisations: 0,
            assembled: false,
        }
    }

    /// Go to the given angles and estimate the multipliers there.
    pub fn start(&mut self, angles: &[[f64; 3]]) {
        self.here.angles.copy_from_slice(angles);
        self.here.turn(&self.mechanism);
        self.estimate();
        self.leave_gimbal_lock(self.lock_margin);
    }

    /// Choose the unit of force for the run that begins here: the largest force, at least the
    /// weight. In a nearly taut chain it is large, and moments in units of the weight would be out
    /// of proportion.
    pub fn choose_unit(&mut self) {
        self.metric.force = self.here.largest_force(&self.carried).max(1.0);
        self.assembled = false;
    }

    /// Go to the given angles and pull.
    pub fn resume(&mut self, angles: impl Iterator<Item = [f64; 3]>, pull: Vector3<f64>) {
        for (to, from) in self.here.angles.iter_mut().zip(angles) {
            *to = from;
        }
        self.here.pull = pull;
        self.here.turn(&self.mechanism);
        self.here.load(&self.carried);
        self.assembled = false;
    }

    /// Estimate the multipliers for the angles at the point.
    pub fn estimate(&mut self) {
        self.here.pull = estimate_pull(&self.mechanism, &self.carried, &self.here);
        self.here.load(&self.carried);
        self.assembled = false;
    }

    /// Take the fraction `part` of the step on trial.
    pub fn advance(&mut self, part: f64) {
        let angles = self.there.angles.iter_mut().zip(&self.here.angles);
        for ((to, from), turn) in angles.zip(self.matrix.turns()) {
            *to = [from[0] + part * turn[0], from[1] + part * turn[1], from[2] + part * turn[2]];
        }
        self.there.pull = self.here.pull + self.matrix.pull_step * part;
        self.there.turn(&self.mechanism);
        self.there.load(&self.carried);
    }

    /// Stay where the last advance led.
    pub fn stay(&mut self) {
        std::mem::swap(&mut self.here, &mut self.there);
        self.assembled = false;
    }

    /// Describe every bar whose spin axis is shorter than `margin` by angles away from gimbal lock.
    pub fn leave_gimbal_lock(&mut self, margin: f64) {
        let mut changed = 0;
        for (bar, angles) in self.here.bars.iter().zip(&mut self.here.angles) {
            if bar.frame.spin().norm_squared() < margin * margin {
                *angles = regular_angles(&bar.u);
                changed += 1;
            }
        }
        if changed > 0 {
            self.here.turn(&self.mechanism);
            self.here.load(&self.carried);
            self.assembled = false;
            self.reparametrisations += changed;
        }
    }

    /// The bar on which the largest moment acts, from 0, and that moment in units of the largest
    /// force times the mean length. [`Self::largest`] sees only what the paper's equations
    /// see.
    pub fn largest_moment(&self) -> (usize, f64) {
        let unit = self.here.largest_force(&self.carried) / self.carried.len() as f64;
        let bars = self.here.bars.iter().zip(&self.mechanism.lengths);
        let moments = bars.map(|(bar, length)| bar.u.cross(&bar.force).norm() * length / unit);
        // A NaN is kept.
        moments.enumerate().fold((0, 0.0), |best, next| if next.1 <= best.1 { best } else { next })
    }

    /// Norm of the residual at the point.
    pub fn norm(&self) -> f64 {
        self.here.norm(&self.mechanism, &self.metric)
    }

    /// Largest equation, in the units of [`Settings::tolerance`](crate::Settings::tolerance).
    pub fn largest(&self) -> f64 {
        self.here.largest(&self.mechanism, &self.carried)
    }

    /// Compute the step $d = -(J^T J + s^2)^{-1} J^T r$ for the damping s; norm of $r + J d$.
    pub fn step(&mut self, damping: f64) -> f64 {
        if !self.assembled {
            self.matrix.assemble(&self.here, &self.metric);
            self.assembled = true;
        }
        let shift = Complex::new(0.0, damping);
        self.matrix.solve_shifted(shift, shift);
        self.matrix.predicted_norm()
    }

    /// Norm of the residual at the end of the step.
    pub fn attempt(&mut self) -> f64 {
        self.advance(1.0);
        self.there.norm(&self.mechanism, &self.metric)
    }

    /// Go there.
    pub fn accept(&mut self) {
        self.stay();
        self.leave_gimbal_lock(self.lock_margin);
    }
}

#[cfg(test)]
mod tests {
    use model::cases;

    use super::*;
    use crate::full::mechanism::Units;

    /// Three bars along (2, 3, 6), (6, -2, 3) and (3, -6, 2): of each what pulls at it across it times its length,
    /// over the largest force and a third.
    #[test]
    fn the_largest_moment_is_in_units_of_the_largest_force() {
        let chain = cases::paper();
        let mut mechanism = Mechanism::scaled(chain.chain(), Units::total(chain.chain()));
        mechanism.lengths = vec![0.2, 0.5, 0.3];
        mechanism.centres = vec![0.15, 0.2, 0.1];
        mechanism.weights = vec![0.3, 0.1, 0.6];
        let directions = [[2.0, 3.0, 6.0], [6.0, -2.0, 3.0], [3.0, -6.0, 2.0]];
        let directions = directions.map(|u| Vector3::from(u) / 7.0);
        // Of the weights, by the lever rule, what hangs before each bar.
        let carried = [0.3 * 0.25, 0.3 + 0.1 * 0.6, 0.4 + 0.6 * 2.0 / 3.0];
        for pull in [[2.0, -3.0, -6.0], [0.3, 0.1, -0.2]] {
            let pull = Vector3::from(pull);
            let mut reduced = Reduced::new(mechanism.clone(), 0.0);
            reduced.resume(directions.iter().map(regular_angles), pull);
            let largest = pull.norm().max((pull + Vector3::z()).norm());
            let moments = [0, 1, 2].map(|k| {
                let force = pull + Vector3::z() * carried[k];
                mechanism.lengths[k] * directions[k].cross(&force).norm() / (largest / 3.0)
            });
            let wanted = moments.iter().fold(0.0, |most: f64, moment| most.max(*moment));
            let (bar, found) = reduced.largest_moment();
            assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {moments:?}");
            assert!((moments[bar] - wanted).abs() < 1e-12 && bar < 3, "{bar} {moments:?}");
        }
    }
}
