//! What the tolerance of an answer explains.

use model::Vector;
use model::system::{Member, System};
use serde::Serialize;

use numerics::vector::{minus, norm, worse};

/// Forces this many times larger than those found, or than all loads together, are no explanation
/// of a residual.
pub const IMPLAUSIBLE: f64 = 10.0;

/// The tolerance of an answer unless another is asked for.
pub const TOLERANCE: f64 = 1e-6;

/// Rounding of stored numbers: eight units in the last place of the largest, as everywhere in this
/// crate.
pub(super) const STORED: f64 = 8.0 * f64::EPSILON;

/// How well an answer is taken to know its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// The tolerance as asked for, relative.
    pub tolerance: f64,
    /// Positions: the tolerance times the size of the system, m.
    pub position_m: f64,
    /// Forces: the tolerance times the largest one, N.
    pub force_n: f64,
}

impl Bounds {
    /// Bounds of the positions; those of the forces are zero until the largest of them is known.
    pub(super) fn of_positions(system: &System, joints_m: &[Vector], tolerance: f64) -> Self {
        let origin = system.reference_m();
        let longest = system.members().iter().map(|m| m.body.length_m()).fold(0.0, f64::max);
        let size_m = joints_m.iter().map(|x| norm(minus(*x, origin))).fold(longest, worse);
        let far_m = joints_m.iter().flatten().fold(size_m, |far: f64, x| worse(far, x.abs()));
        Self { tolerance, position_m: tolerance * size_m + STORED * far_m, force_n: 0.0 }
    }

    /// The same for an answer whose largest force is so large.
    pub(super) fn with_largest_force(self, largest_n: f64) -> Self {
        Self { force_n: (self.tolerance + STORED) * largest_n, ..self }
    }

    /// How far the direction of a member may turn, as the length of the difference of two unit
    /// vectors.
    pub(super) fn turn(&self, distance_m: f64) -> f64 {
        // Unit vectors are no further apart than 2.
        if distance_m <= 2.0 * self.position_m {
            2.0
        } else {
            2.0 * self.position_m / (distance_m - self.position_m)
        }
    }

    /// Whether the joints of a span of a rope have run together, as far as their places tell.
    pub(super) fn meet(&self, member: &Member, [a, b]: [usize; 2], joints_m: &[Vector]) -> bool {
        member.rope.is_some() && norm(minus(joints_m[b], joints_m[a])) <= 2.0 * self.position_m
    }

    /// How far the length of a member may change along its spans, m.
    pub(super) fn distance_m(&self, member: &Member) -> f64 {
        2.0 * self.position_m * member.spans().count() as f64
    }
}

#[cfg(test)]
mod tests;
