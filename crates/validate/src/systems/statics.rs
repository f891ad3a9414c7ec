//! Newton's laws for every member and joint of a system, and the law of every member.
//!
//! It knows nothing of how an answer was found. A member is two points, the forces on it at both,
//! and the loads between them, which act at fixed parts `a/l` of its length:
//!
//! $$ S + E + \sum P = 0, \qquad
//!    d \times E + \sum \frac{a}{l}\\, d \times P = 0, \qquad d = x_b - x_a . $$
//!
//! A joint feels the opposites of these end forces, its own load and the force of its support. The
//! axial force is that of the member with its loads lumped to its joints by the lever rule,
//! $N = (E + \sum \frac{a}{l} P) \cdot d/|d|$, and must obey the member's law
//! ([`Kind`](model::system::Kind)): its length where it is inextensible, its sign, none where it is
//! slack.

mod units;

use std::collections::BTreeMap;

use model::system::{Joint, Kind, Member, Row, System, SystemEquilibrium};
use model::{Equilibrium, Place, Problem, Sum, Vector, sum};
use serde::Serialize;

pub(crate) use self::units::STORED_ULPS;
pub(super) use self::units::rounding_m;
use self::units::{BORNE, Local, Units};
use super::family::Family;
use super::floor::{UP, push_n};
use super::scale::{MOST_FORCE, MOST_ROUNDING, Scale, stored_n};
use super::spans::{self, span_forces};
use numerics::vector::{beyond, cross, dot, minus, norm, plus, times, worse};

/// Largest violations of geometry and of Newton's laws by an answer, dimensionless.
///
/// Every member and joint is measured by its own forces and its own length, by forces to no more than
/// a hundred times what acts there (module `scale`): an absurd force forgives nothing. What counts is
/// beyond the rounding of the stored numbers: eight units in the last place of the largest coordinate
/// or length, and of the forces at that joint, the latter never more than a millionth of what acts
/// there.
///
/// Where lengths overdetermine the shape, what no other shape would remove of a misfit may be as large
/// as [`Member::within_m`].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct SystemStatics {
    /// Largest distance of a supported joint from its support, in units of the size of the system.
    pub support: f64,
    /// Largest violation of the length of an inextensible member, in units of that length.
    pub length: f64,
    /// Largest violation of a member's law of force: elongation times stiffness, the sign, no force
    /// where it is slack.
    pub law: f64,
    /// Largest force left over on a member.
    pub force: f64,
    /// Largest moment left over on a member, in units of its force times its length.
    pub moment: f64,
    /// Largest force left over at a joint; the part of a support's force along the motion that it
    /// leaves free.
    pub joint: f64,
    /// Force left over on the whole system, in units of its loads, or moment about its reference, in
    /// units of that times its size: errors too small to show on any one of a million members add up
    /// here.
    pub balance: f64,
    /// The axial forces and the energy less those that follow from joints and end forces.
    pub derived: f64,
    /// Where the largest of these is.
    pub worst: Place,
}

/// A joint's balance is measured by no less than this times what acts there: one that bears nothing is
/// out of balance by the rounding of the loads elsewhere, which is a part of no force of its own.
const IDLE: f64 = 1e-2;

impl SystemStatics {
    /// The largest violation; NaN if any number of the answer is not finite or missing.
    pub fn largest(&self) -> f64 {
        let Self { support, length, law, force, moment, joint, balance, derived, .. } = *self;
        [support, length, law, force, moment, joint, balance, derived].into_iter().fold(0.0, worse)
    }

    /// Whether every violation is within the tolerance. NaN never is.
    pub fn passes(&self, tolerance: f64) -> bool {
        self.largest() <= tolerance
    }

    /// Keep the larger of two violations, and where it is.
    fn note(&mut self, field: fn(&mut Self) -> &mut f64, value: f64, place: Place) {
        if value <= 0.0 {
            return;
        }
        let most = self.largest();
        let kept = field(self);
        *kept = worse(*kept, value);
        // NaN in `most` keeps its place.
        if value > most || (value.is_nan() && !most.is_nan()) {
            self.worst = place;
        }
    }
}

