//! A point of the reduced system: 3n angles and the pull of the first anchor.
//!
//! The rows of the centres in (40) and the constraint functions are affine in the centres and in
//! all multipliers but the first three. Solved exactly (static condensation), they leave
//!
//! $$ g_i = l_i \left[\frac{\partial u_i}{\partial(\psi_i,\theta_i,\varphi_i)}\right]^T F_i = 0,
//! \qquad h = \sum_i l_i u_i - D = 0, \qquad F_i = p_0 + c_i e_z, $$
//!
//! with the span *D*, the pull $p_0 = -(\lambda_1,\lambda_2,\lambda_3)$ of the chain on the first
//! anchor, and the weight $c_i$ hanging between that anchor and bar i: 3n + 3 equations.

use nalgebra::{Matrix3, Vector3};

use crate::full::mechanism::Mechanism;
use crate::full::rotation::Frame;
use crate::larger::larger;

/// In which units the residual and the step of the reduced system are measured, besides the total
/// length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Metric {
    /// Unit of force, in units of the total weight.
    pub force: f64,
    /// Metric of the gap at the last anchor, and of the pull; symmetric.
    pub gap: Matrix3<f64>,
}

impl Metric {
    /// Total weight and total length, in all directions.
    pub fn plain() -> Self {
        Self { force: 1.0, gap: Matrix3::identity() }
    }
}

/// One bar at a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BarAt {
    /// Sines and cosines of its angles.
    pub frame: Frame<f64>,
    /// Direction.
    pub u: Vector3<f64>,
    /// Derivatives of the direction by the angles.
    pub gradient: Matrix3<f64>,
    /// Force in the bar, tension along +u.
    pub force: Vector3<f64>,
    /// Moment rows divided by the length: `gradient`ᵀ · `force`.
    pub moment: Vector3<f64>,
}

/// Angles, pull, and everything of first order that follows from them.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    /// ψ, θ, φ of each bar, rad.
    pub angles: Vec<[f64; 3]>,
    /// Pull of the chain on the first anchor.
    pub pull: Vector3<f64>,
    /// The bars.
    pub bars: Vec<BarAt>,
    /// Closure `h`.
    pub closure: Vector3<f64>,
}

impl Point {
    pub fn new(bars: usize) -> Self {
        let bar = BarAt {
            frame: Frame::new([0.0; 3]),
            u: Vector3::x(),
            gradient: Matrix3::zeros(),
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
        };
        Self {
            angles: vec![[0.0; 3]; bars],
            pull: Vector3::zeros(),
            bars: vec![bar; bars],
            closure: Vector3::zeros(),
        }
    }

    /// Directions and their derivatives from the angles.
    pub fn turn(&mut self, mechanism: &Mechanism) {
        self.closure = -mechanism.end;
        let bars = self.bars.iter_mut().zip(&self.angles).zip(&mechanism.lengths);
        for ((bar, angles), length) in bars {
            bar.frame = Frame::new(*angles);
            bar.u = bar.frame.direction();
            bar.gradient = bar.frame.gradient(&bar.u);
            self.closure += bar.u * *length;
        }
    }

    /// Forces and moments from the directions and the pull.
    pub fn load(&mut self, carried: &[f64]) {
        for (bar, weight) in self.bars.iter_mut().zip(carried) {
            bar.force = self.pull + Vector3::new(0.0, 0.0, *weight);
            bar.moment = bar.gradient.tr_mul(&bar.force);
        }
    }

    /// Norm of the residual: $\sum l_i |g_i/l_i|^2 + |M h|^2$ in units of the total length and of
    /// the given force, with the metric M of the gap; a measure that does not depend on how finely
    /// a chain is divided.
    pub fn norm(&self, mechanism: &Mechanism, metric: &Metric) -> f64 {
        let bars = self.bars.iter().zip(&mechanism.lengths);
        let moments: f64 = bars.map(|(bar, length)| length * bar.moment.norm_squared()).sum();
        let gap = metric.gap * self.closure;
        (moments / (metric.force * metric.force) + gap.norm_squared()).sqrt()
    }

    /// The largest force in the chain, at least the mean weight of a bar.
    pub fn largest_force(&self, carried: &[f64]) -> f64 {
        let last = self.pull + Vector3::new(0.0, 0.0, 1.0);
        self.pull.norm().max(last.norm()).max(1.0 / carried.len() as f64)
    }

    /// The largest equation: moment rows in units of the largest force times the mean length, rows
    /// of the closure in units of the total length. NaN when any is NaN.
    pub fn largest(&self, mechanism: &Mechanism, carried: &[f64]) -> f64 {
        let unit = self.largest_force(carried) / carried.len() as f64;
        let closure = largest_entry(0.0, &self.closure);
        self.bars.iter().zip(&mechanism.lengths).fold(closure, |largest, (bar, length)| {
            largest_entry(largest, &(bar.moment * (*length / unit)))
        })
    }

    /// Work of the weights on the way here, up to a constant: $\sum l_i c_i\\, u_i \cdot e_z$. It
    /// is largest where the chain has sunk lowest.
    pub fn work(&self, mechanism: &Mechanism, carried: &[f64]) -> f64 {
        let bars = self.bars.iter().zip(&mechanism.lengths).zip(carried);
        bars.map(|((bar, length), weight)| length * weight * bar.u.z).sum()
    }
}

/// The larger of a number and the entries of a vector.
fn largest_entry(start: f64, vector: &Vector3<f64>) -> f64 {
    vector.iter().map(|entry| entry.abs()).fold(start, larger)
}
