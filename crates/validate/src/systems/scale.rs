//! Relative to what: the sizes of lengths, forces and energies that violations and differences are
//! held against.
//!
//! They are those of the *problem*: its lengths, its loads, the prestress of its elastic members.
//! None of them grows with the forces of an answer, so that no absurd force forgives anything, and
//! no load vanishes beside a force.
//!
//! | size | what it is |
//! |---|---|
//! | length | largest distance of a joint from the reference, at most what supports and lengths allow |
//! | force at a joint | the largest of its load, the weight of its members, the mean load of the system |
//! | force of the whole | the sum of all loads |
//! | energy | that times the length |
//!
//! In a system without loads the prestress of elastic members stands for the loads: what they bear by
//! their own law at the places of the answer, each stretched to no more than twice its length.

use model::Vector;
use model::system::{Kind, Member, System, SystemEquilibrium};

use super::certificate::size_m;
use super::spans::length_m;
use super::statics::STORED_ULPS;
use numerics::vector::{minus, norm, worse};

/// Elastic members are not stretched by more than their length by any prestress: an answer with
/// absurd places does not set the size of forces.
const MOST_STRAIN: f64 = 1.0;
/// A strain below this is no prestress but the rounding of lengths: see
/// [`LENGTH_ROUNDING`](model::system::LENGTH_ROUNDING).
const LEAST_STRAIN: f64 = model::system::LENGTH_ROUNDING;
/// Forces beyond this many times all that acts make no difference larger: from here on they are a
/// finding of their own (module `forces`).
pub(super) const MOST_FORCE: f64 = 1e6;

/// The rounding of stored numbers explains no more than this part of what acts.
pub(super) const MOST_ROUNDING: f64 = 1e-6;

/// The sizes for one system, at the places of one answer.
#[derive(Clone)]
pub(crate) struct Scale {
    /// Of lengths, m.
    pub size_m: f64,
    /// Rounding of coordinates that far from the origin, m.
    pub stored_m: f64,
    /// What rounding may change of the energy, J. That of the coordinates: loads by it, and by its square half
    /// of what an elastic member gains of force by its length; the first order of that is in balance. That of the
    /// lengths of members in the sum of what they store: their prestress by it.
    pub stored_j: f64,
    /// All loads together, N.
    pub load_n: f64,
    /// Of all forces that act together, N; zero where nothing acts.
    pub total_n: f64,
    /// Loads and prestress together, N.
    pub held_n: f64,
    /// Of the forces that act at each joint, N; infinite where nothing acts anywhere, which leaves no
    /// size but that of the forces found.
    pub joint_n: Vec<f64>,
}

impl Scale {
    pub(crate) fn new(system: &System, answer: &SystemEquilibrium) -> Self {
        let joints = system.joints().len();
        let prestress_n = |member| prestress_n(member, &answer.joints_m);
        let all_prestress_n: f64 = system.members().iter().map(prestress_n).sum();
        let load_n = system.total_load_n();
        let loaded = load_n > 0.0;
        let mut joint_n = if loaded {
            // Not in the memory of the vectors, which is three times as large.
            system.joint_loads_n().iter().map(|load| norm(*load)).collect()
        } else {
            vec![0.0; joints]
        };
        for member in system.members() {
            let weight_n = member.body.mass_kg() * system.gravity_m_s2();
            let acts_n = if loaded { weight_n } else { prestress_n(member) };
            for joint in member.path() {
                joint_n[joint] = worse(joint_n[joint], acts_n);
            }
        }
        let total_n = if loaded { load_n } else { all_prestress_n };
        let mean_n = if total_n > 0.0 { total_n / joints as f64 } else { f64::INFINITY };
        for scale_n in &mut joint_n {
            *scale_n = scale_n.max(mean_n);
        }
        let size_m = size_m(system, answer).min(reach_m(system));
        let far_m =
            system.reference_m().iter().fold(size_m, |most, x| worse(most, x.abs() + size_m));
        let stored_m = STORED_ULPS * f64::EPSILON * far_m;
        let strain_j: f64 =
            system.members().iter().map(|m| 0.5 * stored_n(m, stored_m) * stored_m).sum();
        let summed = system.members().iter().map(|m| prestress_n(m) * m.body.length_m());
        let summed_j = STORED_ULPS * f64::EPSILON * summed.sum::<f64>();
        let most_j = MOST_ROUNDING * total_n * size_m;
        let stored_j = load_n * stored_m + (strain_j + summed_j).min(most_j);
        let held_n = load_n + all_prestress_n;
        Self { size_m, stored_m, stored_j, load_n, total_n, held_n, joint_n }
    }

    /// What differences of forces are relative to where forces of this size meet, N: all that acts, or
    /// in a nearly singular shape, whose forces are as uncertain as they are large, these, up to
    /// [`MOST_FORCE`] times that.
    pub(super) fn of_forces_n(&self, meet_n: f64) -> f64 {
        if self.total_n > 0.0 {
            worse(self.total_n, meet_n.min(MOST_FORCE * self.total_n))
        } else {
            meet_n
        }
    }

    /// The largest force that acts at a joint, and all prestress, N: what balance shows of the loads
    /// where each joint is held against the same error.
    pub(crate) fn seen_n(&self) -> f64 {
        self.held_n - self.total_n + self.joint_n.iter().copied().fold(0.0, worse)
    }

    /// Of energies, J.
    pub(super) fn energy_j(&self) -> f64 {
        self.total_n * self.size_m
    }
}

/// The size of the energies of a system, J: its loads and its prestress at the places of this answer,
/// times the lengths of all members.
pub fn energy_size_j(system: &System, answer: &SystemEquilibrium) -> f64 {
    Scale::new(system, answer).held_n * system.total_length_m()
}

/// What an elastic member gains of force by the rounding of its joints' coordinates, N.
pub(super) fn stored_n(member: &Member, rounding_m: f64) -> f64 {
    let spans = (member.via().len() + 1) as f64;
    member.stiffness_n.map_or(0.0, |n| n * spans * rounding_m / member.body.length_m())
}

/// No joint that members hold is further from the reference than the farthest support and all
/// members in a row; elastic ones at twice their length.
fn reach_m(system: &System) -> f64 {
    let origin = system.reference_m();
    let supports = system.joints().iter().filter_map(|joint| joint.support.at_m());
    let farthest = supports.map(|at| norm(minus(at, origin))).fold(0.0, f64::max);
    let floor_m = system.floor_m().map_or(0.0, |floor_m| (floor_m - origin[2]).abs());
    farthest.max(floor_m) + (1.0 + MOST_STRAIN) * system.total_length_m()
}

/// What an elastic member bears by its law at these places, N.
fn prestress_n(member: &Member, joints_m: &[Vector]) -> f64 {
    let Some(stiffness_n) = member.stiffness_n else { return 0.0 };
    if member.path().any(|joint| joint >= joints_m.len()) {
        return 0.0;
    }
    let strain = length_m(member, joints_m) / member.body.length_m() - 1.0;
    let borne = match member.kind {
        Kind::Bar => strain.abs(),
        Kind::Cable => strain,
        Kind::Strut => -strain,
    };
    stiffness_n * borne.clamp(LEAST_STRAIN, MOST_STRAIN)
}

#[cfg(test)]
mod tests;
