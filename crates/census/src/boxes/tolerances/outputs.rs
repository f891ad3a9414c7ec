//! What is asked of an equilibrium, and how it changes with a number.

use model::system::{Kind, System};
use numerics::Interval;

use super::super::activity::Activity;
use super::super::arithmetic::{
    NOWHERE, Vector, difference, dot, minus, norm, over, product, squared, sum,
};
use super::super::equations::{Acting, Equations};
use super::Depth;
use super::numbers::Effect;
use super::region::{Region, Step};

/// One number of an equilibrium, in units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Output {
    /// A coordinate of a joint.
    Place(usize, usize),
    /// The axial force of a member that acts, by its number among them.
    Axial(usize),
    /// A component of the force of the ground on a joint.
    Reaction(usize, usize),
    /// How far a member is on the side on which it is slack.
    Spare(usize),
    /// How deep a joint is below a line.
    Depth(Depth),
}

/// All that is asked.
pub(super) fn outputs(
    system: &System,
    equations: &Equations,
    activities: &[Activity],
    depths: &[Depth],
) -> Vec<Output> {
    let joints = 0..system.joints().len();
    let axes = |joint: usize| (0..3).map(move |axis| (joint, axis));
    let held = |joint: &usize| system.joints()[*joint].support.at_m().is_some();
    let moves = |joint: &usize| !equations.joints[*joint].axes.is_empty();
    let places = joints.clone().filter(moves).flat_map(axes);
    let places = places.map(|(joint, axis)| Output::Place(joint, axis));
    let reactions = joints.filter(held).flat_map(axes);
    let reactions = reactions.map(|(joint, axis)| Output::Reaction(joint, axis));
    let axial = (0..equations.acting.len()).map(Output::Axial);
    let spare = system.members().iter().enumerate().filter(|(k, member)| {
        activities[*k] == Activity::Slack
            || activities[*k] == Activity::Idle && member.stiffness_n.is_none()
    });
    let spare = spare.map(|(k, _)| Output::Spare(k));
    let depths = depths.iter().copied().map(Output::Depth);
    places.chain(axial).chain(reactions).chain(spare).chain(depths).collect()
}

/// A region, with the equations over the numbers that go with it.
pub(super) struct Over<'a> {
    pub(super) system: &'a System,
    pub(super) equations: &'a Equations,
    pub(super) region: &'a Region,
}

impl Over<'_> {
    /// 1 where a member is slack when it is shorter than its length, -1 where it is when it is longer; 0 if it is never slack.
    fn side(&self, member: usize) -> Interval {
        match self.system.members()[member].kind {
            Kind::Bar => Interval::ZERO,
            Kind::Cable => Interval::ONE,
            Kind::Strut => -Interval::ONE,
        }
    }

    pub(super) fn value(&self, output: Output) -> Interval {
        match output {
            Output::Place(joint, axis) => self.region.places[joint][axis],
            Output::Axial(k) => {
                let acting = &self.equations.acting[k];
                acting.axial(self.region.unknowns[acting.force])
            }
            Output::Reaction(joint, axis) => {
                let pull = |(acting, span, sign): (&Acting, usize, Interval)| {
                    let direction = acting.direction(self.region.spans[span]);
                    product(
                        sign,
                        product(self.region.unknowns[acting.force], direction.along[axis]),
                    )
                };
                let load = self.equations.loads[joint][axis];
                -at(self.equations, joint).map(pull).fold(load, sum)
            }
            Output::Spare(member) => {
                let reach = self.region.reach(self.equations.spans[member].clone());
                product(self.side(member), difference(self.equations.lengths[member], reach))
            }
            Output::Depth(depth) => {
                let line = Line::new(&self.region.places, depth);
                difference(product(line.part, line.span[2]), line.off[2])
            }
        }
    }

    /// The change of an output with a number of this effect, where the unknowns and places change by `step`.
    pub(super) fn slope(&self, output: Output, effect: &Effect, step: &Step) -> Interval {
        match output {
            Output::Place(joint, axis) => step.moves[joint][axis],
            Output::Axial(k) => {
                let acting = &self.equations.acting[k];
                let by = acting.axial(step.unknowns[acting.force]);
                // A force density acts on the length that changes.
                let longer = effect.lengthened.filter(|(longer, _)| *longer == acting.member);
                match longer.filter(|_| acting.is_squared()) {
                    Some((_, longer)) => {
                        sum(by, product(self.region.unknowns[acting.force], longer))
                    }
                    None => by,
                }
            }
            Output::Reaction(joint, axis) => {
                let loads = effect.forces.iter().filter(|(at, _)| *at == joint);
                let loads = loads.map(|(_, force)| force[axis]).fold(Interval::ZERO, sum);
                let pulls = at(self.equations, joint).map(|(acting, span, sign)| {
                    let stretch = step.stretch(self.equations.ends[span]);
                    product(sign, self.region.pull(acting, span, step, stretch)[axis])
                });
                -pulls.fold(loads, sum)
            }
            Output::Spare(k) => {
                let along = self.equations.spans[k].clone().map(|span| {
                    let (stretch, span) =
                        (step.stretch(self.equations.ends[span]), self.region.spans[span]);
                    dot(over(span, norm(span)), stretch)
                });
                let along = along.fold(Interval::ZERO, sum);
                let longer = effect.lengthened.filter(|(longer, _)| *longer == k);
                let longer = longer.map_or(Interval::ZERO, |(_, by)| by);
                product(self.side(k), sum(longer, -along))
            }
            Output::Depth(depth) => {
                let line = Line::new(&self.region.places, depth);
                let [off, span] = Line::ways(&step.moves, depth);
                let turned = product(line.part, dot(level(line.span), level(span))).scale(2.0);
                let moved = sum(dot(level(off), line.span), dot(level(line.off), span));
                let part = line.over_size(difference(moved, turned));
                let raised = sum(product(part, line.span[2]), product(line.part, span[2]));
                difference(raised, off[2])
            }
        }
    }
}

/// A joint beside a line.
struct Line {
    /// From the first end of the line to the joint, and to the other end.
    off: Vector,
    span: Vector,
    /// At which part of the line it is in plan; 0 of a line that is a point.
    part: Interval,
}

impl Line {
    fn new(places: &[Vector], depth: Depth) -> Self {
        let [off, span] = Self::ways(places, depth);
        let mut line = Self { off, span, part: Interval::ZERO };
        line.part = line.over_size(dot(level(off), span));
        line
    }

    /// Both ways of places, or of what moves them.
    fn ways(of: &[Vector], Depth { joint, ends: [a, b] }: Depth) -> [Vector; 2] {
        [joint, b].map(|to| if to == a { NOWHERE } else { minus(of[to], of[a]) })
    }

    /// A product with the line in plan, over the square of its size.
    fn over_size(&self, product: Interval) -> Interval {
        if product == Interval::ZERO { product } else { product / squared(level(self.span)) }
    }
}

/// In plan.
fn level([x, y, _]: Vector) -> Vector {
    [x, y, Interval::ZERO]
}

/// The spans of the members that act on a joint, with 1 where they begin there and -1 where they end.
fn at(equations: &Equations, joint: usize) -> impl Iterator<Item = (&Acting, usize, Interval)> {
    let spans = equations.acting.iter();
    let spans = spans.flat_map(|acting| acting.spans.clone().map(move |span| (acting, span)));
    spans.filter_map(move |(acting, span)| match equations.ends[span] {
        [a, _] if a == joint => Some((acting, span, Interval::ONE)),
        [_, b] if b == joint => Some((acting, span, -Interval::ONE)),
        _ => None,
    })
}
