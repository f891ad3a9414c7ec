use std::sync::Arc;
use std::time::Instant;

use model::system::{System, SystemEquilibrium, SystemStability};
use model::{Evidence, ForceChoice, InSpace, Rigidity, SelfStresses, SolverName, Vector};

use crate::error::Error;
use crate::net::frame::{Frame, end_loads_n};
use crate::net::limit::Limit;
use crate::net::minimise::Minimum;
use crate::net::settings::Settings;
use crate::net::shape::Shape;
use crate::net::stability::{SecondOrder, second_order};
use crate::net::weak::{self, Settled};
use crate::thresholds::{NO_STRAIN, ZERO};
use crate::vector::{along, dot, norm, scaled};

/// A local minimum of the energy: the equilibrium with its evidence, and what the search cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The observables.
    pub equilibrium: SystemEquilibrium,
    /// Whether the forces follow from the shape.
    pub forces: Forces,
    /// What the search cost.
    pub work: Work,
}

/// Whether the forces of the members follow from the shape and the loads.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Forces {
    /// One set of forces is in balance with the loads.
    Unique(Rigidity),
    /// A family of them is; given is the member with the least `sum F² l`, the limit of equally
    /// stiff members as they become rigid, or another one where that would make a cable push or a
    /// strut pull.
    Family {
        /// The counts.
        rigidity: Rigidity,
        /// Whether the forces given are those of the least norm.
        least: bool,
    },
    /// The system is too large for the rank of its rigidity matrix to be counted.
    NotCounted,
}

/// What a search cost, and how exactly it ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Work {
    /// Iterations of the interior point method on the relaxation.
    pub relaxation: u64,
    /// Iterations of Newton's method on the system itself.
    pub iterations: u64,
    /// Factorisations of the matrix of all coordinates; those of the springs that share forces are
    /// not counted.
    pub factorisations: u64,
    /// Unbalanced force of the joint worst held against its rounding, over its load, or over the mean
    /// load where that is more.
    pub unbalance: f64,
    /// Largest misfit of a length over the length.
    pub misfit: f64,
}

/// What `Evidence::residual` means here.
const RESIDUAL_OF: &str =
    "largest unbalanced force at a joint over its load, or misfit of a length";

impl Solution {
    pub(super) fn new(
        system: &System,
        frame: &Arc<Frame>,
        minimum: Minimum,
        settings: &Settings,
        clock: Instant,
    ) -> Result<Self, Error> {
        let Minimum { shape, mut factor, effort, limit } = minimum;
        let least = limit.is_some();
        let settled = weak::settled(system, frame, &mut factor, shape, limit.as_ref());
        let shape = &settled.shape;
        let slope = frame.slope(shape);
        let second = second_order(frame, shape, limit.as_ref(), &mut factor, settings.dense);
        if second.index > 0 {
            return Err(Error::NoMinimum { index: second.index });
        }
        if let Some(absurd) = frame.absurd(shape) {
            return Err(absurd);
        }
        let balance = frame.balance(system, &settled, settings.tolerance)?;
        if let Some(rod) = wrong_sign(frame, shape) {
            let force_n = shape.force[rod] * frame.force_n;
            if frame.rods[rod].ground {
                let joint = system.joints()[frame.rods[rod].to].name.to_string();
                return Err(Error::FloorPulls { joint, force_n });
            }
            return Err(Error::WrongSign { member: frame.member_of(rod) + 1, force_n });
        }
        if system.is_unloaded() && frame.unstrained(shape) {
            return Err(Error::NoLoad);
        }
        let forces = match second.rigidity {
            Some(rigidity) if rigidity.self_stresses == 0 => Forces::Unique(rigidity),
            Some(rigidity) => Forces::Family { rigidity, least },
            None => Forces::NotCounted,
        };
        let iterations = usize::try_from(effort.relaxation + effort.iterations);
        let iterations = iterations.unwrap_or(usize::MAX);
        // That over the largest force is less.
        let search = limit.as_ref().map_or_else(|| slope.residual(), |limit| limit.residual);
        let residual = balance.unbalance.max(search);
        let mut evidence = Evidence::new(RESIDUAL_OF, residual, balance.allowed, iterations);
        evidence.nullity = second.neutral;
        evidence.condition = second.condition;
        evidence.self_stresses = self_stresses(&second, limit.as_ref());
        evidence.rigidity = second.rigidity;
        let equilibrium = equilibrium(system, frame, &settled, &second, evidence);
        let work = Work {
            relaxation: effort.relaxation,
            iterations: effort.iterations,
            factorisations: factor.count,
            unbalance: balance.unbalance,
            misfit: slope.misfit,
        };
        let mut solution = Self { equilibrium, forces, work };
        solution.equilibrium.evidence.solve_s = clock.elapsed().as_secs_f64();
        Ok(solution)
    }
}

