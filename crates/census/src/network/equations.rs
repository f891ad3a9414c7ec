//! The equations (1)-(3) and their derivative, over boxes of unknowns.

use model::system::System;
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::activity::Activity;
use super::arithmetic::{Vector, difference, dot, minus, norm, plus, product, squared, sum, times};
use super::coordinates::Coordinates;
use super::frame::Frame;
use super::turns::Turn;

/// An entry of the derivative: row, column, value.
pub(super) type Entry = (usize, usize, Interval);

/// A member that acts.
#[derive(Debug, Clone)]
pub(super) struct Acting {
    /// Its number in the system.
    pub(super) member: usize,
    pub(super) ends: [usize; 2],
    pub(super) length: Interval,
    /// 0 for an inextensible one.
    pub(super) compliance: Interval,
    /// Number of its force density among the unknowns, and of its equation.
    pub(super) density: usize,
}

/// A coordinate that is fixed, and the force that holds it.
#[derive(Debug, Clone)]
pub(super) struct Hold {
    pub(super) arm: usize,
    pub(super) centre: usize,
    pub(super) across: Vector,
    /// Number of the unknown force and of the equation.
    pub(super) number: usize,
}

/// As many equations as unknowns: coordinates of joints, force densities, forces that hold free
/// turns.
#[derive(Debug, Clone)]
pub(super) struct Equations {
    pub(super) frame: Frame,
    pub(super) joints: Vec<Coordinates>,
    pub(super) acting: Vec<Acting>,
    pub(super) holds: Vec<Hold>,
    pub(super) loads: Vec<Vector>,
    /// Lengths of all members.
    pub(super) lengths: Vec<Interval>,
    /// Number of unknowns.
    pub(super) size: usize,
}

