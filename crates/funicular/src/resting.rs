//! How far a position is from others, whatever way its parts that turn freely face.

use model::Vector;
use model::system::System;
use numerics::vector::{minus, norm, worse};

/// Positions nearer to each other than this, in total lengths, are one: what is left of a motion
/// when it counts as rest, with room for soft equilibria.
const SAME: f64 = 1e-5;

/// A list of positions.
#[derive(Debug, Clone)]
pub(crate) struct Resting {
    /// Parts that turn freely about a vertical: where that stands, and their joints.
    turning: Vec<([f64; 2], Vec<usize>)>,
    total_length_m: f64,
    places: Vec<Vec<Vector>>,
}

impl Resting {
    pub(crate) fn new<'a>(system: &System, places: impl Iterator<Item = &'a [Vector]>) -> Self {
        let parts = system.parts().into_iter();
        Self {
            turning: parts.filter_map(|part| part.axis_m.map(|at| (at, part.joints))).collect(),
            total_length_m: system.total_length_m(),
            places: places.map(<[Vector]>::to_vec).collect(),
        }
    }

    pub(crate) fn add(&mut self, joints_m: &[Vector]) {
        self.places.push(joints_m.to_vec());
    }

    /// The number of the first position that is the same.
    pub(crate) fn nearest(&self, joints_m: &[Vector]) -> Option<usize> {
        (0..self.places.len()).find(|&place| self.distance(place, joints_m) <= SAME)
    }

    /// Largest distance of a joint from its place, in total lengths, when all parts that turn
    /// freely are turned to face the same way.
    pub(crate) fn distance(&self, place: usize, joints_m: &[Vector]) -> f64 {
        let there = &self.places[place];
        let mut turned = joints_m.to_vec();
        for (axis, joints) in &self.turning {
            let from_axis = |at: &Vector| [at[0] - axis[0], at[1] - axis[1]];
            // The turn with the least sum of squares (Procrustes in the plane).
            let (mut cos, mut sin) = (0.0, 0.0);
            for &joint in joints {
                let (a, b) = (from_axis(&joints_m[joint]), from_axis(&there[joint]));
                cos += a[0] * b[0] + a[1] * b[1];
                sin += a[0] * b[1] - a[1] * b[0];
            }
            let length = f64::hypot(cos, sin);
            if length > 0.0 {
                for &joint in joints {
                    let [x, y] = from_axis(&joints_m[joint]);
                    turned[joint][0] = axis[0] + (cos * x - sin * y) / length;
                    turned[joint][1] = axis[1] + (sin * x + cos * y) / length;
                }
            }
        }
        let off = turned.iter().zip(there).map(|(a, b)| norm(minus(*a, *b)));
        // NaN is kept: it is no distance within which anything is the same.
        off.fold(0.0, worse) / self.total_length_m
    }
}
