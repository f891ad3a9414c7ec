use model::system::{Joint, Kind, System, SystemEquilibrium, SystemStability};
use model::{Evidence, ForceChoice, InSpace, Rigidity, SelfStresses, SolverName};
use nalgebra::{DMatrix, DVector, Vector3};

use super::admissible::shortest;
use super::decided::{Decided, SHARP};
use super::framework::{Framework, end_loads_n};
use super::ranges::ranges;
use super::residual::Residual;
use super::second_order::SecondOrder;
use super::state::State;
use crate::thresholds::ZERO;

/// Which of the forces in balance an answer shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Forces {
    /// There are no others.
    Unique,
    /// Self-stresses can be added. Shown is the member of the family with the least sum of squared
    /// axial forces times lengths, among those in which no cable pushes and no strut or floor pulls: the limit of
    /// equally stiff members.
    LeastNorm,
    /// Self-stresses can be added, and the member with the least norm was not in balance. Shown is
    /// the one that the iteration found.
    Found,
    /// The system is too large to count self-stresses (see
    /// [`Settings::dense_freedoms`](super::Settings::dense_freedoms)).
    Uncounted,
}

/// An equilibrium of a system. That it exists means converged.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The equilibrium as everyone reads it.
    pub equilibrium: SystemEquilibrium,
    /// Balance of the joints in units of their loads, or lengths in units of the length, whichever is
    /// larger. See [`Settings::tolerance`](super::Settings::tolerance).
    pub residual: f64,
    /// Sparse factorisations of all stages.
    pub factorisations: usize,
    /// Independent motions that keep the lengths of all inextensible taut members, where they were
    /// counted.
    pub mechanisms: Option<usize>,
    /// Basis of the self-stresses: axial forces of all members, N, that balance without loads;
    /// orthonormal, empty where the forces are unique. Only inextensible taut members take part.
    /// Nothing where they were not counted.
    pub self_stresses: Option<Vec<Vec<f64>>>,
    /// Where the rank of the members' directions, of which mechanisms and self-stresses are
    /// counted, was drawn: the smallest singular value that counts and the largest that does not,
    /// in units of the largest one; 1 and 0 where there is none. Values near each other
    /// mean an uncertain count.
    pub rank_gap: Option<[f64; 2]>,
    /// Which of the forces in balance are shown.
    pub forces: Forces,
    /// Members that are slack: cables shorter than their length, struts longer.
    pub slack: Vec<usize>,
    /// Inextensible members that have their length and bear no force: of cables and struts it is
    /// open whether they are slack or taut, of bars the direction may be open.
    pub limp: Vec<usize>,
}

/// A force below this part of the largest one counts as zero, and a member whose length is off by less than this part of it
/// just reaches.
pub(super) const NO_FORCE: f64 = 1e-10;

/// What the answer is made of.
pub(super) struct Found {
    pub state: State,
    /// At this state.
    pub residual: Residual,
    pub tolerance: f64,
    pub factorisations: usize,
    pub second_order: SecondOrder,
    /// Whether the forces are the least ones already.
    pub least: bool,
    pub solve_s: f64,
}

impl Solution {
    pub(super) fn new(system: &System, framework: &Framework, found: Found) -> Self {
        let Found { mut state, residual, tolerance, factorisations, second_order, least, solve_s } =
            found;
        let size = residual.size();
        let Residual { forces: mut left, directions, .. } = residual;
        let basis = second_order.self_stresses.as_deref();
        let forces =
            if least { Forces::LeastNorm } else { choose(framework, &mut state, basis, tolerance) };
        if forces == Forces::LeastNorm {
            left = framework.left(&directions, &state.axial);
        }
        let mut evidence = Evidence::new(
            "balance of joints in units of their loads, and lengths in units of the length",
            size,
            tolerance,
            factorisations,
        );
        evidence.solve_s = solve_s;
        evidence.nullity =
            second_order.neutral + second_order.self_stresses.as_ref().map_or(0, Vec::len);
        evidence.rigidity = rigidity(framework, &second_order);
        let slack = (0..framework.members()).filter(|&k| !state.taut[k]).collect();
        let rigid = |k: &usize| {
            let link = &framework.links[*k];
            link.compliance <= 0.0 && framework.moves(link)
        };
        let limp: Vec<usize> = limp(framework, &state, &directions).filter(rigid).collect();
        evidence.self_stresses =
            basis.filter(|basis| !basis.is_empty()).map(|basis| SelfStresses {
                dimension: basis.len(),
                basis: of_members(framework, basis.to_vec()),
                choice: match forces {
                    Forces::LeastNorm => ForceChoice::EquallyStiff,
                    Forces::Unique | Forces::Found | Forces::Uncounted => ForceChoice::Unknown,
                },
                misfit_m: Some(largest_misfit(framework, basis, &directions)),
                ranges: ranges(framework, &state, basis),
            });
        Self {
            residual: size,
            equilibrium: Answer { system, framework, state, directions, left }
                .equilibrium(stability(&second_order), evidence),
            factorisations,
            mechanisms: second_order.mechanisms,
            self_stresses: second_order.self_stresses.map(|basis| of_members(framework, basis)),
            rank_gap: second_order.rank_gap,
            forces,
            slack,
            limp,
        }
    }
}