/// Judge an answer.
///
/// Arrays that do not fit the system, and numbers that are not finite, give NaN, which passes no
/// tolerance.
pub fn judge(system: &System, answer: &SystemEquilibrium) -> SystemStatics {
    let mut found = SystemStatics::default();
    let (joints, members) = (system.joints().len(), system.members().len());
    let fits = [answer.joints_m.len(), answer.reactions_n.len()] == [joints; 2]
        && [answer.start_forces_n.len(), answer.end_forces_n.len(), answer.axial_n.len()]
            == [members; 3];
    if !fits {
        found.note(|s| &mut s.balance, f64::NAN, Place::Whole);
        return found;
    }
    let units = Units::new(system, answer, Scale::new(system, answer));
    let distances_m = distances_m(system, answer, units.rounding_m);
    let mut judging = Judging { system, answer, units, found };
    for (k, (distance_m, over_m)) in distances_m.into_iter().enumerate() {
        judging.member(k, distance_m);
        let length_m = system.members()[k].body.length_m();
        judging.found.note(|s| &mut s.length, over_m / length_m, Place::Member(k + 1));
    }
    for (k, violation) in judging.joint_balances().into_iter().enumerate() {
        judging.found.note(|s| &mut s.joint, violation, Place::Joint(k));
    }
    for k in 0..joints {
        judging.support(k);
    }
    let (balance, derived) = (judging.whole(), judging.energy());
    judging.found.note(|s| &mut s.balance, balance, Place::Whole);
    judging.found.note(|s| &mut s.derived, derived, Place::Whole);
    judging.found
}

/// The same of an answer for a chain, which is judged as the system that it is.
pub fn judge_chain(problem: &Problem, found: &Equilibrium) -> SystemStatics {
    let joints = problem.chain().bars().len() + 1;
    let fits = found.joints_m.len() == joints
        && found.multipliers_n.len() == joints
        && found.axial_n.len() + 1 == joints;
    if !fits {
        return SystemStatics { balance: f64::NAN, ..SystemStatics::default() };
    }
    let answer = Row::from(problem).equilibrium(found.clone());
    judge(&System::from(problem.chain()), &answer)
}

/// The distance of the ends of each member, and by how much too much of a misfit that no other shape
/// would remove: see [`Family::unremovable_m`]. What lengths that overdetermine the shape may be off
/// is left out of the distance.
fn distances_m(system: &System, answer: &SystemEquilibrium, rounding_m: f64) -> Vec<(f64, f64)> {
    let distance = |member: &Member| spans::length_m(member, &answer.joints_m);
    let mut all: Vec<(f64, f64)> =
        system.members().iter().map(|member| (distance(member), 0.0)).collect();
    let off = |(member, (distance_m, _)): (&Member, &(f64, f64))| {
        let off_m = (distance_m - member.body.length_m()).abs();
        member.stiffness_n.is_none() && off_m > rounding_m && off_m <= member.within_m()
    };
    // Most often all lengths are met to rounding.
    if !system.members().iter().zip(&all).any(off) {
        return all;
    }
    let Some(family) = Family::of(system, answer) else { return all };
    let members = system.members().iter().zip(family.unremovable_m(system));
    for ((distance_m, over_m), (member, misfit_m)) in all.iter_mut().zip(members) {
        *distance_m -= misfit_m;
        *over_m = beyond(misfit_m.abs(), member.within_m());
    }
    all
}

/// Weight and forces of a member: where they act as a part of its length, and what they are.
fn loads<'a>(system: &System, member: &'a Member) -> impl Iterator<Item = (f64, Vector)> + 'a {
    let body = member.given_body();
    let length_m = body.length_m();
    let weight = [0.0, 0.0, -body.mass_kg() * system.gravity_m_s2()];
    let forces = member.given_loads().iter().map(move |load| (load.at_m / length_m, load.force_n));
    forces.chain([(body.centre_m() / length_m, weight)])
}

/// An answer while it is judged.
struct Judging<'a> {
    system: &'a System,
    answer: &'a SystemEquilibrium,
    units: Units,
    found: SystemStatics,
}