/// A cable that pushes or a strut that pulls, by more than the error of a force: what balances the
/// joints with such a force is no minimum, however small the residual.
fn wrong_sign(frame: &Frame, shape: &Shape) -> Option<usize> {
    let error = ZERO * frame.largest_force(&shape.force);
    let forces = frame.rods.iter().zip(&shape.force);
    forces.enumerate().find_map(|(member, (rod, force))| {
        (force.abs() > error && !rod.resists(*force)).then_some(member)
    })
}

impl Frame {
    /// Whether no elastic member, but between anchors, is longer or shorter than it would be by itself.
    fn unstrained(&self, shape: &Shape) -> bool {
        let mut members = self.rods.iter().zip(&shape.force);
        members.all(|(rod, force)| {
            self.is_held(rod) || rod.flexibility * force.abs() <= NO_STRAIN * rod.length
        })
    }

    /// Whether a search without loads has lost all that it had to lower: the shape is one of many.
    pub(super) fn is_relaxed(&self, shape: &Shape) -> bool {
        let loaded = self.loads.iter().any(|load| norm(*load) > 0.0);
        let members = self.rods.iter().zip(self.excesses(&shape.x));
        let force = members.map(|(rod, excess)| rod.prestress(excess.value)).collect();
        let shape = Shape { x: shape.x.clone(), force };
        !loaded && self.unstrained(&shape) && self.slope(&shape).misfit <= NO_STRAIN
    }
}

/// What equilibrium leaves open of the forces, and which of them are named.
fn self_stresses(second: &SecondOrder, limit: Option<&Limit>) -> Option<SelfStresses> {
    let basis = second.self_stresses.clone();
    let choice = limit.map_or(ForceChoice::Unknown, |_| ForceChoice::EquallyStiff);
    let misfits = limit.map(|limit| limit.misfits.iter().map(|misfit| misfit.misfit_m.abs()));
    let misfit_m = misfits.map(|misfits| misfits.fold(0.0, f64::max));
    let dimension = basis.len();
    (dimension > 0).then_some(SelfStresses { dimension, basis, choice, misfit_m, ranges: None })
}

