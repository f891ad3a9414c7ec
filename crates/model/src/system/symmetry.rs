//! Parts of a system, and those that turn freely about a vertical.

use super::graph::Graph;
use super::{Support, System};
use crate::chain::VERTICAL_TOLERANCE;

/// Joints that members connect with each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Their numbers, ascending.
    pub joints: Vec<usize>,
    /// Place `[x, y]` of the vertical about which the part turns freely, m, if there is one: all
    /// its supports lie on that vertical or leave every turn about it free, and all its loads are
    /// vertical.
    pub axis_m: Option<[f64; 2]>,
}

impl System {
    /// The connected parts, in the order of their first joints.
    ///
    /// ```
    /// let system = model::system::System::from(model::cases::paper().chain());
    /// let parts = system.parts();
    /// assert_eq!(parts[0].joints, [0, 1, 2, 3]);
    /// assert_eq!(parts[0].axis_m, Some([0.0, 0.0]));
    /// ```
    pub fn parts(&self) -> Vec<Part> {
        let graph = Graph::new(self);
        let level_loads = self.joints_with_level_loads();
        let with_axis = |joints: Vec<usize>| {
            let still = joints.iter().all(|joint| !level_loads[*joint]);
            let axis_m = if still { self.axis_m(&joints) } else { None };
            Part { joints, axis_m }
        };
        graph.components().into_iter().map(with_axis).collect()
    }

    /// The vertical through all supports of these joints.
    fn axis_m(&self, joints: &[usize]) -> Option<[f64; 2]> {
        let near_m = VERTICAL_TOLERANCE * self.total_length_m();
        let mut axis_m: Option<[f64; 2]> = None;
        for joint in joints {
            let (at_m, vertical) = match self.joints[*joint].support {
                Support::Free => continue,
                Support::Fixed { at_m } => (at_m, true),
                Support::Line { at_m, direction: [x, y, _] } => {
                    (at_m, x.hypot(y) <= VERTICAL_TOLERANCE)
                }
                Support::Plane { normal: [x, y, _], .. } if x.hypot(y) <= VERTICAL_TOLERANCE => {
                    continue;
                }
                Support::Plane { at_m, .. } => (at_m, false),
            };
            let [x, y, _] = at_m;
            let [axis_x, axis_y] = *axis_m.get_or_insert([x, y]);
            if !vertical || (x - axis_x).hypot(y - axis_y) > near_m {
                return None;
            }
        }
        axis_m
    }

    /// Which joints feel a load that is not vertical, by number.
    pub fn joints_with_level_loads(&self) -> Vec<bool> {
        let level = |[x, y, _]: [f64; 3]| x.abs() > 0.0 || y.abs() > 0.0;
        let mut found: Vec<bool> = self.joints.iter().map(|joint| level(joint.force_n)).collect();
        for member in &self.members {
            if member.loads.iter().any(|load| level(load.force_n)) {
                found[member.from] = true;
                found[member.to] = true;
            }
        }
        found
    }
}
