//! Forces of two answers held against each other: what differs apart from self-stresses, which forces
//! of a family they name, and whether they exceed all that acts on the system.

use model::system::{System, SystemEquilibrium};
use model::{Choices, ForceChoice, LargeForce, Vector};

use super::family::Family;
use super::scale::Scale;
use super::spans::span_forces;
use numerics::vector::{minus, norm, plus, times, worse};

/// Forces of this many times all that acts on the system are a finding of their own: the shape is
/// nearly singular.
const LARGE: f64 = 1e6;
/// Forces of this many times all that acts are no answer. In balance they would need directions that
/// differ by less than 1e-9 from those of a singular shape, which is one to the accuracy of lengths
/// ([`LENGTH_ROUNDING`](model::system::LENGTH_ROUNDING)).
pub(crate) const ABSURD: f64 = 1e9;

/// A difference, and what it may be where it is the largest part of that, N.
#[derive(Clone, Copy)]
#[expect(clippy::struct_field_names, reason = "the unit of each")]
pub(super) struct Apart {
    /// The largest difference.
    pub most_n: f64,
    /// The difference that exceeds its budget most, or comes nearest to it.
    pub value_n: f64,
    pub budget_n: f64,
}

impl Apart {
    /// No difference, of forces that may differ by this.
    fn none(budget_n: f64) -> Self {
        Self { most_n: 0.0, value_n: 0.0, budget_n }
    }

    /// The difference of answers that are incomplete.
    fn unknown() -> Self {
        Self { most_n: f64::NAN, value_n: f64::NAN, budget_n: 0.0 }
    }

    fn note(&mut self, value_n: f64, budget_n: f64) {
        self.most_n = worse(self.most_n, value_n);
        // NaN exceeds every budget.
        if value_n.is_nan() || value_n * self.budget_n > self.value_n * budget_n {
            (self.value_n, self.budget_n) = (value_n, budget_n);
        }
    }
}

/// Two complete answers and what their forces are measured by.
pub(super) struct Pair<'a> {
    pub system: &'a System,
    pub answers: [&'a SystemEquilibrium; 2],
    pub scale: &'a Scale,
    /// What forces may differ by, in units of what they are measured by.
    pub tolerance: f64,
    /// The self-stresses of the first answer's shape.
    pub family: Option<&'a Family>,
}

