//! Systems that are one row of rigid bars between two anchors: chains, however their file is written.

use std::sync::OnceLock;

use super::{Kind, Support, System, SystemEquilibrium, SystemStability};
use crate::{Anchors, Bar, Chain, Equilibrium, InPlane, Problem, Reactions, Stability, Vector};

/// A system that is a row of rigid bars between two anchors under upright loads, as a chain.
///
/// A weight at a joint is carried by the bar before it: a bar of mass $m$ and length $l$ with its
/// centre at $r$ and a mass $M$ at its end is one rigid body of mass $m + M$ with its centre at
/// $(m r + M l)/(m + M)$. Places, axial forces and reactions are those of the system; the force that the
/// bar passes on at that joint is less by the weight. The judge holds the answer against the
/// system itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    problem: Problem,
    /// The joint of the system for each joint of the chain.
    joints: Vec<u32>,
    /// The member for each bar.
    members: Vec<Link>,
    /// Weight at each joint of the chain, N; empty where there is none.
    weights_n: Vec<f64>,
}

impl From<&Problem> for Row {
    /// A chain as the row of the system that it is: joint k is joint k, bar k member k.
    fn from(problem: &Problem) -> Self {
        let bars = problem.chain().bars().len();
        Self {
            problem: problem.clone(),
            joints: (0..).take(bars + 1).collect(),
            members: (0..).map(|bar| Link::new(bar, false)).take(bars).collect(),
            weights_n: vec![],
        }
    }
}

/// The row of a system that does not change, made when it is first asked for.
#[derive(Debug, Default)]
pub(super) struct Once(OnceLock<Option<Box<Row>>>);

impl Once {
    /// Of a row that is known.
    pub(super) fn known(row: Row) -> Self {
        Self(OnceLock::from(Some(Box::new(row))))
    }
}

impl Clone for Once {
    /// Of the clone it is made again, if anyone asks.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Once {
    /// It follows from all else.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A member of a row, and whether it runs the other way: twice its number, and one more.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Link(u32);

impl Link {
    fn new(member: u32, turned: bool) -> Self {
        Self(2 * member + u32::from(turned))
    }

    fn member(self) -> usize {
        (self.0 / 2) as usize
    }

    fn is_turned(self) -> bool {
        self.0 % 2 == 1
    }
}

/// Joints in their order, and members in theirs.
type Walk = (Vec<u32>, Vec<Link>);

impl System {
    /// The system as a chain, where it is one: rigid bars of exact length in a row between two anchors, nothing on
    /// the bars but their weight, and no load at the joints that is not straight down.
    ///
    /// ```
    /// use model::system::System;
    /// let chain = model::cases::paper();
    /// let system = System::from(chain.chain());
    /// let row = system.as_row().expect("a row");
    /// assert_eq!(row.problem().chain().bars(), chain.chain().bars());
    /// ```
    pub fn as_row(&self) -> Option<&Row> {
        self.row.0.get_or_init(|| self.made_row().map(Box::new)).as_deref()
    }

    fn made_row(&self) -> Option<Row> {
        if !self.may_be_row() {
            return None;
        }
        let (joints, members) = self.walk()?;
        let (&first, &last) = (joints.first()?, joints.last()?);
        let mut weights_n = Vec::with_capacity(joints.len());
        for joint in &joints {
            weights_n.push(self.upright_n(*joint as usize)?);
        }
        let mut bars = Vec::with_capacity(members.len());
        for (member, weight_n) in members.iter().zip(&weights_n[1..]) {
            bars.push(self.loaded(*member, *weight_n)?);
        }
        if weights_n.iter().all(|weight| *weight <= 0.0) {
            weights_n = vec![];
        }
        let anchor = |joint: u32| match self.joints()[joint as usize].support {
            Support::Fixed { at_m } => Some(at_m),
            _ => None,
        };
        let anchors = Anchors { start_m: anchor(first)?, end_m: anchor(last)? };
        let chain = Chain::new(self.name(), self.gravity_m_s2(), anchors, bars).ok()?;
        Some(Row { problem: Problem::new(chain).ok()?, joints, members, weights_n })
    }

    /// Whether it is one, without making it.
    pub(crate) fn is_row(&self) -> bool {
        let upright = || (0..self.joints().len()).all(|joint| self.upright_n(joint).is_some());
        self.may_be_row() && upright() && self.walk().is_some()
    }

