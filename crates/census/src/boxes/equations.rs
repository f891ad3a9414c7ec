//! The equations (1)-(3) and their derivative, over boxes of unknowns.

use std::ops::Range;

use model::system::System;
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::activity::Activity;
use super::arithmetic::{
    NOWHERE, Vector, difference, dot, minus, norm, over, plus, product, squared, sum, times,
};
use super::coordinates::Coordinates;
use super::frame::Frame;
use super::turns::Turn;

/// An entry of the derivative: row, column, value.
pub(super) type Entry = (usize, usize, Interval);

#[derive(Debug, Clone)]
pub(crate) struct Acting {
    /// Its number in the system.
    pub(crate) member: usize,
    /// Numbers of its spans: one, or of a rope several.
    pub(crate) spans: Range<usize>,
    pub(crate) length: Interval,
    /// 0 for an inextensible one.
    pub(crate) compliance: Interval,
    /// Number of its force, or force density, among the unknowns, and of its equation.
    pub(crate) force: usize,
}

/// A coordinate that is fixed, and the force that holds it.
#[derive(Debug, Clone)]
pub(crate) struct Hold {
    pub(super) arm: usize,
    pub(super) centre: usize,
    pub(super) across: Vector,
    /// Number of the unknown force and of the equation.
    pub(super) number: usize,
}

/// As many equations as unknowns: coordinates of joints, forces or their densities, forces that hold free
/// turns.
#[derive(Debug, Clone)]
pub(crate) struct Equations {
    pub(super) frame: Frame,
    pub(super) joints: Vec<Coordinates>,
    pub(crate) acting: Vec<Acting>,
    pub(crate) holds: Vec<Hold>,
    pub(super) loads: Vec<Vector>,
    pub(super) lengths: Vec<Interval>,
    /// The joints of the spans of all members.
    pub(super) ends: Vec<[usize; 2]>,
    /// Which of them are those of a member.
    pub(super) spans: Vec<Range<usize>>,
    pub(crate) size: usize,
}

impl Equations {
    /// The equations of a system in which these members act; `held` joints stay where they are.
    pub(crate) fn new(
        system: &System,
        frame: Frame,
        activities: &[Activity],
        turns: &[Turn],
        places_m: &[Point],
        held: &[bool],
    ) -> Self {
        let mut size = 0;
        let mut joints = vec![];
        for (k, joint) in system.joints().iter().enumerate() {
            let coordinates = if held[k] && !joint.support.is_fixed() {
                Coordinates::held(frame.place(places_m[k]), size)
            } else {
                Coordinates::new(&joint.support, &frame, size)
            };
            size += coordinates.axes.len();
            joints.push(coordinates);
        }
        let lengths = system.members().iter();
        let lengths: Vec<Interval> =
            lengths.map(|member| frame.length(Interval::point(member.body.length_m()))).collect();
        let (mut ends, mut spans, mut acting) = (vec![], vec![], vec![]);
        for (k, member) in system.members().iter().enumerate() {
            let first = ends.len();
            ends.extend(member.spans());
            spans.push(first..ends.len());
            if activities[k] == Activity::Acts {
                let (length, compliance) = (lengths[k], frame.compliance(member));
                let spans = spans[k].clone();
                acting.push(Acting { member: k, spans, length, compliance, force: size });
                size += 1;
            }
        }
        let mut holds = vec![];
        for turn in turns {
            let [x, y] = turn.across.map(Interval::point);
            let across = [x, y, Interval::ZERO];
            holds.push(Hold { arm: turn.arm, centre: turn.centre, across, number: size });
            size += 1;
        }
        let loads = frame.loads(system);
        Self { frame, joints, acting, holds, loads, lengths, ends, spans, size }
    }

    /// The same under other loads of the joints, in units.
    pub(crate) fn with_loads(self, loads: Vec<Vector>) -> Self {
        Self { loads, ..self }
    }

    /// The unknowns next to an answer; NaN where that is not finite.
    pub(crate) fn start(&self, joints_m: &[Point], axial_n: &[f64]) -> Vec<f64> {
        let mut at = vec![0.0; self.size];
        for (k, joint) in self.joints.iter().enumerate() {
            let place = self.frame.place(joints_m[k]);
            for (slot, t) in at[joint.first..].iter_mut().zip(joint.of(place)) {
                *slot = t;
            }
        }
        for acting in &self.acting {
            let axial = axial_n[acting.member] / self.frame.force_n;
            at[acting.force] = axial / acting.axial(Interval::ONE).mid();
        }
        at
    }

    pub(crate) fn places(&self, unknowns: &[Interval]) -> Vec<Vector> {
        self.joints.iter().map(|joint| joint.place(unknowns)).collect()
    }

