//! Equilibria around a plane through one of them, and the derivative there, member by member.
//!
//! Neighbours move alike: the range of a span is far narrower than those of its ends together. And the force
//! of a member pulls its ends opposite ways, while the rows of an inverse hardly differ from joint to
//! joint: what varies is therefore kept apart for each member.

use numerics::{Interval, up};

use super::super::arithmetic::{
    NOWHERE, Vector, difference, dot, minus, plus, product, sum, times,
};
use super::super::equations::{Acting, Equations};
use super::super::inverse::{Defect, Inverse};
use super::numbers::Effect;

/// Ranges of unknowns, and of the spans of all members.
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

/// All points $\tilde x + S \delta + r$ with each number in its part and $|r|$ within the room.
pub(super) struct Plane<'a> {
    pub(super) ends: &'a [[usize; 2]],
    pub(super) middle: &'a [Interval],
    pub(super) steps: &'a [Step],
    /// The numbers less those of the middle.
    pub(super) offs: &'a [Interval],
}

impl Region {
    /// Of points that are independent of each other.
    pub(super) fn new(equations: &Equations, ends: &[[usize; 2]], unknowns: Vec<Interval>) -> Self {
        let places = equations.places(&unknowns);
        let spans = ends.iter().map(|[a, b]| minus(places[*b], places[*a])).collect();
        Self { unknowns, places, spans }
    }

    /// Around a plane, whose middle has these equations.
    pub(super) fn around(fixed: &Equations, plane: &Plane<'_>, room: &[f64]) -> Self {
        let mut found = Self::new(fixed, plane.ends, plane.middle.to_vec());
        let room = room.iter().map(|by| Interval::around(0.0, *by)).collect();
        let rest = Step::new(fixed, &Effect::default(), room);
        let all = plane.steps.iter().zip(plane.offs.iter().copied());
        for (step, off) in all.chain([(&rest, Interval::ONE)]) {
            let add = |to: &mut Interval, by: &Interval| *to = sum(*to, product(*by, off));
            let add_all = |to: &mut Vector, by: Vector| {
                to.iter_mut().zip(&by).for_each(|(to, by)| add(to, by));
            };
            found.unknowns.iter_mut().zip(&step.unknowns).for_each(|(to, by)| add(to, by));
            found.places.iter_mut().zip(&step.moves).for_each(|(to, by)| add_all(to, *by));
            let spans = found.spans.iter_mut().zip(plane.ends);
            spans.for_each(|(to, ends)| add_all(to, step.stretch(*ends)));
        }
        found
    }

    /// Span and force density of a member that acts.
    fn of(&self, acting: &Acting) -> (Vector, Interval) {
        (self.spans[acting.member], self.unknowns[acting.density])
    }

    /// Bounds of $|I - Y F_x|$.
    pub(super) fn defect(&self, equations: &Equations, inverse: &Inverse) -> Defect {
        let mut others = vec![];
        equations.slope_of_holds(&mut others);
        inverse.defect_by(|row, rest| {
            let mut take =
                |column: usize, by: Interval| rest[column] = difference(rest[column], by);
            for (acting, pull) in equations.acting.iter().zip(pulls(equations, row)) {
                let (span, density) = self.of(acting);
                let law = row[acting.density];
                let give = acting.give(span).times(law);
                take(acting.density, sum(dot(pull, span), give));
                let along = acting.gradient(span, density).map(|part| part.times(law));
                let by_span = plus(times(density, pull), along);
                for (joint, by) in acting.ends.into_iter().zip([by_span.map(|x| -x), by_span]) {
                    let joint = &equations.joints[joint];
                    for (k, axis) in joint.axes.iter().enumerate() {
                        take(joint.first + k, dot(*axis, by));
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
        let mut rest = Vec::with_capacity(equations.acting.len());
        let add = |joint: usize, force: Vector, rows: &mut Vec<Interval>| {
            let joint = &equations.joints[joint];
            for (k, axis) in joint.axes.iter().enumerate() {
                rows[joint.first + k] = sum(rows[joint.first + k], dot(*axis, force));
            }
        };
        for acting in &equations.acting {
            let (span, density) = self.of(acting);
            let (by, stretch) = (step.unknowns[acting.density], step.stretch(acting.ends));
            let pull = plus(times(by, span), times(density, stretch));
            let law = dot(acting.gradient(span, density), stretch);
            let law = sum(sum(law, product(acting.give(span), by)), rows[acting.density]);
            let middle = pull.map(|part| Interval::point(part.mid()));
            add(acting.ends[0], middle, &mut rows);
            add(acting.ends[1], middle.map(|part| -part), &mut rows);
            rows[acting.density] = Interval::point(law.mid());
            rest.push([pull[0].rad(), pull[1].rad(), pull[2].rad(), law.rad()]);
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

/// Changes of the left-hand sides: for each row, and what may be more or less in the pull and the law of each
/// member that acts.
pub(super) struct Change {
    pub(super) rows: Vec<Interval>,
    rest: Vec<[f64; 4]>,
}

impl Change {
    /// The size of each row and of the rest, of all changes times their numbers.
    pub(super) fn total(all: &[Self], offs: &[Interval]) -> Self {
        let size = all.first().map_or(0, |change| change.rows.len());
        let members = all.first().map_or(0, |change| change.rest.len());
        let (mut rows, mut rest) = (vec![Interval::ZERO; size], vec![[0.0; 4]; members]);
        for (change, off) in all.iter().zip(offs) {
            for (to, by) in rows.iter_mut().zip(&change.rows) {
                *to = sum(*to, Interval::around(0.0, product(*by, *off).mag()));
            }
            for (to, by) in rest.iter_mut().flatten().zip(change.rest.iter().flatten()) {
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
            let sizes: Vec<[f64; 4]> = equations
                .acting
                .iter()
                .zip(pulls(equations, row))
                .map(|(acting, [x, y, z])| [x.mag(), y.mag(), z.mag(), row[acting.density].abs()])
                .collect();
            all.iter().map(|change| change.times(row, &sizes)).collect::<Vec<_>>()
        });
        let number = |k: usize| by_row.iter().map(|all| all[k]).collect();
        (0..all.len()).map(number).collect()
    }

    fn times(&self, row: &[f64], sizes: &[[f64; 4]]) -> Interval {
        let pairs = row.iter().zip(&self.rows).filter(|(_, part)| **part != Interval::ZERO);
        let exact: Interval = pairs.map(|(x, part)| part.times(*x)).sum();
        let rest = sizes.iter().flatten().zip(self.rest.iter().flatten());
        exact + Interval::around(0.0, rest.fold(0.0, |all, (size, by)| up(all + up(size * by))))
    }
}

/// A row of an inverse over the balances, for a unit of the pull of each member that acts.
fn pulls(equations: &Equations, row: &[f64]) -> Vec<Vector> {
    let at = |joint: usize| {
        let joint = &equations.joints[joint];
        let axes = joint.axes.iter().enumerate();
        axes.fold(NOWHERE, |all, (k, axis)| {
            plus(all, times(Interval::point(row[joint.first + k]), *axis))
        })
    };
    equations.acting.iter().map(|acting| minus(at(acting.ends[0]), at(acting.ends[1]))).collect()
}