impl Pair<'_> {
    fn is_complete(&self) -> bool {
        let (members, joints) = (self.system.members().len(), self.system.joints().len());
        self.answers.iter().all(|answer| {
            let of_members = [answer.start_forces_n.len(), answer.end_forces_n.len()];
            of_members == [members; 2]
                && answer.axial_n.len() == members
                && answer.reactions_n.len() == joints
        })
    }

    /// What the forces at each joint may differ by, N: those of an answer count that has the smaller
    /// ones.
    fn budgets_n(&self) -> Vec<f64> {
        let largest = |answer: &SystemEquilibrium| {
            let mut most_n: Vec<f64> = answer.reactions_n.iter().map(|f| norm(*f)).collect();
            for (k, member) in self.system.members().iter().enumerate() {
                for (joints, forces) in span_forces(member, k, answer) {
                    for (joint, force) in joints.into_iter().zip(forces) {
                        most_n[joint] = most_n[joint].max(norm(force));
                    }
                }
            }
            most_n
        };
        let [first, second] = self.answers.map(largest);
        let meet = first.into_iter().zip(second).map(|(a, b)| a.min(b));
        meet.map(|meet_n| self.tolerance * self.scale.of_forces_n(meet_n)).collect()
    }

    /// The largest difference of forces that is not a self-stress.
    pub(super) fn apart(&self) -> Apart {
        if !self.is_complete() {
            return Apart::unknown();
        }
        let [first, second] = self.answers;
        let part = self.self_stress_between();
        let budgets_n = self.budgets_n();
        let mut apart = Apart::none(self.tolerance * self.scale.of_forces_n(0.0));
        let mut reactions: Vec<Vector> =
            first.reactions_n.iter().zip(&second.reactions_n).map(|(a, b)| minus(*a, *b)).collect();
        for (k, member) in self.system.members().iter().enumerate() {
            let stress = match (self.family, &part) {
                (Some(family), Some(part)) if part[k].abs() > 0.0 => Some((family, part[k])),
                _ => None,
            };
            let pull = stress.map_or([[0.0; 3]; 2], |(family, part)| family.pull(k, part));
            // The joints pull at the member's ends, outwards.
            let start = minus(first.start_forces_n[k], second.start_forces_n[k]);
            let end = minus(first.end_forces_n[k], second.end_forces_n[k]);
            let budget_n = budgets_n[member.from].max(budgets_n[member.to]);
            apart.note(norm(plus(start, pull[0])), budget_n);
            apart.note(norm(plus(end, pull[1])), budget_n);
            let pulls = stress.into_iter().flat_map(|(family, part)| {
                family.pulls(member, k).map(move |(joint, along)| (joint, times(part, along)))
            });
            for (joint, pull) in pulls {
                reactions[joint] = plus(reactions[joint], pull);
            }
        }
        for (reaction, budget_n) in reactions.into_iter().zip(budgets_n) {
            apart.note(norm(reaction), budget_n);
        }
        apart
    }

    /// The part of the difference of the axial forces that is a self-stress, where there is any.
    fn self_stress_between(&self) -> Option<Vec<f64>> {
        let family = self.family.filter(|family| !family.basis().is_empty())?;
        let [first, second] = self.answers;
        let apart = first.axial_n.iter().zip(&second.axial_n).map(|(a, b)| a - b);
        Some(family.part_of(&apart.collect::<Vec<_>>()))
    }

    /// The difference of the axial forces as they are, self-stresses and all, with its member.
    fn named_apart(&self) -> (Apart, usize) {
        let [first, second] = self.answers;
        let budgets_n = self.budgets_n();
        let mut apart = Apart::none(self.tolerance * self.scale.of_forces_n(0.0));
        let mut at = 0;
        for (k, member) in self.system.members().iter().enumerate() {
            let budget_n = budgets_n[member.from].max(budgets_n[member.to]);
            let before = apart.most_n;
            apart.note((first.axial_n[k] - second.axial_n[k]).abs(), budget_n);
            if apart.most_n > before {
                at = k;
            }
        }
        (apart, at)
    }

    /// Which forces of a family the answers name: of answers that name the same ones the difference,
    /// which must not be there; of others the forces that differ most, if any do.
    pub(super) fn named(&self) -> (Option<Apart>, Option<Choices>) {
        let of_family = self.family.is_some_and(|family| !family.basis().is_empty());
        if !of_family || !self.is_complete() {
            return (None, None);
        }
        let choices = self.answers.map(choice);
        let (apart, k) = self.named_apart();
        if choices == [ForceChoice::EquallyStiff; 2] {
            return (Some(apart), None);
        }
        let differ = apart.value_n > apart.budget_n;
        let named = differ.then(|| Choices {
            between: self.answers.map(|answer| answer.solver.clone()),
            choices,
            member: k + 1,
            forces_n: self.answers.map(|answer| answer.axial_n[k]),
        });
        (None, named)
    }
}

/// Which forces of a family an answer names.
fn choice(answer: &SystemEquilibrium) -> ForceChoice {
    answer.evidence.self_stresses.as_ref().map_or(ForceChoice::Unknown, |named| named.choice)
}

/// The largest axial force of an answer, where it exceeds all that acts on the system by orders of
/// magnitude.
pub(super) fn large(answer: &SystemEquilibrium, scale: &Scale) -> Option<LargeForce> {
    let members = answer.axial_n.iter().enumerate();
    // Of equal ones the first.
    let (k, force_n) = members.rev().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let ratio = force_n.abs() / scale.held_n;
    (scale.held_n > 0.0 && ratio >= LARGE).then_some(LargeForce {
        member: k + 1,
        force_n: *force_n,
        ratio,
    })
}