    /// Left-hand sides over a box.
    /// [`NoBox::NotFinite`] when a place is not finite.
    pub(super) fn value(&self, unknowns: &[Interval]) -> Result<Vec<Interval>, NoBox> {
        let places = self.places(unknowns);
        let mut forces = self.loads.clone();
        let mut value = vec![Interval::ZERO; self.size];
        for acting in &self.acting {
            let (force, spans) = (unknowns[acting.force], self.spans_of(acting, &places));
            for ([a, b], span) in self.ends[acting.spans.clone()].iter().zip(&spans) {
                let pull = times(force, acting.direction(*span).along);
                forces[*a] = plus(forces[*a], pull);
                forces[*b] = minus(forces[*b], pull);
            }
            value[acting.force] = acting.misfit(&spans, force);
        }
        for hold in &self.holds {
            forces[hold.arm] = plus(forces[hold.arm], times(unknowns[hold.number], hold.across));
            value[hold.number] = dot(hold.across, minus(places[hold.arm], places[hold.centre]));
        }
        for (joint, force) in self.joints.iter().zip(&forces) {
            for (k, axis) in joint.axes.iter().enumerate() {
                value[joint.first + k] = dot(*axis, *force);
            }
        }
        let finite = value.iter().all(|part| part.mag().is_finite());
        if finite { Ok(value) } else { Err(NoBox::NotFinite) }
    }

    /// The derivative over a box, entries of the same place to be added.
    pub(crate) fn slope(&self, unknowns: &[Interval]) -> Vec<Entry> {
        let places = self.places(unknowns);
        let mut entries = Vec::with_capacity(64 * self.acting.len());
        for acting in &self.acting {
            let (row, force) = (acting.force, unknowns[acting.force]);
            for (ends, span) in
                self.ends[acting.spans.clone()].iter().zip(self.spans_of(acting, &places))
            {
                let direction = acting.direction(span);
                for (joint, k, axis, sign) in self.axes(*ends) {
                    // What pulls one end pulls the other one the other way.
                    let by = product(sign, dot(axis, direction.along));
                    entries.extend([(joint.first + k, row, -by), (row, joint.first + k, by)]);
                    for (other, i, towards, other_sign) in self.axes(*ends) {
                        let pull = dot(axis, direction.turned(force, towards));
                        let pull = -product(product(sign, other_sign), pull);
                        entries.push((joint.first + k, other.first + i, pull));
                    }
                }
            }
            entries.push((row, row, -acting.compliance));
        }
        self.slope_of_holds(&mut entries);
        entries.retain(|(_, _, value)| *value != Interval::ZERO);
        entries
    }

    fn spans_of(&self, acting: &Acting, places: &[Vector]) -> Vec<Vector> {
        let ends = self.ends[acting.spans.clone()].iter();
        ends.map(|[a, b]| minus(places[*b], places[*a])).collect()
    }

    /// The coordinates of both ends of a span with their directions, and the sign with which they change it.
    pub(super) fn axes(
        &self,
        [a, b]: [usize; 2],
    ) -> impl Iterator<Item = (&Coordinates, usize, Vector, Interval)> {
        [(a, -Interval::ONE), (b, Interval::ONE)].into_iter().flat_map(|(joint, sign)| {
            let joint = &self.joints[joint];
            joint.axes.iter().enumerate().map(move |(k, axis)| (joint, k, *axis, sign))
        })
    }

    pub(super) fn slope_of_holds(&self, entries: &mut Vec<Entry>) {
        for hold in &self.holds {
            let (arm, centre) = (&self.joints[hold.arm], &self.joints[hold.centre]);
            for (k, axis) in arm.axes.iter().enumerate() {
                let part = dot(*axis, hold.across);
                entries.push((arm.first + k, hold.number, part));
                entries.push((hold.number, arm.first + k, part));
            }
            for (k, axis) in centre.axes.iter().enumerate() {
                entries.push((hold.number, centre.first + k, -dot(*axis, hold.across)));
            }
        }
    }
}

impl Acting {
    /// Whether it keeps its length.
    pub(crate) fn is_rigid(&self) -> bool {
        self.compliance == Interval::ZERO
    }

    /// Whether its unknown is its force density, and its equation (2), so that both are polynomials.
    pub(crate) fn is_squared(&self) -> bool {
        self.is_rigid() && self.spans.len() == 1
    }

    /// What it pulls with for this unknown.
    pub(crate) fn axial(&self, force: Interval) -> Interval {
        if self.is_squared() { product(force, self.length) } else { force }
    }