    /// Whether its members and their number are those of a row.
    fn may_be_row(&self) -> bool {
        let members = self.members();
        let rigid = |k: usize| {
            let member = &members[k];
            member.kind == Kind::Bar
                && member.stiffness_n.is_none()
                && member.length_tolerance_m().is_none()
                && member.loads.is_empty()
        };
        self.floor_m().is_none()
            && self.joints().len() == members.len() + 1
            && (0..members.len()).all(rigid)
    }

    /// Joints and members in their order from the anchor of the smaller number, if they are one row.
    fn walk(&self) -> Option<Walk> {
        let mut at = vec![[u32::MAX; 2]; self.joints().len()];
        for (k, member) in (0..u32::MAX / 2).zip(self.members()) {
            for joint in [member.from, member.to] {
                let free = at[joint].iter().position(|slot| *slot == u32::MAX)?;
                at[joint][free] = k;
            }
        }
        let ends = |joint: &u32| {
            let [one, other] = at[*joint as usize];
            one != u32::MAX && other == u32::MAX
        };
        let mut here = (0..u32::try_from(at.len()).ok()?).find(ends)?;
        let (mut joints, mut members) =
            (Vec::with_capacity(at.len()), Vec::with_capacity(self.members().len()));
        joints.push(here);
        let mut before = u32::MAX;
        let on = |here: u32, before: u32| {
            at[here as usize].into_iter().find(|k| *k != u32::MAX && *k != before)
        };
        while let Some(next) = on(here, before) {
            let member = &self.members()[next as usize];
            let turned = member.to == here as usize;
            here = u32::try_from(if turned { member.from } else { member.to }).ok()?;
            joints.push(here);
            members.push(Link::new(next, turned));
            before = next;
        }
        let inner = &joints[1..joints.len() - 1];
        let is_free = |joint: &u32| self.joints()[*joint as usize].support == Support::Free;
        let free = inner.iter().all(is_free);
        (joints.len() == at.len() && free).then_some((joints, members))
    }

    /// The load at a joint, N downwards; without value where it is not straight down, or acts on an
    /// anchor.
    fn upright_n(&self, joint: usize) -> Option<f64> {
        let joint = &self.joints()[joint];
        let [x, y, z] = joint.force_n;
        let down = joint.mass_kg * self.gravity_m_s2() - z;
        let upright = x.abs() <= 0.0 && y.abs() <= 0.0 && down >= 0.0;
        (upright && (down <= 0.0 || !joint.support.is_fixed())).then_some(down)
    }

    /// The body of a member with a weight at its second joint along the row.
    fn loaded(&self, link: Link, weight_n: f64) -> Option<Bar> {
        let (body, turned) = (self.members()[link.member()].body, link.is_turned());
        if weight_n <= 0.0 && !turned {
            return Some(body);
        }
        let (length_m, mass_kg) = (body.length_m(), body.mass_kg());
        let centre_m = if turned { length_m - body.centre_m() } else { body.centre_m() };
        let added_kg = weight_n / self.gravity_m_s2();
        let total_kg = mass_kg + added_kg;
        let centre_m = if added_kg > 0.0 {
            ((mass_kg * centre_m + added_kg * length_m) / total_kg).min(length_m)
        } else {
            centre_m
        };
        Bar::new(length_m, total_kg, centre_m, body.inertia_kg_m2()).ok()
    }
}

impl Row {
    /// The chain. Moments of inertia are those of the bars alone: no equilibrium depends on them.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The joints of the system in the order of the chain.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = usize> + Clone + '_ {
        self.joints.iter().map(|joint| *joint as usize)
    }

