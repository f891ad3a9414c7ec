//! An answer of positions and axial forces with everything that follows from them.

use model::system::{System, SystemEquilibrium, SystemStability};
use model::{Evidence, InSpace, SolverName, Vector};

use super::near::potential_j;
use super::spans::unit;
use numerics::vector::{minus, norm, plus, times};

/// Positions and axial forces with end forces, reactions and energy by the lever rule and the
/// members' laws. Its second-order behaviour is nobody's finding and must not be read.
pub(crate) fn placed(
    system: &System,
    source: &SolverName,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> SystemEquilibrium {
    let origin = system.reference_m();
    let from_origin_m: Vec<Vector> = joints_m.iter().map(|at| minus(*at, origin)).collect();
    let mut left = system.joint_loads_n();
    let (mut start_forces_n, mut end_forces_n) = (vec![], vec![]);
    for (k, member) in system.members().iter().enumerate() {
        let pulls: Vec<Vector> =
            member.spans().map(|span| times(axial_n[k], unit(span, joints_m))).collect();
        let [start, end] = member.end_loads_n(system.gravity_m_s2());
        start_forces_n.push(minus(times(-1.0, pulls[0]), start));
        end_forces_n.push(minus(pulls[pulls.len() - 1], end));
        for ([a, b], pull) in member.spans().zip(pulls) {
            left[a] = plus(left[a], pull);
            left[b] = minus(left[b], pull);
        }
    }
    let held = |(joint, left): (&model::system::Joint, Vector)| {
        times(-1.0, minus(left, joint.support.free_part(left)))
    };
    let reactions_n = system.joints().iter().zip(left).map(held).collect();
    SystemEquilibrium {
        solver: source.clone(),
        energy_j: potential_j(system, system.members(), &from_origin_m),
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

/// The largest force of an answer: axial, of the ground, or load of a joint, N.
pub(crate) fn largest_n(system: &System, answer: &SystemEquilibrium) -> f64 {
    let forces = answer.axial_n.iter().map(|force| force.abs());
    let vectors = system.joint_loads_n().into_iter().chain(answer.reactions_n.iter().copied());
    forces.chain(vectors.map(norm)).fold(0.0, f64::max)
}
