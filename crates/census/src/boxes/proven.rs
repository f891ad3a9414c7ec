use model::system::{Kind, Member, System};
use numerics::Interval;
use numerics::vector::worse;

use super::activity::Activity;
use super::arithmetic::{Vector, minus, norm, plus, sum, times};
use super::equations::Equations;
use super::frame::Frame;

/// A box that holds exactly one equilibrium of a system, in metres and newtons; every number is an
/// enclosure of the exact value.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemBox {
    /// Places of all joints, world frame, m.
    pub joints_m: Vec<[Interval; 3]>,
    /// Axial force of each member with its loads lumped to its joints, tension positive, N.
    pub axial_n: Vec<Interval>,
    /// Largest width of the places, m.
    pub width_m: f64,
    /// Largest width of the axial forces, N.
    pub width_n: f64,
    /// Independent free turns about verticals: the equilibrium stands for all that these turns make
    /// of it.
    pub turns: usize,
    /// Cables and struts proved to be slack, from 0.
    pub slack: Vec<usize>,
    /// Joints without load all of whose members are slack: held where the answer has them, from 0.
    pub loose_joints: Vec<usize>,
}

impl SystemBox {
    /// A proved zero in metres and newtons.
    pub(super) fn new(
        system: &System,
        equations: &Equations,
        activities: &[Activity],
        loose: &[bool],
        zero: &[Interval],
    ) -> Self {
        let frame = &equations.frame;
        let places = equations.places(zero);
        let of_idle = |(activity, member)| match activity {
            &Activity::Idle => idle_n(member, &places, frame.length_m),
            _ => Interval::ZERO,
        };
        let mut axial_n: Vec<Interval> =
            activities.iter().zip(system.members()).map(of_idle).collect();
        for acting in &equations.acting {
            let axial = acting.axial(zero[acting.force]);
            axial_n[acting.member] = axial.scale(frame.force_n);
        }
        let joints_m: Vec<_> = places.iter().map(|place| frame.place_m(*place)).collect();
        let widest = |numbers: &mut dyn Iterator<Item = &Interval>| {
            numbers.map(|x| x.width()).fold(0.0, f64::max)
        };
        Self {
            width_m: widest(&mut joints_m.iter().flatten()),
            width_n: widest(&mut axial_n.iter()),
            turns: equations.holds.len(),
            slack: (0..activities.len()).filter(|k| activities[*k] == Activity::Slack).collect(),
            loose_joints: (0..loose.len()).filter(|k| loose[*k]).collect(),
            joints_m,
            axial_n,
        }
    }

    /// What loads and all spans but those that are skipped, by member and place in it, leave over at each
    /// joint, N.
    pub(super) fn left_n(
        &self,
        system: &System,
        skipped: impl Fn(usize, usize) -> bool,
    ) -> Vec<Vector> {
        let frame = Frame::new(system, &[]);
        let loads = frame.loads(system).into_iter();
        let mut left: Vec<Vector> =
            loads.map(|load| load.map(|part| part.scale(frame.force_n))).collect();
        for (k, (member, axial)) in system.members().iter().zip(&self.axial_n).enumerate() {
            for (number, [a, b]) in member.spans().enumerate() {
                if *axial == Interval::ZERO || skipped(k, number) {
                    continue;
                }
                let span = minus(self.joints_m[b], self.joints_m[a]);
                let pull = times(*axial / norm(span), span);
                left[a] = plus(left[a], pull);
                left[b] = minus(left[b], pull);
            }
        }
        left
    }

    /// How far outside of the box the joints of an answer lie, m; NaN where it is not finite.
    pub fn beyond_m(&self, joints_m: &[model::Vector]) -> f64 {
        let places = self.joints_m.iter().flatten().zip(joints_m.iter().flatten());
        places.map(|(enclosure, x)| beyond(*enclosure, *x)).fold(0.0, worse)
    }

    /// How far outside of the box the axial forces of an answer lie, N; NaN where it is not finite.
    pub fn beyond_n(&self, axial_n: &[f64]) -> f64 {
        let forces = self.axial_n.iter().zip(axial_n);
        forces.map(|(enclosure, x)| beyond(*enclosure, *x)).fold(0.0, worse)
    }
}

/// The force of an elastic member between two anchors by its law alone, N; a rigid one there is
/// slack.
pub(crate) fn idle_n(member: &Member, places: &[Vector], length_unit_m: f64) -> Interval {
    let distance_m = reach(member, places).scale(length_unit_m);
    let length_m = Interval::point(member.body.length_m());
    let spring =
        |stiffness_n| spring_n(member.kind, Interval::point(stiffness_n), distance_m, length_m);
    member.stiffness_n.map_or(Interval::ZERO, spring)
}

/// The length of all spans of a member together.
pub(crate) fn reach(member: &Member, places: &[Vector]) -> Interval {
    let spans = member.spans().map(|[a, b]| norm(minus(places[b], places[a])));
    spans.fold(Interval::ZERO, sum)
}

/// The force of an elastic member of a distance, N.
pub(super) fn spring_n(
    kind: Kind,
    stiffness_n: Interval,
    distance_m: Interval,
    length_m: Interval,
) -> Interval {
    let stretch = distance_m / length_m - Interval::ONE;
    let [least, most] = match kind {
        Kind::Bar => [f64::NEG_INFINITY, f64::INFINITY],
        Kind::Cable => [0.0, f64::INFINITY],
        Kind::Strut => [f64::NEG_INFINITY, 0.0],
    };
    stiffness_n * Interval::new(stretch.lo().clamp(least, most), stretch.hi().clamp(least, most))
}

fn beyond(enclosure: Interval, x: f64) -> f64 {
    if x.is_nan() { f64::NAN } else { (enclosure.lo() - x).max(x - enclosure.hi()).max(0.0) }
}

#[cfg(test)]
mod tests;
