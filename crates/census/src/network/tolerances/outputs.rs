//! What is asked of an equilibrium, and how it changes with a number.

use model::system::{Kind, System};
use numerics::Interval;

use super::super::activity::Activity;
use super::super::arithmetic::{difference, dot, norm, product, sum};
use super::super::equations::{Acting, Equations};
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
}

/// All that is asked.
pub(super) fn outputs(
    system: &System,
    equations: &Equations,
    activities: &[Activity],
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
    places.chain(axial).chain(reactions).chain(spare.map(|(k, _)| Output::Spare(k))).collect()
}

/// A region, with the equations over the numbers that go with it.
pub(super) struct Over<'a> {
    pub(super) system: &'a System,
    pub(super) equations: &'a Equations,
    pub(super) region: &'a Region,
}

impl Over<'_> {
    /// 1 where a member is slack when it is shorter than its length, -1 where it is when it is longer; 0 never.
    fn side(&self, member: usize) -> Interval {
        match self.system.members()[member].kind {
            Kind::Bar => Interval::ZERO,
            Kind::Cable => Interval::ONE,
            Kind::Strut => -Interval::ONE,
        }
    }

    /// The value of an output.
    pub(super) fn value(&self, output: Output) -> Interval {
        match output {
            Output::Place(joint, axis) => self.region.places[joint][axis],
            Output::Axial(k) => {
                let acting = &self.equations.acting[k];
                self.pull(acting) / self.shrink(acting)
            }
            Output::Reaction(joint, axis) => {
                let pull = |(acting, sign): (&Acting, Interval)| {
                    let pull = product(
                        self.region.unknowns[acting.density],
                        self.region.spans[acting.member][axis],
                    );
                    product(sign, pull)
                };
                let load = self.equations.loads[joint][axis];
                -at(self.equations, joint).map(pull).fold(load, sum)
            }
            Output::Spare(member) => {
                let distance = norm(self.region.spans[member]);
                product(self.side(member), difference(self.equations.lengths[member], distance))
            }
        }
    }

    /// $w l$.
    fn pull(&self, acting: &Acting) -> Interval {
        product(self.region.unknowns[acting.density], acting.length)
    }

    /// $1 - c w = l/|d|$.
    fn shrink(&self, acting: &Acting) -> Interval {
        acting.shrink(self.region.unknowns[acting.density])
    }

    /// The change of an output with a number of this effect, where the unknowns and places change by `step`.
    pub(super) fn slope(&self, output: Output, effect: &Effect, step: &Step) -> Interval {
        match output {
            Output::Place(joint, axis) => step.moves[joint][axis],
            Output::Axial(k) => {
                let acting = &self.equations.acting[k];
                self.slope_of_axial(acting, effect, step.unknowns[acting.density])
            }
            Output::Reaction(joint, axis) => {
                let loads = effect.forces.iter().filter(|(at, _)| *at == joint);
                let loads = loads.map(|(_, force)| force[axis]).fold(Interval::ZERO, sum);
                let pulls = at(self.equations, joint).map(|(acting, sign)| {
                    let span = self.region.spans[acting.member][axis];
                    let turned = step.stretch(acting.ends)[axis];
                    let turned = product(self.region.unknowns[acting.density], turned);
                    product(sign, sum(product(step.unknowns[acting.density], span), turned))
                });
                -pulls.fold(loads, sum)
            }
            Output::Spare(k) => {
                let (member, span) = (&self.system.members()[k], self.region.spans[k]);
                let along = dot(span, step.stretch([member.from, member.to])) / norm(span);
                let longer = effect.lengthened.filter(|(longer, _)| *longer == k);
                let longer = longer.map_or(Interval::ZERO, |(_, by)| by);
                product(self.side(k), sum(longer, -along))
            }
        }
    }

    /// Of $N = w l/(1 - c w)$, which is $EA (|d| - l)/l$.
    fn slope_of_axial(&self, acting: &Acting, effect: &Effect, by: Interval) -> Interval {
        let own = |of: Option<(usize, Interval)>| of.filter(|(k, _)| *k == acting.member);
        let density = self.region.unknowns[acting.density];
        let mut pull = product(by, acting.length);
        if let Some((_, longer)) = own(effect.lengthened) {
            pull = sum(pull, product(density, longer));
        }
        if let Some((_, part)) = own(effect.stiffened) {
            let softer = product(product(acting.compliance, density), part);
            pull = sum(pull, -product(self.pull(acting), softer));
        }
        if acting.is_rigid() { pull } else { pull / self.shrink(acting).square() }
    }
}

/// The members that act on a joint, with 1 where they begin there and -1 where they end.
fn at(equations: &Equations, joint: usize) -> impl Iterator<Item = (&Acting, Interval)> {
    let sign = move |acting: &Acting| match acting.ends {
        [a, _] if a == joint => Some(Interval::ONE),
        [_, b] if b == joint => Some(-Interval::ONE),
        _ => None,
    };
    equations.acting.iter().filter_map(move |acting| Some((acting, sign(acting)?)))
}