/// Members that have just their length and bear no force.
pub(super) fn limp<'a>(
    framework: &'a Framework,
    state: &'a State,
    directions: &'a [(Vector3<f64>, f64)],
) -> impl Iterator<Item = usize> + 'a {
    let none = NO_FORCE * state.largest_force(framework);
    (0..framework.members()).filter(move |&k| {
        let length = framework.links[k].length;
        let off = framework.whole(k, |span| directions[span].1) - length;
        state.axial[k].abs() <= none && off.abs() <= NO_FORCE * length
    })
}

/// Self-stresses without what stands behind the members.
fn of_members(framework: &Framework, mut basis: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for stress in &mut basis {
        stress.truncate(framework.members());
    }
    basis
}

/// Largest misfit of a member that takes part in a self-stress, m.
fn largest_misfit(
    framework: &Framework,
    basis: &[Vec<f64>],
    directions: &[(Vector3<f64>, f64)],
) -> f64 {
    let links = framework.links.iter().enumerate();
    let misfits = links
        .filter(|(k, _)| basis.iter().any(|stress| stress[*k].abs() > ZERO))
        .map(|(k, link)| (framework.whole(k, |span| directions[span].1) - link.length).abs());
    misfits.fold(0.0, f64::max) * framework.units.length_m
}

/// The counts, where there are any.
fn rigidity(framework: &Framework, second_order: &SecondOrder) -> Option<Rigidity> {
    let (mechanisms, gap) = (second_order.mechanisms?, second_order.rank_gap?);
    let self_stresses = second_order.self_stresses.as_ref()?.len();
    let rank = framework.freedoms().saturating_sub(mechanisms);
    Some(Rigidity { rank, mechanisms, self_stresses, gap })
}

/// The member of the family of forces that is shown: least $\sum N^2 l$.
fn choose(
    framework: &Framework,
    state: &mut State,
    basis: Option<&[Vec<f64>]>,
    tolerance: f64,
) -> Forces {
    let Some(basis) = basis else { return Forces::Uncounted };
    if basis.is_empty() {
        return Forces::Unique;
    }
    // A Gram-Schmidt basis in the norm of the lengths, and the forces without their part in it.
    let product = |a: &[f64], b: &[f64]| -> f64 {
        let members = framework.links[..framework.members()].iter();
        members.zip(a.iter().zip(b)).map(|(link, (a, b))| a * b * link.length).sum()
    };
    let mut orthonormal: Vec<Vec<f64>> = Vec::new();
    let mut least = state.axial.clone();
    let without = |from: &mut Vec<f64>, unit: &[f64]| {
        let part = product(from, unit);
        from.iter_mut().zip(unit).for_each(|(f, u)| *f -= part * u);
    };
    for stress in basis {
        let mut stress = stress.clone();
        // Twice is enough.
        for _ in 0..2 {
            for unit in &orthonormal {
                without(&mut stress, unit);
            }
        }
        let norm = product(&stress, &stress).sqrt();
        for force in &mut stress {
            *force /= norm;
        }
        without(&mut least, &stress);
        orthonormal.push(stress);
    }
    let found = state.axial.clone();
    let Some(least) = admissible(framework, state, &least, &orthonormal) else {
        return Forces::Found;
    };
    state.axial = least;
    let is_balanced = |state: &State| Residual::new(framework, state).balance.0 <= tolerance;
    if is_balanced(state) || balance(framework, state) && is_balanced(state) {
        return Forces::LeastNorm;
    }
    state.axial = found;
    Forces::Found
}

/// What the sum of many self-stresses leaves out of balance, borne by the members that bear a force; whether it can be.
fn balance(framework: &Framework, state: &mut State) -> bool {
    let taut = state.axial.iter().map(|force| *force != 0.0).collect();
    let bearing = State { taut, ..state.clone() };
    let left = framework.left(&state.directions(framework), &state.axial);
    let Ok(mut decided) = Decided::new(framework, &bearing, SHARP) else { return false };
    let more = decided.bearing(framework, &left);
    state.axial.iter_mut().zip(more).for_each(|(force, more)| *force += more);
    true
}

