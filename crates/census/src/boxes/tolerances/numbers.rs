//! How each uncertain number enters the equations.

use model::system::{System, Uncertain, UncertainNumber as Number};
use numerics::Interval;

use super::super::arithmetic::{NOWHERE, Vector, dot, plus, product, sum, upon};
use super::super::equations::{Acting, Equations};
use super::region::Region;

/// What one number does, for a change of its whole tolerance, at fixed unknowns.
#[derive(Debug, Clone, Default)]
pub(super) struct Effect {
    /// Changes of the loads at joints.
    pub(super) forces: Vec<(usize, Vector)>,
    /// Changes of the laws of members.
    rows: Vec<(usize, Interval)>,
    /// A joint whose support moves, and by what.
    moved: Option<(usize, Vector)>,
    /// A member whose length changes, and by what.
    pub(super) lengthened: Option<(usize, Interval)>,
    /// A member that gets stiffer, and by which part of its compliance that falls.
    pub(super) stiffened: Option<(usize, Interval)>,
}

/// The equations with all numbers in ranges: part by part of their tolerances, from -1 to 1.
pub(super) fn within(
    equations: &Equations,
    system: &System,
    numbers: &[Uncertain],
    parts: &[Interval],
) -> Equations {
    let mut found = equations.clone();
    let mut softer = vec![Interval::ONE; system.members().len()];
    for (uncertain, part) in numbers.iter().zip(parts) {
        let frame = found.frame;
        let off = part.times(uncertain.within);
        let value = Interval::point(uncertain.given) + off;
        match uncertain.number {
            Number::Length(k) => found.lengths[k] = frame.length(value),
            Number::Stiffness(k) => softer[k] = Interval::point(uncertain.given) / value,
            Number::Mass(_) | Number::JointMass(_) | Number::Force(..) => {
                for (joint, force) in loads(&found, system, uncertain.number, off) {
                    found.loads[joint] = plus(found.loads[joint], force);
                }
            }
            Number::At(k, axis) => {
                let at = &mut found.joints[k].origin[axis];
                *at = sum(*at, frame.length(off));
            }
        }
    }
    for acting in &mut found.acting {
        let (length, softer) = (found.lengths[acting.member], softer[acting.member]);
        if length != acting.length {
            acting.compliance = product(acting.compliance, length / acting.length);
            acting.length = length;
        }
        acting.compliance = product(acting.compliance, softer);
    }
    found
}

/// What joints bear of a mass or of a force, in units.
fn loads(
    equations: &Equations,
    system: &System,
    number: Number,
    by: Interval,
) -> Vec<(usize, Vector)> {
    let frame = &equations.frame;
    match number {
        Number::Mass(k) => {
            let member = &system.members()[k];
            let share = |is_start| frame.weight_share(system, member, by, is_start);
            vec![(member.from, share(true)), (member.to, share(false))]
        }
        Number::JointMass(k) => vec![(k, frame.weight(system, by))],
        Number::Force(k, axis) => vec![(k, upon(axis, frame.force(by)))],
        _ => vec![],
    }
}

impl Effect {
    /// Over a region, with the equations over all numbers.
    pub(super) fn new(
        equations: &Equations,
        system: &System,
        uncertain: &Uncertain,
        region: &Region,
    ) -> Self {
        let by = Interval::point(uncertain.within);
        let forces = loads(equations, system, uncertain.number, by);
        let mut found = Self { forces, ..Self::default() };
        match uncertain.number {
            Number::Length(k) => found.lengthened = Some((k, equations.frame.length(by))),
            Number::Stiffness(k) => {
                let value = Interval::point(uncertain.given) + Interval::around(0.0, by.hi());
                found.stiffened = Some((k, by / value));
            }
            Number::At(k, axis) => {
                found.moved = Some((k, upon(axis, equations.frame.length(by))));
            }
            Number::Mass(_) | Number::JointMass(_) | Number::Force(..) => {}
        }
        let rows = equations.acting.iter().filter_map(|acting| found.law(acting, region));
        found.rows = rows.collect();
        found
    }

    /// What it does to the law of a member: $\partial/\partial l$ of (2) is $-l$, of (3) with $c = l/EA$
    /// it is $-1 - c N/l$, and a stiffness that is larger by a part takes that part off $c$.
    fn law(&self, acting: &Acting, region: &Region) -> Option<(usize, Interval)> {
        let own = |of: Option<(usize, Interval)>| of.filter(|(k, _)| *k == acting.member);
        let through = product(acting.compliance, region.unknowns[acting.force]);
        let longer = own(self.lengthened).map(|(_, by)| {
            let change = if acting.is_squared() {
                acting.length
            } else {
                sum(Interval::ONE, product(through, Interval::ONE / acting.length))
            };
            -product(change, by)
        });
        let stiffer = own(self.stiffened).map(|(_, part)| product(through, part));
        Some((acting.force, longer.or(stiffer)?))
    }

    /// The change of all left-hand sides, but for what moved supports do.
    pub(super) fn column(&self, equations: &Equations) -> Vec<Interval> {
        let mut column = vec![Interval::ZERO; equations.size];
        for (joint, force) in &self.forces {
            let joint = &equations.joints[*joint];
            for (k, axis) in joint.axes.iter().enumerate() {
                let row = &mut column[joint.first + k];
                *row = sum(*row, dot(*axis, *force));
            }
        }
        for (row, change) in &self.rows {
            column[*row] = sum(column[*row], *change);
        }
        column
    }

    /// How it moves a joint.
    pub(super) fn moves(&self, joint: usize) -> Vector {
        self.moved.filter(|(moved, _)| *moved == joint).map_or(NOWHERE, |(_, by)| by)
    }
}
