//! What the solver improves step by step.

use nalgebra::Vector3;

use super::framework::Framework;

/// Places of the joints and axial forces of the members, tension positive.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub places: Vec<Vector3<f64>>,
    pub axial: Vec<f64>,
    /// Whether a member keeps its law at this length; a slack cable does not.
    pub taut: Vec<bool>,
}

impl State {
    /// Directions of the members, and their lengths.
    pub fn directions(&self, framework: &Framework) -> Vec<(Vector3<f64>, f64)> {
        let spans = framework.links.iter().map(|link| link.span(&self.places));
        spans
            .map(|span| {
                let length = span.norm();
                if length > 0.0 { (span / length, length) } else { (Vector3::zeros(), 0.0) }
            })
            .collect()
    }

    /// Largest force in a member or load of a joint.
    pub fn largest_force(&self, framework: &Framework) -> f64 {
        let loads = framework.nodes.iter().map(|node| node.load.norm());
        self.axial.iter().map(|axial| axial.abs()).chain(loads).fold(0.0, f64::max)
    }
}
