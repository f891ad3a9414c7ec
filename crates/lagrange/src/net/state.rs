//! What the solver improves step by step.

use nalgebra::Vector3;

use super::framework::Framework;
use super::solution::Solution;
use crate::condensed::sums::DoubleDouble;

/// Places of the joints and axial forces of the members, tension positive.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub places: Vec<Vector3<f64>>,
    /// What rounding has cut off the places: in a long system the span of a short member would lose
    /// its last digits otherwise.
    pub rests: Vec<Vector3<f64>>,
    pub axial: Vec<f64>,
    /// Whether a member keeps its law at this length; a slack cable does not.
    pub taut: Vec<bool>,
}

impl State {
    /// Places and axial forces, as they are.
    pub fn new(places: Vec<Vector3<f64>>, axial: Vec<f64>, taut: Vec<bool>) -> Self {
        Self { rests: vec![Vector3::zeros(); places.len()], places, axial, taut }
    }

    /// The state of an answer.
    pub fn of(framework: &Framework, solution: &Solution) -> Self {
        let (units, answer) = (framework.units, &solution.equilibrium);
        let mut taut = vec![true; framework.members()];
        for &member in &solution.slack {
            taut[member] = false;
        }
        let places = answer.joints_m.iter().map(|at_m| units.place(*at_m)).collect();
        let axial = answer.axial_n.iter().map(|axial| axial / units.force_n).collect();
        Self::new(places, framework.by_link(axial), framework.by_link(taut))
    }

    /// The state with each joint moved by `t` times its step.
    pub fn moved(&self, steps: &[Vector3<f64>], t: f64) -> Self {
        let mut next = self.clone();
        for (k, step) in steps.iter().enumerate() {
            for axis in 0..3 {
                let more = self.rests[k][axis] + step[axis] * t;
                let place = DoubleDouble::sum(self.places[k][axis], more);
                (next.places[k][axis], next.rests[k][axis]) = (place.high, place.low);
            }
        }
        next
    }

    /// Directions of the members, and their lengths.
    pub fn directions(&self, framework: &Framework) -> Vec<(Vector3<f64>, f64)> {
        let spans =
            framework.links.iter().map(|link| link.span(&self.places) + link.span(&self.rests));
        spans
            .map(|span| {
                let length = span.norm();
                // NaN stays what it is.
                if length <= 0.0 { (Vector3::zeros(), 0.0) } else { (span / length, length) }
            })
            .collect()
    }

    /// Potential energy from this place: loads, and $c N^2/2$ of elastic members.
    pub fn energy(&self, framework: &Framework, from: &Vector3<f64>) -> f64 {
        let loads = framework.nodes.iter().zip(&self.places);
        let loads = loads.map(|(node, at)| -node.load.dot(&(at - from)));
        let stored = framework.links[..framework.members()]
            .iter()
            .zip(&self.axial)
            .map(|(l, force)| 0.5 * l.compliance * force * force);
        model::sum(loads.chain(stored))
    }

    /// Largest force in a member or load of a joint.
    pub fn largest_force(&self, framework: &Framework) -> f64 {
        let squares = framework.nodes.iter().map(|node| node.load.norm_squared());
        let loads = squares.fold(0.0, f64::max).sqrt();
        self.axial.iter().map(|axial| axial.abs()).fold(loads, f64::max)
    }
}

#[cfg(test)]
mod tests;