/// The observables in the world.
fn equilibrium(
    system: &System,
    frame: &Frame,
    Settled { shape, along: directions }: &Settled,
    second: &SecondOrder,
    evidence: Evidence,
) -> SystemEquilibrium {
    let (mut start_forces_n, mut end_forces_n, mut axial_n) = (vec![], vec![], vec![]);
    let mut reactions_n: Vec<Vector> = system
        .joints()
        .iter()
        .map(|joint| {
            let weight = joint.mass_kg * system.gravity_m_s2();
            scaled(-1.0, along(joint.force_n, -weight, [0.0, 0.0, 1.0]))
        })
        .collect();
    for (e, member) in system.members().iter().enumerate() {
        // By virtual work: the derivative of the energy by the place of an end.
        let of = |e: usize| scaled(frame.force_n * shape.force[e], directions[e]);
        let strands = frame.rods[e].rope.checked_sub(1).map(|rope| &frame.ropes[rope as usize]);
        let last = strands.and_then(|strands| strands.last()).map_or_else(|| of(e), |e| of(*e));
        let pull = of(e);
        let [start, end] = end_loads_n(member, system.gravity_m_s2());
        let at_start = scaled(-1.0, along(pull, 1.0, start));
        let at_end = along(last, -1.0, end);
        reactions_n[member.from] = along(reactions_n[member.from], 1.0, at_start);
        reactions_n[member.to] = along(reactions_n[member.to], 1.0, at_end);
        for pair in strands.into_iter().flat_map(|strands| strands.windows(2)) {
            let bent = along(of(pair[0]), -1.0, of(pair[1]));
            let joint = frame.rods[pair[0]].to;
            reactions_n[joint] = along(reactions_n[joint], 1.0, bent);
        }
        start_forces_n.push(at_start);
        end_forces_n.push(at_end);
        // Of a rope it is the same in all strands, and the first one may have no length.
        let size =
            if strands.is_some() { frame.force_n * shape.force[e].abs() } else { norm(pull) };
        axial_n.push(shape.force[e].signum() * size);
    }
    for (spot, reaction) in frame.spots.iter().zip(&mut reactions_n) {
        // The ground pushes across the free motions alone; what is along them is rounding.
        for axis in &spot.axes[..spot.freedom] {
            *reaction = along(*reaction, -dot(*reaction, *axis), *axis);
        }
        if spot.freedom == 3 {
            *reaction = [0.0; 3];
        }
    }
    let floor = frame.rods.iter().zip(&shape.force).filter(|(rod, _)| rod.ground);
    for (rod, force) in floor {
        let spot = &frame.spots[rod.to];
        for axis in &spot.axes[..spot.freedom] {
            let push = force * frame.force_n * axis[2];
            reactions_n[rod.to] = along(reactions_n[rod.to], push, *axis);
        }
    }
    let place = |x: &Vector| along(frame.origin_m, frame.length_m, *x);
    let joints_m = system.joints().iter().zip(&shape.x).map(|(joint, x)| match joint.support {
        model::system::Support::Fixed { at_m } => at_m,
        _ => place(x),
    });
    SystemEquilibrium {
        solver: SolverName::ENERGY,
        energy_j: frame.energy(shape) * frame.force_n * frame.length_m,
        joints_m: joints_m.collect(),
        start_forces_n,
        end_forces_n,
        axial_n,
        reactions_n,
        stability: SystemStability {
            in_space: if second.index == 0 { InSpace::Stable } else { InSpace::Unstable },
            index_in_space: second.index,
            index_in_plane: second.index_in_plane,
            neutral: second.neutral,
        },
        evidence,
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member};

    use super::*;
    use crate::net::frame::Rod;

    #[test]
    fn a_strain_below_its_rounding_is_none() {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [1.0, 0.0, 0.0]),
            Joint::free("P").with_mass(2.0),
        ];
        let spring = |to, length_m| {
            Member::bar(0, to, Bar::homogeneous(length_m, 0.0).unwrap()).with_stiffness(50.0)
        };
        let system = System::new("springs", 10.0, joints, vec![spring(2, 3.0), spring(1, 0.5)]);
        let frame = Frame::new(&system.unwrap()).unwrap();
        // What is held between anchors may have any.
        let at = |strain: f64| {
            let force = |(e, rod): (usize, &Rod)| [strain, 1.0][e] * rod.length / rod.flexibility;
            let force = frame.rods.iter().enumerate().map(force).collect();
            frame.unstrained(&Shape { x: Vec::new(), force })
        };
        assert!(at(0.0) && at(0.9 * NO_STRAIN) && at(-0.9 * NO_STRAIN));
        assert!(!at(1.1 * NO_STRAIN) && !at(-1.1 * NO_STRAIN));
    }
}
