//! What is broken in an answer, member by member and joint by joint.

use model::system::{Kind, Member, Support, System, SystemEquilibrium};
use model::{Jam, Place, Vector};
use serde::Serialize;

use super::best_forces::{BestForces, law_n, limits_n};
use super::bounds::Bounds;
use super::given::ForeignAnswer;
use crate::systems::spans;
use numerics::vector::{minus, norm, plus, times};

/// A law that an answer breaks by more than its tolerance explains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Violation {
    /// The member, counted from 1, or the joint, counted from 0.
    pub place: Place,
    /// Which law, with the numbers.
    #[serde(flatten)]
    pub law: Law,
    /// By how much, in m or N as the law says.
    pub value: f64,
    /// How much the tolerance explains, in the same unit.
    pub allowed: f64,
}

/// The laws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "law", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Law {
    /// A supported joint lies on its support; by how many m it does not.
    Support,
    /// No joint is below the floor; by how many m it is.
    BelowFloor,
    /// The floor does not pull a joint down; N.
    FloorPulls {
        /// What balances the joint, down positive, N.
        force_n: f64,
    },
    /// An inextensible member keeps its length; m.
    Length {
        /// The length, m.
        length_m: f64,
        /// The distance of its joints, m.
        distance_m: f64,
    },
    /// An elastic member has the force of its elongation; N.
    Elongation {
        /// The force, N.
        force_n: f64,
        /// That of its elongation, N.
        elastic_n: f64,
    },
    /// A cable does not push and a strut does not pull; N.
    Sign {
        /// The force, N.
        force_n: f64,
    },
    /// A cable shorter than its length, and a strut longer than it, carries nothing; N.
    Slack {
        /// The force, N.
        force_n: f64,
        /// The length, m.
        length_m: f64,
        /// The distance of its joints, m.
        distance_m: f64,
    },
    /// A rope pulls with one tension on both sides of a ring or pulley, which is the joint; N.
    Tension {
        /// The rope among the members, from 1.
        member: usize,
        /// The forces of its spans before and behind the joint, N.
        sides_n: [f64; 2],
    },
    /// The forces on a joint balance along the motions that its support leaves free; N.
    Balance {
        /// What is left over, N.
        left_n: Vector,
    },
    /// The force of the ground that is given balances the members and loads of its joint; N.
    Reaction {
        /// As given, N.
        given_n: Vector,
        /// What members and loads ask for, N.
        wanted_n: Vector,
    },
    /// The forces of the ground that are given carry the loads of the whole system; N.
    Whole {
        /// What is left over, N.
        left_n: Vector,
    },
}

impl Law {
    /// The unit of [`Violation::value`].
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Support | Self::BelowFloor | Self::Length { .. } => "m",
            _ => "N",
        }
    }
}

/// What was measured: the violations, and the largest measure of all in units of what is allowed.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Measured {
    pub(super) violations: Vec<Violation>,
    pub(super) largest: f64,
    /// Whether it is open if forces exist that balance: those found do not, and the proof that none
    /// do falls short.
    pub(super) open: bool,
}

impl Measured {
    pub(super) fn note(&mut self, place: Place, law: Law, value: f64, allowed: f64) {
        let ratio = if value > 0.0 { value / allowed } else { 0.0 };
        self.largest = self.largest.max(ratio);
        if value > allowed {
            self.violations.push(Violation { place, law, value, allowed });
        }
    }

    /// The one with the largest measure.
    pub(super) fn worst(&self) -> Option<&Violation> {
        let ratio = |violation: &Violation| violation.value / violation.allowed;
        self.violations.iter().max_by(|a, b| ratio(a).total_cmp(&ratio(b)))
    }
}

/// An answer that is held against the laws of a system.
#[derive(Clone, Copy)]
pub(super) struct Held<'a> {
    pub(super) system: &'a System,
    pub(super) answer: &'a SystemEquilibrium,
    pub(super) bounds: &'a Bounds,
}