/// The least forces with the right signs of taut members and of the pushes of the floor; `None`
/// where no forces in balance have them.
fn admissible(
    framework: &Framework,
    state: &State,
    least: &[f64],
    basis: &[Vec<f64>],
) -> Option<Vec<f64>> {
    let directions = state.directions(framework);
    // Each with the sign that makes it positive; slack members bear nothing, and have no part in the basis.
    let signed = framework.links.iter().enumerate().filter_map(|(k, link)| match link.kind {
        Kind::Cable => Some((k, 1.0)),
        Kind::Strut => Some((k, -1.0)),
        Kind::Bar => None,
    });
    let signed: Vec<(usize, f64)> = signed.collect();
    let rows = |axial: &[f64], pushes: Vec<f64>| -> Vec<f64> {
        signed.iter().map(|(k, sign)| sign * axial[*k]).chain(pushes).collect()
    };
    let now = DVector::from_vec(rows(least, framework.pushes(&directions, least)));
    let no_force = NO_FORCE * state.largest_force(framework);
    if now.iter().all(|force| *force >= -no_force) {
        return Some(least.to_vec());
    }
    let columns: Vec<DVector<f64>> = basis
        .iter()
        .map(|stress| {
            DVector::from_vec(rows(stress, framework.pushes_of_stress(&directions, stress)))
        })
        .collect();
    let part = shortest(&DMatrix::from_columns(&columns), &-now)?;
    let mut forces = least.to_vec();
    for (stress, part) in basis.iter().zip(part.iter()) {
        forces.iter_mut().zip(stress).for_each(|(force, stress)| *force += part * stress);
    }
    for (k, sign) in signed {
        // At its limit to rounding.
        if sign * forces[k] < no_force {
            forces[k] = 0.0;
        }
    }
    Some(forces)
}

/// What the observables follow from.
pub(super) struct Answer<'a> {
    pub system: &'a System,
    pub framework: &'a Framework,
    pub state: State,
    /// Directions of the members, and their lengths.
    pub directions: Vec<(Vector3<f64>, f64)>,
    /// Sum of the pulls of the members and of the load at each joint.
    pub left: Vec<Vector3<f64>>,
}

impl Answer<'_> {
    pub fn equilibrium(self, stability: SystemStability, evidence: Evidence) -> SystemEquilibrium {
        let Self { system, framework, mut state, directions, left } = self;
        let units = framework.units;
        // Units of another system of the same joints have another origin.
        let from = units.place(system.reference_m());
        let energy_j = state.energy(framework, &from) * units.force_n * units.length_m;
        let members = system.members();
        let (mut start_forces_n, mut end_forces_n) =
            (Vec::with_capacity(members.len()), Vec::with_capacity(members.len()));
        state.axial.truncate(members.len());
        for (k, (member, axial)) in members.iter().zip(&mut state.axial).enumerate() {
            *axial *= units.force_n;
            let last = framework.rope(&framework.links[k]).and_then(|rope| rope.spans.last());
            let [pull_n, last_n] = [k, *last.unwrap_or(&k)].map(|span| directions[span].0 * *axial);
            let [start_n, end_n] = end_loads_n(system, member);
            start_forces_n.push((-pull_n - start_n).into());
            end_forces_n.push((last_n - end_n).into());
        }
        // What is held is where it is held, to the bit.
        let held = |joint: &Joint| joint.support.at_m().filter(|_| joint.support.is_fixed());
        let places = state.places.iter().zip(system.joints());
        let reactions = framework.nodes.iter().zip(&left);
        // The ground takes what the free directions leave.
        let reactions = reactions.map(|(node, left)| node.free.part(left) - left);
        SystemEquilibrium {
            solver: SolverName::LAGRANGE,
            energy_j,
            joints_m: places
                .map(|(place, joint)| {
                    held(joint).unwrap_or_else(|| (place * units.length_m + units.origin_m).into())
                })
                .collect(),
            start_forces_n,
            end_forces_n,
            axial_n: state.axial,
            reactions_n: reactions.map(|reaction| (reaction * units.force_n).into()).collect(),
            stability,
            evidence,
        }
    }
}

fn stability(second_order: &SecondOrder) -> SystemStability {
    SystemStability {
        in_space: if second_order.index == 0 { InSpace::Stable } else { InSpace::Unstable },
        index_in_space: second_order.index,
        index_in_plane: second_order.index_in_plane,
        neutral: second_order.neutral,
    }
}

#[cfg(test)]
mod tests;
