//! An answer of positions and axial forces with everything that follows from them.

use model::system::{System, SystemEquilibrium, SystemStability};
use model::{Evidence, InSpace, SolverName, Vector, sum};

use super::best_forces::{free_part, joint_loads, law_n, shares_n};
use crate::systems::spans::{length_m, unit};
use numerics::vector::{dot, minus, norm, plus, times};

/// Positions and axial forces with end forces, reactions and energy by the lever rule and the
/// members' laws. Its second-order behaviour is nobody's finding and must not be read.
pub(super) fn complete(
    system: &System,
    source: &SolverName,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> SystemEquilibrium {
    let loads = joint_loads(system);
    let mut left: Vec<Vector> = loads.clone();
    let (mut start_forces_n, mut end_forces_n) = (vec![], vec![]);
    for (k, member) in system.members().iter().enumerate() {
        let pulls: Vec<Vector> =
            member.spans().map(|span| times(axial_n[k], unit(span, joints_m))).collect();
        let [start, end] = shares_n(system, k);
        start_forces_n.push(minus(times(-1.0, pulls[0]), start));
        end_forces_n.push(minus(pulls[pulls.len() - 1], end));
        for ([a, b], pull) in member.spans().zip(pulls) {
            left[a] = plus(left[a], pull);
            left[b] = minus(left[b], pull);
        }
    }
    let held = |(joint, left): (&model::system::Joint, Vector)| {
        let free = free_part(&joint.support, left);
        times(-1.0, minus(left, free))
    };
    let reactions_n = system.joints().iter().zip(left).map(held).collect();
    SystemEquilibrium {
        solver: source.clone(),
        energy_j: energy_j(system, joints_m, &loads),
        joints_m: joints_m.to_vec(),
        start_forces_n,
        end_forces_n,
        axial_n: axial_n.to_vec(),
        reactions_n,
        stability: SystemStability {
            in_space: InSpace::Unstable,
            index_in_space: 0,
            index_in_plane: None,
            neutral: 0,
        },
        evidence: Evidence::new("as given", f64::NAN, 0.0, 0),
    }
}

/// Potential energy relative to the system's reference.
fn energy_j(system: &System, joints_m: &[Vector], loads: &[Vector]) -> f64 {
    let origin = system.reference_m();
    let works = joints_m.iter().zip(loads).map(|(at, load)| -dot(*load, minus(*at, origin)));
    let elastic = system.members().iter().filter_map(|member| {
        let (stiffness_n, unstretched_m) = (member.stiffness_n?, member.body.length_m());
        let force = law_n(member.kind, stiffness_n, unstretched_m, length_m(member, joints_m));
        // F^2 / 2k, and with it none where the member is slack.
        Some(0.5 * force * force * unstretched_m / stiffness_n)
    });
    sum(works.chain(elastic))
}

/// The largest force of an answer: axial, of the ground, or load of a joint, N.
pub(super) fn largest_n(system: &System, answer: &SystemEquilibrium) -> f64 {
    let forces = answer.axial_n.iter().map(|force| force.abs());
    let vectors = joint_loads(system).into_iter().chain(answer.reactions_n.iter().copied());
    forces.chain(vectors.map(norm)).fold(0.0, f64::max)
}