    /// Left-hand side of (2) or (3).
    pub(crate) fn misfit(&self, spans: &[Vector], force: Interval) -> Interval {
        match spans {
            [span] if self.is_squared() => {
                difference(squared(*span), self.length.square()).scale(0.5)
            }
            spans => {
                let size = spans.iter().map(|span| norm(*span)).fold(Interval::ZERO, sum);
                difference(difference(size, product(self.compliance, force)), self.length)
            }
        }
    }

    pub(crate) fn direction(&self, span: Vector) -> Direction {
        if self.is_squared() {
            return Direction { along: span, size: None };
        }
        let size = norm(span);
        Direction { along: over(span, size), size: Some(size) }
    }
}

/// The pull on the first end of a span by a unit of the unknown, which is the derivative of the equation by the
/// span too: the span $d$ itself or $u = d/|d|$.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Direction {
    pub(super) along: Vector,
    /// $|d|$ for $u$.
    size: Option<Interval>,
}

impl Direction {
    /// Its change with the span, times a force: $P a = a - u\\,(u \\cdot a)$ over $|d|$.
    pub(crate) fn turned(&self, force: Interval, change: Vector) -> Vector {
        let Some(size) = self.size else { return times(force, change) };
        times(force, over(self.across(change), size))
    }

    fn across(&self, change: Vector) -> Vector {
        minus(change, times(dot(self.along, change), self.along))
    }

    /// Its second derivative by two changes of the span, $-((u \\cdot b) P a + (u \\cdot a) P b + (a
    /// \\cdot P b)\\,u)/|d|^2$.
    pub(super) fn bent(&self, a: Vector, b: Vector) -> Vector {
        let Some(size) = self.size else { return NOWHERE };
        let [across_a, across_b] = [a, b].map(|change| self.across(change));
        let both = plus(times(dot(self.along, b), across_a), times(dot(self.along, a), across_b));
        over(plus(both, times(dot(a, across_b), self.along)), size.square()).map(|part| -part)
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, Support};

    use super::*;
    use crate::boxes::newton::dense;

    /// A string of two bars, a spring and a bar between an anchor and a joint on a slope, a bar
    /// back, the turn of a joint about one that moves, and two ropes over all of them.
    fn equations() -> Equations {
        let light = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let slope = Support::Plane { at_m: [1.0, 0.5, -1.0], normal: [0.6, 0.0, 0.8] };
        let joints = vec![
            Joint::anchor("A", [0.0, 0.0, 0.0]),
            Joint::free("P").with_mass(0.3),
            Joint::free("Q").with_mass(0.2).held_by(slope),
            Joint::free("R").with_mass(0.1),
        ];
        let members = vec![
            Member::bar(0, 1, light(1.0)),
            Member::bar(1, 2, light(1.3)).with_stiffness(7.0),
            Member::bar(2, 3, light(0.8)),
            Member::bar(3, 1, light(1.1)),
            Member::cable(0, 1, light(4.3)).over(vec![2, 3, 2]).with_stiffness(5.0),
            Member::cable(3, 2, light(2.9)).over(vec![0, 1]),
        ];
        let system = System::new("twin", 10.0, joints, members).unwrap();
        let turn = Turn { joints: vec![3], centre: 1, arm: 3, across: [0.6, 0.8] };
        let frame = Frame::new(&system, &[]);
        let held = [true, false, false, false];
        Equations::new(&system, frame, &[Activity::Acts; 6], &[turn], &[[0.0; 3]; 4], &held)
    }

    #[test]
    fn the_slope_is_its_difference_quotient() {
        let equations = equations();
        // Three coordinates, two, three; six forces; the force that holds the turn.
        assert_eq!(equations.size, 3 + 2 + 3 + 6 + 1);
        let at: Vec<f64> =
            (0..equations.size).map(|k| (1.0 + 1.7 * k as f64).sin() + 0.1).collect();
        let points = |at: &[f64]| at.iter().copied().map(Interval::point).collect::<Vec<_>>();
        let value = |at: &[f64]| equations.value(&points(at)).unwrap();
        let slope = dense(equations.size, &equations.slope(&points(&at)));
        for column in 0..equations.size {
            let moved = |step: f64| {
                let mut at = at.clone();
                at[column] += step;
                value(&at)
            };
            let (more, less) = (moved(1e-5), moved(-1e-5));
            for row in 0..equations.size {
                let quotient = (more[row].mid() - less[row].mid()) / 2e-5;
                let error = (slope[(row, column)] - quotient).abs();
                assert!(error < 1e-8, "{row} {column}: {} {quotient}", slope[(row, column)]);
            }
        }
    }
}
