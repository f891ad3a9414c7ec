//! Answers for one system held against each other, and each against Newton's laws.

use model::system::{System, SystemEquilibrium};
use model::{
    Agreed, Disagreement, Excess, NoAnswer, Optimal, Quantity, Reason, Room, SolverName, Status,
    Vector,
};
use serde::Serialize;

use super::certificate::{certify, largest_force_n, size_m, total_load_n};
use super::family::Family;
use super::free::free_joints;
use super::statics::{SystemStatics, judge};
use super::turn::turned_onto;
use crate::compare::{Verdict, other_has_none, with_sentences};
use crate::tolerances::Tolerances;
use crate::vector::{minus, norm, plus, worse};

/// How far answers agree: the object `agreement` of the JSON. Of more than two, the largest
/// differences of any two.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SystemAgreement {
    /// Largest distance of a joint in one answer from the same joint in another, m. Parts that turn
    /// freely about a vertical, through an anchor or another joint, are turned onto each other
    /// first.
    pub joints_m: f64,
    /// Largest difference of a force at an end of a member or of a support, N; where the forces are
    /// a family, of what is not a self-stress in the difference.
    pub forces_n: f64,
    /// Largest difference of the energies, J.
    pub energy_j: f64,
    /// Joints without load whose members are proved to bear no force, and which these let move:
    /// their places are judged by the members' laws alone.
    pub free_joints: usize,
    /// Parts that turn freely about verticals and were turned onto each other before the answers
    /// were compared; a part may hang on another one that turns.
    pub turned_parts: usize,
    /// Independent self-stresses of the shape: with any, the forces are one of a family, and that
    /// both answers name the same of them is no evidence. Nothing where the system is too large to
    /// count them.
    pub self_stresses: Option<usize>,
    /// Violations of geometry and of Newton's laws by each answer.
    pub statics: Vec<SystemStatics>,
    /// Whether all of these are within their budgets.
    pub verdict: Verdict,
    /// What speaks against it.
    #[serde(flatten, serialize_with = "with_sentences")]
    pub disagreement: Disagreement,
}

impl SystemAgreement {
    /// Whether the answers are one.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.verdict == Verdict::Agreed
    }
}

/// What differences are held against, and what was found.
struct Judgement<'a> {
    system: &'a System,
    tolerances: &'a Tolerances,
    length_m: f64,
    force_n: f64,
    energy_j: f64,
    free: Vec<bool>,
    /// The self-stresses of the first answer's shape.
    family: Option<Family>,
    agreement: SystemAgreement,
}

/// Hold answers against each other, every two of them, and each against Newton's laws, and write
/// what that proves into their evidence: `agreed`, and `optimal` where a certificate exists.
///
/// # Panics
///
/// When there are fewer than two answers: one alone is judged by [`judge_alone`].
#[must_use]
pub fn compare(
    system: &System,
    answers: &mut [SystemEquilibrium],
    tolerances: &Tolerances,
) -> SystemAgreement {
    assert!(answers.len() >= 2, "{} answers cannot be compared", answers.len());
    let agreement = Judgement::new(system, answers, tolerances).run(answers);
    let rung = if agreement.agrees() {
        Status::Reached(Agreed {
            solvers: answers.iter().map(|answer| answer.solver.clone()).collect(),
            joints_m: agreement.joints_m,
            forces_n: agreement.forces_n,
            energy_j: agreement.energy_j,
            statics: agreement.statics.iter().map(SystemStatics::largest).fold(0.0, worse),
            free_joints: None,
            room: Room::of(agreement.turned_parts, agreement.free_joints),
            shape_only: agreement.self_stresses.is_some_and(|dimension| dimension > 0),
            curvature_undecided: Vec::new(),
        })
    } else {
        Status::Open(Reason::SolversDisagree(agreement.disagreement.clone()))
    };
    for answer in answers {
        answer.evidence.ladder.agreed = rung.clone();
        certify_rung(system, answer);
    }
    agreement
}

