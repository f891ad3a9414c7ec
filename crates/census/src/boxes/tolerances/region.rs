//! Equilibria around a plane through one of them, and the derivative there, member by member.
//!
//! Neighbours move alike: the range of a span is far narrower than those of its ends together. And the force
//! of a member pulls its ends opposite ways, while the rows of an inverse hardly differ from joint to
//! joint: what varies is therefore kept apart for each member.

use std::ops::Range;

use numerics::{Interval, up};

use super::super::arithmetic::{
    NOWHERE, Vector, difference, dot, minus, norm, plus, product, sum, times,
};
use super::super::equations::{Acting, Equations};
use super::super::inverse::{Defect, Inverse};
use super::numbers::Effect;

/// Ranges of unknowns, and of all spans of all members.
#[derive(Debug, Clone)]
pub(super) struct Region {
    pub(super) unknowns: Vec<Interval>,
    pub(super) places: Vec<Vector>,
    pub(super) spans: Vec<Vector>,
}

/// A change of unknowns, with that of the places.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub(super) unknowns: Vec<Interval>,
    pub(super) moves: Vec<Vector>,
}

impl Step {
    /// With what a number does to supports.
    pub(super) fn new(equations: &Equations, effect: &Effect, unknowns: Vec<Interval>) -> Self {
        let joints = equations.joints.iter().enumerate();
        let moves = joints.map(|(k, joint)| plus(effect.moves(k), joint.step(&unknowns)));
        Self { moves: moves.collect(), unknowns }
    }

    /// Of the span between two joints.
    pub(super) fn stretch(&self, [a, b]: [usize; 2]) -> Vector {
        minus(self.moves[b], self.moves[a])
    }
}

impl Region {
    /// Of points that are independent of each other.
    pub(super) fn new(equations: &Equations, unknowns: Vec<Interval>) -> Self {
        let places = equations.places(&unknowns);
        let spans = equations.ends.iter().map(|[a, b]| minus(places[*b], places[*a])).collect();
        Self { unknowns, places, spans }
    }

    /// All points $\tilde x + S \delta + r$ of a plane, whose middle has these equations, with the numbers off the middle
    /// by $\delta$, and $|r|$ within the room.
    pub(super) fn around(
        fixed: &Equations,
        middle: &[Interval],
        (steps, offs): (&[Step], &[Interval]),
        room: &[f64],
    ) -> Self {
        let mut found = Self::new(fixed, middle.to_vec());
        let room = room.iter().map(|by| Interval::around(0.0, *by)).collect();
        let rest = Step::new(fixed, &Effect::default(), room);
        let all = steps.iter().zip(offs.iter().copied());
        for (step, off) in all.chain([(&rest, Interval::ONE)]) {
            let add = |to: &mut Interval, by: &Interval| *to = sum(*to, product(*by, off));
            let add_all = |to: &mut Vector, by: Vector| {
                to.iter_mut().zip(&by).for_each(|(to, by)| add(to, by));
            };
            found.unknowns.iter_mut().zip(&step.unknowns).for_each(|(to, by)| add(to, by));
            found.places.iter_mut().zip(&step.moves).for_each(|(to, by)| add_all(to, *by));
            let spans = found.spans.iter_mut().zip(&fixed.ends);
            spans.for_each(|(to, ends)| add_all(to, step.stretch(*ends)));
        }
        found
    }

    /// The length of all spans of a member together.
    pub(super) fn reach(&self, spans: Range<usize>) -> Interval {
        self.spans[spans].iter().map(|span| norm(*span)).fold(Interval::ZERO, sum)
    }

    /// How the pull of a member changes in one of its spans.
    pub(super) fn pull(
        &self,
        acting: &Acting,
        span: usize,
        step: &Step,
        stretch: Vector,
    ) -> Vector {
        let direction = acting.direction(self.spans[span]);
        let along = times(step.unknowns[acting.force], direction.along);
        plus(along, direction.turned(self.unknowns[acting.force], stretch))
    }

    /// Bounds of $|I - Y F_x|$.
    pub(super) fn defect(&self, equations: &Equations, inverse: &Inverse) -> Defect {
        let mut others = vec![];
        equations.slope_of_holds(&mut others);
        inverse.defect_by(|row, rest| {
            let mut take =
                |column: usize, by: Interval| rest[column] = difference(rest[column], by);
            for acting in &equations.acting {
                let (force, law) = (self.unknowns[acting.force], row[acting.force]);
                take(acting.force, -acting.compliance.times(law));
                for k in acting.spans.clone() {
                    let (ends, direction) = (equations.ends[k], acting.direction(self.spans[k]));
                    let pull = pull(equations, row, ends);
                    take(acting.force, dot(pull, direction.along));
                    let along = direction.along.map(|part| part.times(law));
                    let by_span = plus(along, direction.turned(force, pull));
                    for (joint, k, axis, sign) in equations.axes(ends) {
                        take(joint.first + k, product(sign, dot(axis, by_span)));
                    }
                }
            }
            for (through, column, entry) in &others {
                take(*column, entry.times(row[*through]));
            }
        })
    }

