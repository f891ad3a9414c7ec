//! What a bound's programme says about the chain that attains it.

use intervals::CompensatedSum;
use model::{Problem, Vector};

use crate::data::{Data, Plane, Sense};

/// A chain found by a cone programme, without any starting guess.
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// Positions of the joints 0..=n, world frame, m. Where the anchors are on one vertical, the
    /// chain may be turned about it; it is given in the plane OYZ.
    pub joints_m: Vec<Vector>,
    /// Axial force of each bar, weights lumped to the joints, N; tension positive.
    pub axial_n: Vec<f64>,
    /// Force of the ground on the chain at the last anchor, world frame, N.
    pub pull_n: Vector,
    /// Energy from the height of joint 0, J, in floating point.
    pub energy_j: f64,
    /// Distance of the end of the bars, put one after the other, from the last anchor, m.
    pub open_m: f64,
}

impl Configuration {
    /// From the bar vectors in the plane of the anchors, the axial forces and the pull, all without
    /// units and with gravity reversed for an upper bound.
    pub(crate) fn new(
        problem: &Problem,
        sense: Sense,
        data: &Data,
        plane: &Plane,
        bars: &[[f64; 2]],
        axial: &[f64],
        pull: [f64; 2],
    ) -> Self {
        let anchors = problem.chain().anchors();
        let mut sum = [CompensatedSum::default(); 3];
        let mut go = |step: Vector| {
            for (sum, step) in sum.iter_mut().zip(step) {
                sum.add(step);
            }
            sum.map(|sum| sum.value())
        };
        go(anchors.start_m);
        let mut energy = CompensatedSum::default();
        let mut joints_m = Vec::with_capacity(bars.len() + 1);
        joints_m.push(anchors.start_m);
        for (bar, tail) in bars.iter().zip(&data.tail_weight) {
            energy.add(tail.mid() * bar[1]);
            joints_m.push(go(plane.lift(*bar).map(|x| data.scale.length * x)));
        }
        let [x, y, z] = go(anchors.end_m.map(|x| -x));
        let newtons = |x: f64| sense.sign() * data.scale.weight * x;
        Self {
            joints_m,
            axial_n: axial.iter().map(|f| newtons(*f)).collect(),
            pull_n: plane.lift(pull).map(newtons),
            energy_j: sense.energy(data.scale, energy.value()),
            open_m: (x * x + y * y + z * z).sqrt(),
        }
    }
}