impl Held<'_> {
    /// Supports, lengths and members' laws.
    pub(super) fn geometry_and_laws(&self, given: bool) -> Measured {
        let Self { system, answer, bounds } = *self;
        let mut found = Measured::default();
        for (k, joint) in system.joints().iter().enumerate() {
            if let Some(off_m) = off_support_m(&joint.support, answer.joints_m[k]) {
                found.note(Place::Joint(k), Law::Support, off_m, bounds.position_m);
            }
        }
        for (k, member) in system.members().iter().enumerate() {
            let distance_m = spans::length_m(member, &answer.joints_m);
            let force_n = given.then(|| answer.axial_n[k]);
            law(member, distance_m, force_n, bounds, Place::Member(k + 1), &mut found);
        }
        found
    }

    /// The tension of each rope whose spans have forces of their own: on both sides of a joint each may be off.
    pub(super) fn tensions(&self, answer: &ForeignAnswer, found: &mut Measured) {
        let Self { system, bounds, .. } = *self;
        for (k, spans_n) in &answer.spans_n {
            for (joint, sides_n) in system.members()[*k].via().iter().zip(spans_n.windows(2)) {
                let [before_n, after_n] = [sides_n[0], sides_n[1]];
                let law = Law::Tension { member: k + 1, sides_n: [before_n, after_n] };
                let off_n = (before_n - after_n).abs();
                found.note(Place::Joint(*joint), law, off_n, 2.0 * bounds.force_n);
            }
        }
    }

    /// What is left over at every joint along its free motions, and what the bounds explain there when
    /// no force is larger than the answer's, or than `at_most_n` if that is given. A span whose joints have
    /// run together bears anything up to its tension, or where forces are found what was found.
    pub(super) fn balances(&self, at_most_n: Option<f64>) -> Vec<(Vector, f64)> {
        let Self { system, answer, bounds } = *self;
        let mut left: Vec<(Vector, f64)> =
            system.joint_loads_n().into_iter().map(|load| (load, bounds.force_n)).collect();
        let joints_m = &answer.joints_m;
        for (member, force) in system.members().iter().zip(&answer.axial_n) {
            for [a, b] in member.spans() {
                let distance_m = norm(minus(joints_m[b], joints_m[a]));
                let (pull, open_n) = if bounds.meet(member, [a, b], joints_m) {
                    ([0.0; 3], at_most_n.map_or(force.abs(), |_| 0.0))
                } else {
                    let pull = times(*force, spans::unit([a, b], joints_m));
                    let [a_n, b_n] = limits_n(member, joints_m, bounds).map(f64::abs);
                    let most_n = at_most_n.map_or(force.abs(), |n| n.min(a_n.max(b_n)));
                    (pull, most_n * bounds.turn(distance_m))
                };
                let explained = bounds.force_n + open_n;
                left[a] = (plus(left[a].0, pull), left[a].1 + explained);
                left[b] = (minus(left[b].0, pull), left[b].1 + explained);
            }
        }
        left
    }

    /// Joints that have run together on a rope: the span between them bears what one of them is out of balance by, up to its
    /// tension, but nothing of what all of them together are. The first joint of each such group, what is left
    /// over along the motions that all of their supports leave free, and what the bounds explain.
    fn balances_of_groups(&self) -> Vec<(usize, Vector, f64)> {
        let Self { system, answer, bounds } = *self;
        let at_m = &answer.joints_m;
        let spans = system
            .members()
            .iter()
            .flat_map(|member| member.spans().map(move |span| (member, span)));
        let tied: Vec<[usize; 2]> = spans
            .filter(|(member, span)| bounds.meet(member, *span, at_m))
            .map(|(_, span)| span)
            .collect();
        if tied.is_empty() {
            return Vec::new();
        }
        let mut group: Vec<usize> = (0..at_m.len()).collect();
        for [a, b] in tied {
            let (into, from) = (group[a], group[b]);
            group.iter_mut().filter(|of| **of == from).for_each(|of| *of = into);
        }
        let mut left: Vec<(Vector, f64)> = vec![([0.0; 3], 0.0); at_m.len()];
        for (load, of) in system.joint_loads_n().into_iter().zip(&group) {
            left[*of] = (plus(left[*of].0, load), left[*of].1 + bounds.force_n);
        }
        for (member, force) in system.members().iter().zip(&answer.axial_n) {
            for [a, b] in member.spans().filter(|[a, b]| group[*a] != group[*b]) {
                let distance_m = norm(minus(at_m[b], at_m[a]));
                let pull = times(*force, spans::unit([a, b], at_m));
                let explained = bounds.force_n + force.abs() * bounds.turn(distance_m);
                for (of, pull) in [(group[a], pull), (group[b], times(-1.0, pull))] {
                    left[of] = (plus(left[of].0, pull), left[of].1 + explained);
                }
            }
        }
        let mut joints: Vec<Vec<usize>> = vec![Vec::new(); at_m.len()];
        for (joint, of) in group.into_iter().enumerate() {
            joints[of].push(joint);
        }
        let groups = joints.into_iter().zip(left).filter(|(all, _)| all.len() > 1);
        let of_group = |(all, (left_n, allowed)): (Vec<usize>, (Vector, f64))| {
            // Which motions are left is a matter of directions: the places differ by what the bounds explain.
            let support = |joint: &usize| {
                let mut support = system.joints()[*joint].support;
                support.at_m_mut().into_iter().for_each(|at_m| *at_m = [0.0; 3]);
                support
            };
            let both = |a: Support, b: Support| a.meeting(&b).unwrap_or(a);
            let left_n = all.iter().map(support).fold(Support::Free, both).free_part(left_n);
            (all[0], left_n, allowed)
        };
        groups.map(of_group).collect()
    }

    /// The balance of joints whose forces are given.
    pub(super) fn balance_given(&self, reactions_n: Option<&[Vector]>, found: &mut Measured) {
        let Self { system, .. } = *self;
        for (k, (left, allowed)) in self.balances(None).into_iter().enumerate() {
            let support = &system.joints()[k].support;
            let left_n = support.free_part(left);
            if !support.is_fixed() {
                found.note(Place::Joint(k), Law::Balance { left_n }, norm(left_n), allowed);
            }
            if let Some(given) = reactions_n {
                let (given_n, wanted_n) = (given[k], times(-1.0, minus(left, left_n)));
                let off = norm(minus(given_n, wanted_n));
                found.note(Place::Joint(k), Law::Reaction { given_n, wanted_n }, off, allowed);
            }
        }
        for (first, left_n, allowed) in self.balances_of_groups() {
            found.note(Place::Joint(first), Law::Balance { left_n }, norm(left_n), allowed);
        }
    }

    /// The balance of joints whose forces were found: all of them together, since no other forces leave
    /// less than [`BestForces::least_n`].
    ///
    /// A violation where forces up to [`BestForces::up_to_n`] cannot explain that; the joints are those
    /// where most is left over. Open too where a span without length would bear more than its tension.
    pub(super) fn balance_found(&self, best: &BestForces, found: &mut Measured) {
        let Self { system, .. } = *self;
        let balances = self.balances(Some(best.up_to_n));
        let movable = || {
            let joints = system.joints().iter().zip(&balances).enumerate();
            joints.filter(|(_, (joint, _))| !joint.support.is_fixed())
        };
        let explained_n =
            model::sum(movable().map(|(_, (_, (_, allowed)))| allowed * allowed)).sqrt();
        if best.least_n > 0.0 {
            found.largest = found.largest.max(best.least_n / explained_n);
        }
        if best.least_n <= explained_n {
            let torn = |jam: &Jam| norm(jam.pull_n) > best.axial_n[jam.member].abs() + explained_n;
            found.open = best.residual_n > explained_n || best.jams.iter().any(torn);
            return;
        }
        // At least one joint is above its share, or they would not be together.
        for (k, (_, (_, allowed))) in movable() {
            let left_n = best.left_n[k];
            found.note(Place::Joint(k), Law::Balance { left_n }, norm(left_n), *allowed);
        }
    }

    /// Given forces of the ground against all loads. No position enters, so every digit counts.
    pub(super) fn whole(&self, reactions_n: &[Vector], found: &mut Measured) {
        let Self { system, bounds, .. } = *self;
        let loads = system.joint_loads_n();
        let all = || loads.iter().chain(reactions_n);
        let left_n: Vector = std::array::from_fn(|c| model::sum(all().map(|force| force[c])));
        let supported = system.joints().iter().filter(|joint| joint.support.at_m().is_some());
        let allowed = bounds.force_n * supported.count().max(1) as f64;
        found.note(Place::Whole, Law::Whole { left_n }, norm(left_n), allowed);
    }
}