impl Equations {
    /// The equations of a system in which these members act; `held` joints stay where they are.
    pub(super) fn new(
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
        let mut acting = vec![];
        for (k, member) in system.members().iter().enumerate() {
            if activities[k] == Activity::Acts {
                let length = lengths[k];
                let compliance = frame.compliance(member);
                let ends = [member.from, member.to];
                acting.push(Acting { member: k, ends, length, compliance, density: size });
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
        Self { frame, joints, acting, holds, loads, lengths, size }
    }

    /// The same under other loads of the joints, in units.
    pub(super) fn with_loads(self, loads: Vec<Vector>) -> Self {
        Self { loads, ..self }
    }

    /// The unknowns next to an answer; NaN where that is not finite.
    pub(super) fn start(&self, joints_m: &[Point], axial_n: &[f64]) -> Vec<f64> {
        let mut at = vec![0.0; self.size];
        let place = |joint: usize| self.frame.place(joints_m[joint]);
        for (k, joint) in self.joints.iter().enumerate() {
            for (slot, t) in at[joint.first..].iter_mut().zip(joint.of(place(k))) {
                *slot = t;
            }
        }
        for acting in &self.acting {
            let [a, b] = acting.ends.map(place);
            let axial = axial_n[acting.member] / self.frame.force_n;
            at[acting.density] = axial / norm(minus(b, a)).mid();
        }
        at
    }

    /// Places of all joints.
    pub(super) fn places(&self, unknowns: &[Interval]) -> Vec<Vector> {
        self.joints.iter().map(|joint| joint.place(unknowns)).collect()
    }

    /// Left-hand sides over a box.
    ///
    /// # Errors
    ///
    /// [`NoBox::NotFinite`] when a place is not finite.
    pub(super) fn value(&self, unknowns: &[Interval]) -> Result<Vec<Interval>, NoBox> {
        let places = self.places(unknowns);
        let mut forces = self.loads.clone();
        let mut value = vec![Interval::ZERO; self.size];
        for acting in &self.acting {
            let [a, b] = acting.ends;
            let (span, density) = (minus(places[b], places[a]), unknowns[acting.density]);
            let pull = times(density, span);
            forces[a] = plus(forces[a], pull);
            forces[b] = minus(forces[b], pull);
            value[acting.density] = acting.misfit(span, density);
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
    pub(super) fn slope(&self, unknowns: &[Interval]) -> Vec<Entry> {
        let places = self.places(unknowns);
        let mut entries = Vec::with_capacity(64 * self.acting.len());
        let mut stiffness = vec![Interval::ZERO; self.joints.len()];
        for acting in &self.acting {
            let [a, b] = acting.ends;
            let (span, density) = (minus(places[b], places[a]), unknowns[acting.density]);
            for (here, there, span) in [(a, b, span), (b, a, span.map(|part| -part))] {
                stiffness[here] = sum(stiffness[here], density);
                let (joint, other) = (&self.joints[here], &self.joints[there]);
                let along = acting.gradient(span, density);
                for (k, axis) in joint.axes.iter().enumerate() {
                    let row = joint.first + k;
                    entries.push((row, acting.density, dot(*axis, span)));
                    entries.push((acting.density, row, -dot(*axis, along)));
                    for (i, towards) in other.axes.iter().enumerate() {
                        entries.push((
                            row,
                            other.first + i,
                            product(density, dot(*axis, *towards)),
                        ));
                    }
                }
            }
            entries.push((acting.density, acting.density, acting.give(span)));
        }
        for (joint, stiffness) in self.joints.iter().zip(stiffness) {
            for (k, axis) in joint.axes.iter().enumerate() {
                for (i, other) in joint.axes.iter().enumerate() {
                    let entry = -product(stiffness, dot(*axis, *other));
                    entries.push((joint.first + k, joint.first + i, entry));
                }
            }
        }
        self.slope_of_holds(&mut entries);
        entries.retain(|(_, _, value)| *value != Interval::ZERO);
        entries
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
    pub(super) fn is_rigid(&self) -> bool {
        self.compliance == Interval::ZERO
    }

    /// Left-hand side of (2) or (3).
    fn misfit(&self, span: Vector, density: Interval) -> Interval {
        if self.is_rigid() {
            difference(squared(span), self.length.square()).scale(0.5)
        } else {
            self.shrink(density) * norm(span) - self.length
        }
    }

    /// `1 − c w`.
    pub(super) fn shrink(&self, density: Interval) -> Interval {
        difference(Interval::ONE, product(self.compliance, density))
    }

    /// Derivative of the misfit by the span.
    pub(super) fn gradient(&self, span: Vector, density: Interval) -> Vector {
        if self.is_rigid() {
            span
        } else {
            let size = norm(span);
            let unit = span.map(|part| if part == Interval::ZERO { part } else { part / size });
            times(self.shrink(density), unit)
        }
    }

    /// Derivative of the misfit by the force density.
    pub(super) fn give(&self, span: Vector) -> Interval {
        if self.is_rigid() { Interval::ZERO } else { -(self.compliance * norm(span)) }
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, Support};

    use super::*;
    use crate::network::newton::dense;

    /// A string of two bars, a spring and a bar between an anchor and a joint on a slope, a bar
    /// back, and the turn of a joint about one that moves.
    fn equations() -> Equations {
        let light = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let slope = Support::Plane { at_m: [1.0, 0.5, -1.0], normal: [0.6, 0.0, 0.8] };
        let joints = vec![
            Joint::anchor("A", [0.0, 0.0, 0.0]),
            Joint::free("P").with_mass(0.3),
            Joint { support: slope, ..Joint::free("Q").with_mass(0.2) },
            Joint::free("R").with_mass(0.1),
        ];
        let members = vec![
            Member::bar(0, 1, light(1.0)),
            Member::bar(1, 2, light(1.3)).with_stiffness(7.0),
            Member::bar(2, 3, light(0.8)),
            Member::bar(3, 1, light(1.1)),
        ];
        let system = System::new("twin", 10.0, joints, members).unwrap();
        let turn = Turn { joints: vec![3], centre: 1, arm: 3, across: [0.6, 0.8] };
        let frame = Frame::new(&system, &[]);
        let held = [true, false, false, false];
        Equations::new(&system, frame, &[Activity::Acts; 4], &[turn], &[[0.0; 3]; 4], &held)
    }

    #[test]
    fn the_slope_is_its_difference_quotient() {
        let equations = equations();
        // Three coordinates, two, three; four densities; the force that holds the turn.
        assert_eq!(equations.size, 3 + 2 + 3 + 4 + 1);
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