    /// The members of the system in the order of the chain, and whether each runs the other way.
    fn members(&self) -> impl Iterator<Item = (usize, bool)> + '_ {
        self.members.iter().map(|link| (link.member(), link.is_turned()))
    }

    /// Weight at a joint of the chain, N.
    fn weight_n(&self, joint: usize) -> f64 {
        self.weights_n.get(joint).copied().unwrap_or(0.0)
    }

    /// The joints of the system that are the two anchors.
    fn anchors(&self) -> [usize; 2] {
        [self.joints[0], self.joints[self.members.len()]].map(|joint| joint as usize)
    }

    /// The axial forces of an answer in the order of the chain, N; without value where it is not one of this system.
    pub fn chain_axial_n(&self, found: &SystemEquilibrium) -> Option<Vec<f64>> {
        self.fits(found).then(|| self.members().map(|(member, _)| found.axial_n[member]).collect())
    }

    fn fits(&self, found: &SystemEquilibrium) -> bool {
        let bars = self.members.len();
        [found.joints_m.len(), found.reactions_n.len()] == [bars + 1; 2]
            && [found.axial_n.len(), found.start_forces_n.len(), found.end_forces_n.len()]
                == [bars; 3]
    }

    /// An answer for the system as one for the chain, for proofs that know chains; without value where it is not
    /// one of this system. The character in the plane follows from the index alone.
    pub fn chain_equilibrium(&self, found: &SystemEquilibrium) -> Option<Equilibrium> {
        let axial_n = self.chain_axial_n(found)?;
        let [first, last] = self.anchors();
        let index = found.stability.index_in_plane.unwrap_or_default();
        Some(Equilibrium {
            solver: found.solver.clone(),
            energy_j: found.energy_j,
            joints_m: self.joints().map(|joint| found.joints_m[joint]).collect(),
            multipliers_n: self.multipliers_n(found)?,
            reactions_n: Reactions {
                start: found.reactions_n[first],
                end: found.reactions_n[last],
            },
            axial_n,
            stability: Stability {
                in_plane: if index == 0 { InPlane::Minimum } else { InPlane::Saddle },
                index_in_plane: index,
                in_space: found.stability.in_space,
                index_in_space: found.stability.index_in_space,
            },
            evidence: found.evidence.clone(),
        })
    }

    /// The paper's multipliers of an answer for the system, N: first the force of the ground on the first
    /// bar, then at each joint the force of the next bar, or of the ground, on the one before; without value where
    /// it is not one of this system.
    pub fn multipliers_n(&self, found: &SystemEquilibrium) -> Option<Vec<Vector>> {
        if !self.fits(found) {
            return None;
        }
        let passed_on = self.members().zip(1..).map(|((member, turned), joint)| {
            let forces = if turned { &found.start_forces_n } else { &found.end_forces_n };
            let [x, y, z] = forces[member];
            [x, y, z + self.weight_n(joint)]
        });
        let first = found.reactions_n[self.anchors()[0]];
        Some(std::iter::once(first).chain(passed_on).collect())
    }

    /// An answer for the chain as one for the system.
    pub fn equilibrium(&self, mut found: Equilibrium) -> SystemEquilibrium {
        // One array after the other: of a long row each is large, and what it is made of is let go.
        let bars = self.members.len();
        let in_chain = std::mem::take(&mut found.joints_m);
        let mut joints_m = vec![[0.0; 3]; bars + 1];
        for (joint, at_m) in self.joints().zip(&in_chain) {
            joints_m[joint] = *at_m;
        }
        drop(in_chain);
        let in_chain = std::mem::take(&mut found.axial_n);
        let mut axial_n = vec![0.0; bars];
        for ((member, _), force_n) in self.members().zip(&in_chain) {
            axial_n[member] = *force_n;
        }
        drop(in_chain);
        let forces_n = std::mem::take(&mut found.multipliers_n);
        let mut start_forces_n = vec![[0.0; 3]; bars];
        let mut end_forces_n = vec![[0.0; 3]; bars];
        for (k, (member, turned)) in self.members().enumerate() {
            // Entry 0 is the force on bar 1, every other one that on the bar before.
            let first = if k == 0 { forces_n[0] } else { forces_n[k].map(|x| -x) };
            let [x, y, z] = forces_n[k + 1];
            let second: Vector = [x, y, z - self.weight_n(k + 1)];
            let [start, end] = if turned { [second, first] } else { [first, second] };
            (start_forces_n[member], end_forces_n[member]) = (start, end);
        }
        drop(forces_n);
        let mut reactions_n = vec![[0.0; 3]; bars + 1];
        let [first, last] = self.anchors();
        reactions_n[first] = found.reactions_n.start;
        reactions_n[last] = found.reactions_n.end;
        let flat = found.stability.in_plane == InPlane::Degenerate;
        let turns = self.problem.chain().anchors_on_one_vertical();
        SystemEquilibrium {
            solver: found.solver,
            energy_j: found.energy_j,
            joints_m,
            start_forces_n,
            end_forces_n,
            axial_n,
            reactions_n,
            stability: SystemStability {
                in_space: found.stability.in_space,
                index_in_space: found.stability.index_in_space,
                index_in_plane: Some(found.stability.index_in_plane),
                neutral: usize::from(flat) + usize::from(turns),
            },
            evidence: found.evidence,
        }
    }
}