/// Judge one answer that has no second to compare with.
pub fn judge_alone(system: &System, answer: &mut SystemEquilibrium) -> SystemStatics {
    let (tolerances, alone) = (Tolerances::project(), std::slice::from_ref(&*answer));
    let found = Judgement::new(system, alone, &tolerances).run(alone);
    let statics = judge(system, answer);
    let excesses = found.disagreement.excesses;
    answer.evidence.ladder.agreed = Status::Open(if excesses.is_empty() {
        Reason::OneSolverOnly { solver: answer.solver.clone(), statics: statics.largest() }
    } else {
        Reason::JudgeRefuses { excesses }
    });
    certify_rung(system, answer);
    statics
}

/// Judge one answer where another solver was asked and has none.
pub fn judge_without(
    system: &System,
    answer: &mut SystemEquilibrium,
    other: SolverName,
    because: NoAnswer,
) -> SystemStatics {
    let judged = judge_alone(system, answer);
    other_has_none(&mut answer.evidence.ladder, other, because);
    judged
}

/// The rungs above `agreed`.
fn certify_rung(system: &System, answer: &mut SystemEquilibrium) {
    let optimal = match certify(system, answer) {
        Ok(proof) => Status::Reached(proof),
        Err(because) => match certify_row(system, answer) {
            Some(proof) => Status::Reached(proof),
            None => Status::Open(Reason::NoCertificate(because)),
        },
    };
    let ladder = &mut answer.evidence.ladder;
    // Proofs in intervals are asked for apart.
    ladder.verified = Status::Open(Reason::NotTried);
    ladder.complete = Status::Open(Reason::NotTried);
    ladder.optimal = optimal;
}

/// The certificate of a row between two anchors, which bounds what a bar in compression costs where the whole row turns about a vertical.
fn certify_row(system: &System, answer: &SystemEquilibrium) -> Option<Optimal> {
    let row = system.as_row()?;
    let found = row.chain_equilibrium(answer)?;
    crate::certificate::certify(row.problem(), &found).ok().map(|proof| proof.proof())
}

impl<'a> Judgement<'a> {
    fn new(system: &'a System, answers: &[SystemEquilibrium], tolerances: &'a Tolerances) -> Self {
        let size_m = answers.iter().map(|answer| size_m(system, answer)).fold(0.0, worse);
        let force_n = answers.iter().map(largest_force_n).fold(total_load_n(system), worse);
        Self {
            system,
            tolerances,
            length_m: size_m,
            force_n,
            energy_j: if system.is_unloaded() { force_n } else { total_load_n(system) } * size_m,
            free: free_joints(system, answers),
            family: None,
            agreement: SystemAgreement {
                joints_m: 0.0,
                forces_n: 0.0,
                energy_j: 0.0,
                free_joints: 0,
                turned_parts: 0,
                self_stresses: None,
                statics: Vec::new(),
                verdict: Verdict::Agreed,
                disagreement: Disagreement::default(),
            },
        }
    }

    fn run(mut self, answers: &[SystemEquilibrium]) -> SystemAgreement {
        self.agreement.free_joints = self.free.iter().filter(|free| **free).count();
        for (k, first) in answers.iter().enumerate() {
            self.family = Family::of(self.system, first);
            if k == 0 {
                self.agreement.self_stresses = self.family.as_ref().map(Family::dimension);
            }
            self.named(first);
            for second in &answers[k + 1..] {
                self.pair(first, second);
            }
        }
        for answer in answers {
            let statics = judge(self.system, answer);
            let (solver, place) = (answer.solver.clone(), statics.worst);
            let budget = self.tolerances.statics.value;
            self.hold(Quantity::SystemStatics { solver, place }, statics.largest(), budget);
            self.agreement.statics.push(statics);
        }
        if !self.agreement.disagreement.is_empty() {
            self.agreement.verdict = Verdict::Disagreed;
        }
        self.agreement
    }

    fn hold(&mut self, what: Quantity, value: f64, budget: f64) {
        // NaN is over every budget.
        if value.is_nan() || value > budget {
            self.agreement.disagreement.excesses.push(Excess { what, value, budget });
        }
    }

    /// The self-stresses that an answer names are in balance without any load.
    fn named(&mut self, answer: &SystemEquilibrium) {
        let (Some(family), Some(named)) = (&self.family, &answer.evidence.self_stresses) else {
            return;
        };
        let members = self.system.members().len();
        let left = |stress: &Vec<f64>| {
            if stress.len() == members {
                family.left_by(self.system, stress).into_iter().map(f64::abs).fold(0.0, worse)
            } else {
                f64::NAN
            }
        };
        let left = named.basis.iter().map(left).fold(0.0, worse);
        let solver = answer.solver.clone();
        // As small as the solver's own threshold, which is the judge's at a shape apart by
        // rounding.
        let budget = 2.0 * family.rounding;
        self.hold(Quantity::SelfStresses { solver }, left, budget);
    }