impl Judging<'_> {
    fn member(&mut self, k: usize, lawful_m: f64) {
        let member = &self.system.members()[k];
        let place = Place::Member(k + 1);
        if member.rope.is_some() {
            return self.rope(k, lawful_m);
        }
        let local = self.units.at(&[member.from, member.to]);
        let along = minus(self.answer.joints_m[member.to], self.answer.joints_m[member.from]);
        let distance_m = norm(along);
        let (start, end) = (self.answer.start_forces_n[k], self.answer.end_forces_n[k]);
        let (mut left, mut carried) = (plus(start, end), end);
        let mut largest_n = worse(worse(0.0, norm(start)), norm(end));
        for (part, load) in loads(self.system, member) {
            left = plus(left, load);
            carried = plus(carried, times(part, load));
            largest_n = worse(largest_n, norm(load));
        }
        self.found.note(|s| &mut s.force, local.part(norm(left), largest_n), place);

        // What the second joint carries: along the member, or it would turn.
        let turn = cross(along, carried);
        let unit_n = local.unit_n(largest_n);
        // A displaced end turns the member: force times displacement. A long row bears what acts on all
        // of it, a nearly taut one more.
        let turned_n = unit_n.max(largest_n.min(MOST_FORCE * self.units.total_n));
        let rounding = local.rounding_n * distance_m + turned_n * self.units.rounding_m;
        let moment = beyond(norm(turn), rounding);
        let moment = if moment <= 0.0 { 0.0 } else { moment / (unit_n * distance_m) };
        self.found.note(|s| &mut s.moment, moment, place);

        let axial_n = self.answer.axial_n[k];
        // Where the ends meet there is no direction, and nothing to compare with.
        if distance_m > self.units.rounding_m {
            let followed = dot(carried, along) / distance_m;
            let off = local.part((axial_n - followed).abs(), largest_n);
            self.found.note(|s| &mut s.derived, off, place);
        }
        self.law(k, lawful_m, unit_n, local);
    }

    /// A rope over rings and pulleys: at each of its ends it pulls with its tension along its span there. Inside,
    /// its spans bear the same tension by the making of [`span_forces`], and the joints feel it.
    fn rope(&mut self, k: usize, lawful_m: f64) {
        let (member, place) = (&self.system.members()[k], Place::Member(k + 1));
        let joints: Vec<usize> = member.path().collect();
        let (axial_n, last) = (self.answer.axial_n[k], joints.len() - 2);
        let pull = |n: usize| spans::pull_n(k, n, [joints[n], joints[n + 1]], self.answer);
        let (start, end) = (self.answer.start_forces_n[k], self.answer.end_forces_n[k]);
        let turned_n = [0, last]
            .map(|n| self.units.turned_n(norm(pull(n)), [joints[n], joints[n + 1]], self.answer));
        let local = self.units.along(&joints, worse(turned_n[0], turned_n[1]));
        let unit_n = local.unit_n(worse(norm(start), norm(end)));
        for (n, sign, force) in [(0, -1.0, start), (last, 1.0, end)] {
            let off = minus(force, times(sign, pull(n)));
            self.found.note(|s| &mut s.force, local.part(norm(off), unit_n), place);
        }
        let jams = self.answer.evidence.jams.iter();
        for jam in jams.filter(|jam| jam.member == k && jam.span <= last) {
            let [a, b] = [joints[jam.span], joints[jam.span + 1]];
            let apart_m = norm(minus(self.answer.joints_m[b], self.answer.joints_m[a]));
            let apart = beyond(apart_m, self.units.rounding_m) / self.units.size_m;
            self.found.note(|s| &mut s.length, apart, place);
            let excess_n = norm(jam.pull_n) - axial_n;
            self.found.note(|s| &mut s.law, local.part(excess_n, unit_n), place);
        }
        self.law(k, lawful_m, unit_n, local);
    }

    /// The law of one member: its length, or its force, or that one of both vanishes.
    fn law(&mut self, k: usize, distance_m: f64, unit_n: f64, local: Local) {
        let (member, place) = (&self.system.members()[k], Place::Member(k + 1));
        let (axial_n, rounding_m) = (self.answer.axial_n[k], self.units.rounding_m);
        let length_m = member.body.length_m();
        let longer = beyond(distance_m - length_m, rounding_m) / length_m;
        let shorter = beyond(length_m - distance_m, rounding_m) / length_m;
        let of_force = |violation: f64, rounding: f64| {
            let excess = beyond(violation, local.rounding_n + rounding);
            if excess <= 0.0 { 0.0 } else { excess / unit_n.max(excess) }
        };
        // A force that should vanish has no size of its own: what acts at the ends has.
        let vanishing = |axial_n: f64| {
            let excess = beyond(axial_n, local.rounding_n);
            if excess <= 0.0 { 0.0 } else { excess / unit_n.max(local.most_n / BORNE).max(excess) }
        };
        if let Some(stiffness_n) = member.stiffness_n {
            // From the numbers given, F at the length d, and not from the unstretched length l that the
            // solvers have: EA (D/l - 1) with l = d EA/(EA + F).
            let (given_m, prestress_n) =
                (member.given_body().length_m(), member.prestress_n().unwrap_or(0.0));
            let elastic_n =
                (stiffness_n + prestress_n) * ((distance_m - given_m) / given_m) + prestress_n;
            let wanted_n = member.kind.borne(elastic_n);
            let rounding = stored_n(member, rounding_m);
            self.found.note(|s| &mut s.law, of_force((axial_n - wanted_n).abs(), rounding), place);
            return;
        }
        let (length, sign, slack) = match member.kind {
            Kind::Bar => (longer.max(shorter), 0.0, 0.0),
            Kind::Cable => (longer, -axial_n, shorter),
            Kind::Strut => (shorter, axial_n, longer),
        };
        // `max` forgets NaN, and the distance has it.
        self.found.note(|s| &mut s.length, worse(length, 0.0 * distance_m), place);
        self.found.note(|s| &mut s.law, vanishing(sign), place);
        // Of a member that is slack and yet carries a force the smaller of both is wrong.
        self.found.note(|s| &mut s.law, slack.min(vanishing(axial_n.abs())), place);
    }

    /// What is left over at every joint.
    fn joint_balances(&self) -> Vec<f64> {
        let gravity = self.system.gravity_m_s2();
        let at_joint = |(joint, reaction): (&Joint, &Vector)| {
            let [x, y, z] = joint.force_n;
            let left = plus(*reaction, [x, y, z - joint.mass_kg * gravity]);
            let sizes_n = [norm(*reaction), norm(joint.force_n), joint.mass_kg * gravity];
            (left, sizes_n.into_iter().fold(0.0, worse))
        };
        let joints = self.system.joints().iter().zip(&self.answer.reactions_n);
        let (mut left, mut unit_n): (Vec<Vector>, Vec<f64>) = joints.map(at_joint).unzip();
        // Along the spans of a rope the forces are those of the stored places.
        let mut turned_n: BTreeMap<usize, f64> = BTreeMap::new();
        for (k, member) in self.system.members().iter().enumerate() {
            for (joints, forces) in span_forces(member, k, self.answer) {
                for (joint, force) in joints.into_iter().zip(forces) {
                    left[joint] = minus(left[joint], force);
                    unit_n[joint] = worse(unit_n[joint], norm(force));
                    if member.rope.is_some() {
                        *turned_n.entry(joint).or_default() +=
                            self.units.turned_n(norm(force), joints, self.answer);
                    }
                }
            }
        }
        let all = left.into_iter().zip(unit_n).enumerate();
        let part = |(k, (left, unit_n))| {
            let turned_n = turned_n.get(&k).copied().unwrap_or_default();
            // Where nothing acts anywhere there is no size but that of the forces.
            let acts_n = self.units.acts_n.get(k).copied().filter(|acts_n| acts_n.is_finite());
            let least_n = IDLE * acts_n.unwrap_or_default();
            self.units.along(&[k], turned_n).part(norm(left), worse(unit_n, least_n))
        };
        all.map(part).collect()
    }

    /// A supported joint lies on its support, whose force is normal to the motion that it leaves free;
    /// a free joint gets no force but that of the floor.
    fn support(&mut self, k: usize) {
        let reaction = self.answer.reactions_n[k];
        let (at_m, support) = (self.answer.joints_m[k], &self.system.joints()[k].support);
        let (off, along) = (minus(at_m, support.nearest_m(at_m)), support.free_part(reaction));
        let off = beyond(norm(off), self.units.rounding_m) / self.units.size_m;
        self.found.note(|s| &mut s.support, off, Place::Joint(k));
        let push_n = push_n(self.system, self.answer, k);
        let along = minus(along, times(push_n, support.free_part(UP)));
        let off = self.units.at(&[k]).part(norm(along), norm(reaction));
        self.found.note(|s| &mut s.joint, off, Place::Joint(k));
        if let Some(floor_m) = self.system.floor_m() {
            self.on_floor(self.answer.joints_m[k][2] - floor_m, push_n, k);
        }
    }

    /// A joint at a height above the floor, which pushes it: not below, not pulled, and pushed on the
    /// floor alone.
    fn on_floor(&mut self, above_m: f64, push_n: f64, k: usize) {
        let place = Place::Joint(k);
        let height = |above_m: f64| beyond(above_m, self.units.rounding_m) / self.units.size_m;
        let force = |push_n: f64| self.units.at(&[k]).part(push_n, self.units.largest_n);
        self.found.note(|s| &mut s.support, height(-above_m), place);
        self.found.note(|s| &mut s.joint, force(-push_n), place);
        // Of a joint that is pushed above the floor the smaller of both is wrong.
        self.found.note(|s| &mut s.joint, force(push_n).min(height(above_m)), place);
    }

    /// Forces of all supports and all loads together, in units of their sizes, or their moments about
    /// the reference, in units of that times the size of the system.
    fn whole(&self) -> f64 {
        let Self { system, answer, units, .. } = self;
        let origin = system.reference_m();
        let place = |k: usize| minus(answer.joints_m[k], origin);
        let ground = answer.reactions_n.iter().enumerate().map(|(k, force)| (place(k), *force));
        let (mut left, mut turn, mut unit) =
            ([Sum::default(); 3], [Sum::default(); 3], Sum::default());
        for (at, force) in loads_at(system, &place).chain(ground) {
            left.iter_mut().zip(force).for_each(|(sum, part)| sum.add(part));
            turn.iter_mut().zip(cross(at, force)).for_each(|(sum, part)| sum.add(part));
            unit.add(norm(force));
        }
        let [left_n, turn_nm] = [left, turn].map(|all| norm(all.map(Sum::value)));
        let unit_n = unit.value();
        let rounding_n = units.rounding_n.min(MOST_ROUNDING * units.total_n);
        // Without loads the prestress is what the ground's forces are measured by, not these themselves.
        let least_n =
            if units.load_n > 0.0 || units.total_n.is_infinite() { 0.0 } else { units.total_n };
        let local = Local { rounding_n, most_n: BORNE * units.total_n, least_n };
        // A displaced joint turns the whole: force times displacement.
        let turn_n = beyond(turn_nm, unit_n * units.rounding_m);
        let turn_n = if turn_n > 0.0 { turn_n / units.size_m } else { turn_n };
        worse(local.part(left_n, unit_n), local.part(turn_n, unit_n))
    }

    /// The energy less that of the joints' places, in units of the sizes of its terms.
    fn energy(&self) -> f64 {
        let Self { system, answer, units, .. } = self;
        let origin = system.reference_m();
        let place = |k: usize| minus(answer.joints_m[k], origin);
        let mut terms = Vec::new();
        let mut unit_j = 0.0;
        for (at, force) in loads_at(system, &place) {
            terms.push(-dot(force, at));
            unit_j += norm(force) * units.size_m;
        }
        for member in system.members() {
            let Some(stiffness_n) = member.stiffness_n else { continue };
            let length_m = member.body.length_m();
            let stretch_m = member.kind.borne(spans::length_m(member, &answer.joints_m) - length_m);
            let elastic_j = 0.5 * stiffness_n / length_m * stretch_m * stretch_m;
            terms.push(elastic_j);
            unit_j += elastic_j + stiffness_n * units.rounding_m;
        }
        let off = (answer.energy_j - sum(terms)).abs();
        let off = beyond(off, units.rounding_j);
        if off <= 0.0 { 0.0 } else { off / unit_j }
    }
}

/// Every load with where it acts.
fn loads_at<'a>(
    system: &'a System,
    place: &'a dyn Fn(usize) -> Vector,
) -> impl Iterator<Item = (Vector, Vector)> + 'a {
    let gravity = system.gravity_m_s2();
    let at_joints = system.joints().iter().enumerate().map(move |(k, joint)| {
        let [x, y, z] = joint.force_n;
        (place(k), [x, y, z - joint.mass_kg * gravity])
    });
    let on_members = system.members().iter().flat_map(move |member| {
        let (a, b) = (place(member.from), place(member.to));
        loads(system, member).map(move |(part, force)| (plus(a, times(part, minus(b, a))), force))
    });
    at_joints.chain(on_members)
}

#[cfg(test)]
pub(super) mod tests;
