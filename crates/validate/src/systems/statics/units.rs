//! What the violations of an answer are measured by, and what rounding explains of them.

use model::system::{System, SystemEquilibrium};

use super::super::certificate::largest_force_n;
use super::super::free::free_joints;
use super::super::scale::{MOST_ROUNDING, Scale};
use super::super::spans::span_forces;
use numerics::vector::{beyond, minus, norm, worse};

/// Units in the last place that the rounding of stored numbers may come to: a coordinate is rounded
/// when it is stored, and two of them are subtracted.
pub(crate) const STORED_ULPS: f64 = 8.0;

/// Forces left over are measured by the forces that they are left from, but by no more than this
/// times what acts there. With the budget of 1e-11 the balance of every joint holds to 1e-9 of what
/// acts on it, whatever its members bear.
pub(super) const BORNE: f64 = 100.0;

/// What the violations of one answer are measured by.
pub(super) struct Units {
    /// Rounding of a coordinate or length, m.
    pub(super) rounding_m: f64,
    /// Rounding of the largest force, N.
    pub(super) rounding_n: f64,
    /// Rounding of the energy, J.
    pub(super) rounding_j: f64,
    /// Size of the system, m.
    pub(super) size_m: f64,
    /// Largest force on a member or of the ground, N.
    pub(super) largest_n: f64,
    /// What acts at each joint, N.
    pub(super) acts_n: Vec<f64>,
    /// Sum of the forces at each joint, N.
    pub(super) meet_n: Vec<f64>,
    /// All loads together, N.
    pub(super) load_n: f64,
    /// What acts on the whole, N.
    pub(super) total_n: f64,
    /// Joints on which and on whose members nothing acts: see [`free_joints`].
    pub(super) free: Vec<bool>,
}

/// What a force left over somewhere is measured by.
#[derive(Clone, Copy)]
#[expect(clippy::struct_field_names, reason = "the unit of each")]
pub(super) struct Local {
    /// What rounding explains of it, N.
    pub(super) rounding_n: f64,
    /// The most that it is measured by, N.
    pub(super) most_n: f64,
    /// The least that it is measured by, N: what acts on the whole where nothing acts there.
    pub(super) least_n: f64,
}

/// Rounding of the coordinates of an answer and of the lengths, m.
pub(in crate::systems) fn rounding_m(system: &System, answer: &SystemEquilibrium) -> f64 {
    let coordinates = answer.joints_m.iter().flatten();
    let far_m = coordinates.fold(0.0, |most: f64, x| worse(most, x.abs()));
    let longest_m = system.members().iter().map(|m| m.body.length_m()).fold(0.0, f64::max);
    STORED_ULPS * f64::EPSILON * far_m.max(longest_m)
}

impl Units {
    pub(super) fn new(system: &System, answer: &SystemEquilibrium, scale: Scale) -> Self {
        let largest_n = largest_force_n(answer);
        let mut meet_n: Vec<f64> = answer.reactions_n.iter().map(|f| norm(*f)).collect();
        for (k, member) in system.members().iter().enumerate() {
            for (joints, forces) in span_forces(member, k, answer) {
                for (joint, force) in joints.into_iter().zip(forces) {
                    meet_n[joint] += norm(force);
                }
            }
        }
        for (meet_n, acts_n) in meet_n.iter_mut().zip(&scale.joint_n) {
            *meet_n = worse(*meet_n, *acts_n);
        }
        Self {
            rounding_m: rounding_m(system, answer),
            rounding_n: STORED_ULPS * f64::EPSILON * largest_n,
            rounding_j: scale.stored_j,
            size_m: scale.size_m,
            largest_n,
            load_n: scale.load_n,
            total_n: if scale.total_n > 0.0 { scale.total_n } else { f64::INFINITY },
            acts_n: scale.joint_n,
            meet_n,
            // Without loads the prestress of springs acts everywhere.
            free: if scale.load_n > 0.0 {
                free_joints(system, std::slice::from_ref(answer))
            } else {
                vec![]
            },
        }
    }

    /// What a force left over at some joints, or between them, is measured by.
    pub(super) fn at(&self, joints: &[usize]) -> Local {
        self.along(joints, 0.0)
    }

    /// The same where forces follow directions of stored places, which rounding turns by `turned_n`.
    pub(super) fn along(&self, joints: &[usize], turned_n: f64) -> Local {
        let most = |of: &[f64]| joints.iter().filter_map(|k| of.get(*k)).copied().reduce(worse);
        let acts_n = most(&self.acts_n).unwrap_or(f64::INFINITY);
        let meet_n = most(&self.meet_n).unwrap_or(f64::INFINITY);
        // Small forces in a long row are differences of what acts on all of it.
        let whole_n = if self.total_n.is_finite() { self.total_n } else { 0.0 };
        let rounding_n = STORED_ULPS * f64::EPSILON * worse(meet_n, whole_n);
        let rounding_n = rounding_n.min(self.rounding_n) + turned_n;
        let rounding_n = rounding_n.min(MOST_ROUNDING * acts_n);
        // Members that bear nothing have no size of their own.
        let idle = joints.iter().any(|k| self.free.get(*k) == Some(&true));
        let least_n = if idle { whole_n } else { 0.0 };
        Local { rounding_n, most_n: worse(BORNE * acts_n, least_n), least_n }
    }

    /// How far the rounding of stored places turns the pull along a span, N.
    pub(super) fn turned_n(
        &self,
        pull_n: f64,
        [a, b]: [usize; 2],
        answer: &SystemEquilibrium,
    ) -> f64 {
        let span_m = norm(minus(answer.joints_m[b], answer.joints_m[a]));
        pull_n * (self.rounding_m / span_m.max(self.rounding_m))
    }
}

impl Local {
    /// What of a force left over rounding does not explain, in units of the largest of the forces
    /// that it is left from.
    pub(super) fn part(&self, left_n: f64, largest_n: f64) -> f64 {
        let excess = beyond(left_n, self.rounding_n);
        // No forces, and none left over.
        if excess <= 0.0 { 0.0 } else { excess / self.unit_n(largest_n) }
    }

    pub(super) fn unit_n(&self, largest_n: f64) -> f64 {
        if largest_n.is_nan() { largest_n } else { largest_n.max(self.least_n).min(self.most_n) }
    }
}