/// How far a joint is from its support; nothing for a free one.
fn off_support_m(support: &Support, at: Vector) -> Option<f64> {
    support.at_m().map(|_| norm(minus(at, support.nearest_m(at))))
}

/// The law of one member. Forces that were found obey the laws of force by construction.
fn law(
    member: &Member,
    distance_m: f64,
    force_n: Option<f64>,
    bounds: &Bounds,
    place: Place,
    found: &mut Measured,
) {
    let length_m = member.body.length_m();
    let reach_m = bounds.distance_m(member);
    if let Some(stiffness_n) = member.stiffness_n {
        let Some(force_n) = force_n else { return };
        let elastic_n = law_n(member.kind, stiffness_n, length_m, distance_m);
        let allowed = bounds.force_n + stiffness_n / length_m * reach_m;
        let off = (force_n - elastic_n).abs();
        found.note(place, Law::Elongation { force_n, elastic_n }, off, allowed);
        return;
    }
    let longer_m = distance_m - length_m;
    let (off_m, wrong_n, slack_m) = match member.kind {
        Kind::Bar => (longer_m.abs(), 0.0, 0.0),
        Kind::Cable => (longer_m, force_n.map_or(0.0, |force| -force), -longer_m),
        Kind::Strut => (-longer_m, force_n.unwrap_or_default(), longer_m),
    };
    found.note(place, Law::Length { length_m, distance_m }, off_m, reach_m);
    let Some(force_n) = force_n else { return };
    found.note(place, Law::Sign { force_n }, wrong_n, bounds.force_n);
    if slack_m > reach_m && wrong_n <= bounds.force_n {
        let law = Law::Slack { force_n, length_m, distance_m };
        found.note(place, law, force_n.abs(), bounds.force_n);
    }
}

#[cfg(test)]
mod tests;