    /// Two answers: their differences, and their second-order behaviour.
    fn pair(&mut self, first: &SystemEquilibrium, second: &SystemEquilibrium) {
        let (turned, parts) = turned_onto(self.system, first, second, &self.free);
        let joints_m = self.joints_apart_m(first, &turned);
        let forces_n = self.forces_apart_n(first, &turned);
        let energy_j = (first.energy_j - second.energy_j).abs();
        let agreement = &mut self.agreement;
        agreement.joints_m = worse(agreement.joints_m, joints_m);
        agreement.forces_n = worse(agreement.forces_n, forces_n);
        agreement.energy_j = worse(agreement.energy_j, energy_j);
        agreement.turned_parts = agreement.turned_parts.max(parts);
        let between = [&first.solver, &second.solver].map(SolverName::clone);
        let tolerances = self.tolerances;
        let budget = tolerances.joints.value * self.length_m;
        self.hold(Quantity::Joints { between: between.clone() }, joints_m, budget);
        let budget = tolerances.forces.value * self.force_n;
        self.hold(Quantity::Forces { between: between.clone() }, forces_n, budget);
        let budget = tolerances.energy.value * self.energy_j;
        self.hold(Quantity::Energy { between: between.clone() }, energy_j, budget);
        let indices = [first.stability.index_in_space, second.stability.index_in_space];
        self.hold(Quantity::MorseIndex { between }, indices[0].abs_diff(indices[1]) as f64, 0.0);
    }

    fn joints_apart_m(&self, first: &SystemEquilibrium, second: &SystemEquilibrium) -> f64 {
        let joints = self.free.len();
        if [first.joints_m.len(), second.joints_m.len()] != [joints; 2] {
            return f64::NAN;
        }
        let held = (0..joints).filter(|k| !self.free[*k]);
        held.map(|k| norm(minus(first.joints_m[k], second.joints_m[k]))).fold(0.0, worse)
    }

    /// The largest difference of forces that is not a self-stress.
    fn forces_apart_n(&self, first: &SystemEquilibrium, second: &SystemEquilibrium) -> f64 {
        let members = self.system.members();
        let joints = self.free.len();
        let counts = |answer: &SystemEquilibrium| {
            let of_members =
                [&answer.start_forces_n, &answer.end_forces_n].map(Vec::len) == [members.len(); 2];
            of_members
                && answer.axial_n.len() == members.len()
                && answer.reactions_n.len() == joints
        };
        if !counts(first) || !counts(second) {
            return f64::NAN;
        }
        let part = self.self_stress_between(first, second);
        let mut apart = 0.0;
        let mut reactions: Vec<Vector> =
            (0..joints).map(|k| minus(first.reactions_n[k], second.reactions_n[k])).collect();
        for (k, member) in members.iter().enumerate() {
            let pull = match (&self.family, &part) {
                (Some(family), Some(part)) if part[k].abs() > 0.0 => family.pull(k, part[k]),
                _ => [0.0; 3],
            };
            // The joints pull at the member's ends, outwards.
            let start = minus(first.start_forces_n[k], second.start_forces_n[k]);
            let end = minus(first.end_forces_n[k], second.end_forces_n[k]);
            apart = worse(apart, norm(plus(start, pull)));
            apart = worse(apart, norm(minus(end, pull)));
            reactions[member.from] = plus(reactions[member.from], pull);
            reactions[member.to] = minus(reactions[member.to], pull);
        }
        reactions.into_iter().map(norm).fold(apart, worse)
    }

    /// The part of the difference of the axial forces that is a self-stress, where there is any.
    fn self_stress_between(
        &self,
        first: &SystemEquilibrium,
        second: &SystemEquilibrium,
    ) -> Option<Vec<f64>> {
        let family = self.family.as_ref().filter(|family| family.dimension() > 0)?;
        let apart: Vec<f64> =
            first.axial_n.iter().zip(&second.axial_n).map(|(a, b)| a - b).collect();
        Some(family.part_of(&apart))
    }
}