    /// What a step and a number do together to the left-hand sides.
    pub(super) fn change(&self, equations: &Equations, effect: &Effect, step: &Step) -> Change {
        let mut rows = effect.column(equations);
        let mut rest = Vec::with_capacity(3 * self.spans.len() + equations.acting.len());
        let add = |joint: usize, force: Vector, rows: &mut Vec<Interval>| {
            let joint = &equations.joints[joint];
            for (k, axis) in joint.axes.iter().enumerate() {
                rows[joint.first + k] = sum(rows[joint.first + k], dot(*axis, force));
            }
        };
        for acting in &equations.acting {
            let give = -product(acting.compliance, step.unknowns[acting.force]);
            let mut law = sum(give, rows[acting.force]);
            for k in acting.spans.clone() {
                let ([a, b], stretch) = (equations.ends[k], step.stretch(equations.ends[k]));
                law = sum(law, dot(acting.direction(self.spans[k]).along, stretch));
                let pull = self.pull(acting, k, step, stretch);
                let middle = pull.map(|part| Interval::point(part.mid()));
                add(a, middle, &mut rows);
                add(b, middle.map(|part| -part), &mut rows);
                rest.extend(pull.map(Interval::rad));
            }
            rows[acting.force] = Interval::point(law.mid());
            rest.push(law.rad());
        }
        for hold in &equations.holds {
            let force = times(step.unknowns[hold.number], hold.across);
            add(hold.arm, force, &mut rows);
            let turned = dot(hold.across, step.stretch([hold.centre, hold.arm]));
            rows[hold.number] = sum(rows[hold.number], turned);
        }
        Change { rows, rest }
    }
}

/// Changes of the left-hand sides: for each row, and what may be more or less in the pulls and the law of each
/// member that acts.
pub(super) struct Change {
    pub(super) rows: Vec<Interval>,
    rest: Vec<f64>,
}

impl Change {
    /// The size of each row and of the rest, of all changes times their numbers.
    pub(super) fn total(all: &[Self], offs: &[Interval]) -> Self {
        let size = all.first().map_or(0, |change| change.rows.len());
        let rests = all.first().map_or(0, |change| change.rest.len());
        let (mut rows, mut rest) = (vec![Interval::ZERO; size], vec![0.0; rests]);
        for (change, off) in all.iter().zip(offs) {
            for (to, by) in rows.iter_mut().zip(&change.rows) {
                *to = sum(*to, Interval::around(0.0, product(*by, *off).mag()));
            }
            for (to, by) in rest.iter_mut().zip(&change.rest) {
                *to = up(*to + up(by * off.mag()));
            }
        }
        Self { rows, rest }
    }

    /// Times an approximate inverse.
    pub(super) fn through(
        all: &[Self],
        equations: &Equations,
        inverse: &Inverse,
    ) -> Vec<Vec<Interval>> {
        let by_row = inverse.of_rows(|row| {
            let sizes = equations.acting.iter().flat_map(|acting| {
                let ends = equations.ends[acting.spans.clone()].iter();
                let pulls = ends.flat_map(|ends| pull(equations, row, *ends));
                pulls.map(Interval::mag).chain([row[acting.force].abs()])
            });
            let sizes: Vec<f64> = sizes.collect();
            all.iter().map(|change| change.times(row, &sizes)).collect::<Vec<_>>()
        });
        let number = |k: usize| by_row.iter().map(|all| all[k]).collect();
        (0..all.len()).map(number).collect()
    }

    fn times(&self, row: &[f64], sizes: &[f64]) -> Interval {
        let pairs = row.iter().zip(&self.rows).filter(|(_, part)| **part != Interval::ZERO);
        let exact: Interval = pairs.map(|(x, part)| part.times(*x)).sum();
        let rest = sizes.iter().zip(&self.rest);
        exact + Interval::around(0.0, rest.fold(0.0, |all, (size, by)| up(all + up(size * by))))
    }
}

/// A row of an inverse over the balances, for a unit of the pull of a span.
fn pull(equations: &Equations, row: &[f64], [a, b]: [usize; 2]) -> Vector {
    let at = |joint: usize| {
        let joint = &equations.joints[joint];
        let axes = joint.axes.iter().enumerate();
        axes.fold(NOWHERE, |all, (k, axis)| {
            plus(all, times(Interval::point(row[joint.first + k]), *axis))
        })
    };
    minus(at(a), at(b))
}
