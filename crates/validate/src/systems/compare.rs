//! Answers for one system held against each other, and each against Newton's laws.

use model::system::{System, SystemEquilibrium};
use model::{
    Agreed, Disagreement, Excess, ForceChoice, ForcesFound, NoAnswer, NoCertificate, Optimal,
    Quantity, Reason, Room, SelfStresses, SolverName, Status,
};
use serde::Serialize;

use super::certificate::{certify, largest_force_n};
use super::family::{Family, has_more_lengths};
use super::forces::{ABSURD, Pair, large};
use super::free::free_joints;
use super::proved::proved;
use super::scale::Scale;
use super::sliding::sliding;
use super::statics::{SystemStatics, judge};
use super::turn::turned_onto;
use crate::certificate::certify_pulled;
use crate::tolerances::Tolerances;
use crate::verdict::{Verdict, with_sentences};
use numerics::vector::{minus, norm, worse};

/// How far answers agree: the object `agreement` of the JSON. Of more than two, the largest
/// differences of any two.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
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
    /// Parts that move freely in the level, on planes that hold nothing else, and were moved onto each other.
    #[serde(skip)]
    pub sliding_parts: usize,
    /// Names of the joints whose places equilibrium does not determine, as that of a ring without load on a taut
    /// rope: these slide from their place in one answer to that in another through equilibria with the same
    /// forces, and are not compared.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub undetermined: Vec<String>,
    /// Independent self-stresses of the shape: with any, the forces are one of a family, and that
    /// both answers name the same of them is no evidence. Without value where the system is too large
    /// to count them and no answer names any.
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
    pub fn agrees(&self) -> bool {
        self.verdict == Verdict::Agreed
    }

    /// Motions of an answer that nothing resists, to second order, besides those of what was moved onto each other.
    pub fn unresisted(&self, answer: &SystemEquilibrium) -> usize {
        let moved = self.turned_parts + 3 * (self.free_joints + self.sliding_parts);
        answer.stability.neutral.saturating_sub(moved + self.undetermined.len())
    }
}

/// What differences are held against, and what was found.
struct Judgement<'a> {
    system: &'a System,
    tolerances: &'a Tolerances,
    /// The sizes that differences are held against.
    scale: Scale,
    free: Vec<bool>,
    /// The self-stresses of the shape of the answer that others are compared with.
    family: Option<Family>,
    /// Whether balance and signs leave forces open.
    shape_only: bool,
    forces_found: ForcesFound,
    agreement: SystemAgreement,
}

/// Forces below this part of all that acts are none: a cable that bears as little is at the limit of
/// its kind.
const NO_FORCE: f64 = 1e-9;

/// Hold answers against each other, every two of them, and each against Newton's laws, and write
/// what that proves into their evidence: `agreed`, and `optimal` where a certificate exists.
///
/// # Panics
/// When there are fewer than two answers: one alone is judged by [`judge_alone`].
pub fn compare(
    system: &System,
    answers: &mut [SystemEquilibrium],
    tolerances: &Tolerances,
) -> SystemAgreement {
    assert!(answers.len() >= 2, "{} answers cannot be compared", answers.len());
    let Judgement { agreement, shape_only, mut forces_found, .. } =
        Judgement::new(system, answers, tolerances).run(answers);
    forces_found.proved = proved(system, &answers[0]);
    let rung = if agreement.agrees() {
        Status::Reached(Agreed {
            solvers: answers.iter().map(|answer| answer.solver.clone()).collect(),
            joints_m: agreement.joints_m,
            forces_n: agreement.forces_n,
            energy_j: agreement.energy_j,
            statics: agreement.statics.iter().map(SystemStatics::largest).fold(0.0, worse),
            room: Room::of(
                agreement.turned_parts + agreement.sliding_parts,
                agreement.free_joints,
                agreement.undetermined.clone(),
            ),
            shape_only,
            forces_found: forces_found.into_option(),
        })
    } else {
        Status::Open(Reason::SolversDisagree(agreement.disagreement.clone()))
    };
    for answer in answers {
        answer.evidence.ladder.agreed = rung.clone();
        count_self_stresses(system, answer, shape_only);
        certify_rung(system, answer);
    }
    agreement
}

/// One count in all that is said of an answer: a solver that leaves out a cable that has its length and
/// bears nothing counts fewer self-stresses than the shape has, which the judge then names.
fn count_self_stresses(system: &System, answer: &mut SystemEquilibrium, shape_only: bool) {
    let Some(family) = Family::of(system, answer) else { return };
    let (Some(counts), basis) = (family.counts(), family.basis()) else { return };
    let evidence = &mut answer.evidence;
    if evidence.rigidity.is_some_and(|found| found.self_stresses < counts.self_stresses) {
        evidence.rigidity = Some(counts);
    }
    if shape_only && evidence.self_stresses.is_none() && !basis.is_empty() {
        evidence.self_stresses = Some(SelfStresses {
            dimension: basis.len(),
            basis: basis.to_vec(),
            choice: convention(system, &answer.solver),
            misfit_m: None,
            ranges: None,
        });
    }
}

/// The forces that an answer names without a word on them: those of a row between two anchors are a
/// limit, by either solver's derivation.
fn convention(system: &System, solver: &SolverName) -> ForceChoice {
    let ours = [SolverName::LAGRANGE, SolverName::ENERGY].contains(solver);
    if ours && system.as_row().is_some() {
        ForceChoice::AnchorsMovedApart
    } else {
        ForceChoice::Unknown
    }
}

/// Judge one answer that has no second to compare with.
pub fn judge_alone(system: &System, answer: &mut SystemEquilibrium) {
    let (tolerances, alone) = (Tolerances::project(), std::slice::from_ref(&*answer));
    let found = Judgement::new(system, alone, &tolerances).run(alone).agreement;
    let (statics, excesses) = (found.statics[0].largest(), found.disagreement.excesses);
    answer.evidence.ladder.agreed = Status::Open(if excesses.is_empty() {
        Reason::OneSolverOnly { solver: answer.solver.clone(), statics }
    } else {
        Reason::JudgeRefuses { excesses }
    });
    certify_rung(system, answer);
}

/// Judge one answer where another solver was asked and has none.
pub fn judge_without(
    system: &System,
    answer: &mut SystemEquilibrium,
    other: SolverName,
    because: NoAnswer,
) {
    judge_alone(system, answer);
    // What the judge refuses stays refused.
    if let Some(Reason::OneSolverOnly { statics, .. }) = answer.evidence.ladder.agreed.reason() {
        let (solver, statics) = (other, *statics);
        let reason = Reason::OtherSolverWithoutAnswer { solver, because, statics };
        answer.evidence.ladder.agreed = Status::Open(reason);
    }
}

/// The rungs above `agreed`.
fn certify_rung(system: &System, answer: &mut SystemEquilibrium) {
    let proof = match certify_row(system, answer) {
        Some(Ok(proof)) => Ok(proof),
        // Of a row the reason is known bar by bar.
        Some(Err(because)) => certify(system, answer).map_err(|_| because),
        None => certify(system, answer),
    };
    let optimal =
        proof.map_or_else(|because| Status::Open(Reason::NoCertificate(because)), Status::Reached);
    let ladder = &mut answer.evidence.ladder;
    // Proofs in intervals are asked for apart.
    ladder.verified = Status::Open(Reason::NotTried);
    ladder.complete = Status::Open(Reason::NotTried);
    ladder.optimal = optimal;
}

/// The certificate of a row between two anchors: without a factorisation, and it bounds what a bar in
/// compression costs where the whole row turns about a vertical.
fn certify_row(
    system: &System,
    answer: &SystemEquilibrium,
) -> Option<Result<Optimal, NoCertificate>> {
    let row = system.as_row()?;
    let axial_n = row.chain_axial_n(answer)?;
    let end = row.joints().last()?;
    let (pull, end_m) = (answer.reactions_n[end], answer.joints_m[end]);
    let proof = certify_pulled(row.problem(), pull, end_m, &axial_n, answer.energy_j);
    Some(proof.map(|proof| proof.proof()))
}

impl<'a> Judgement<'a> {
    fn new(system: &'a System, answers: &[SystemEquilibrium], tolerances: &'a Tolerances) -> Self {
        let mut scale = Scale::new(system, &answers[0]);
        for answer in &answers[1..] {
            let other = Scale::new(system, answer);
            scale.size_m = worse(scale.size_m, other.size_m);
            (scale.total_n, scale.held_n) =
                (scale.total_n.min(other.total_n), scale.held_n.min(other.held_n));
        }
        // Those of each joint the judge has for himself.
        scale.joint_n = vec![];
        if scale.total_n <= 0.0 {
            // Nothing acts: there is no other size of forces than what is found.
            scale.total_n = answers.iter().map(largest_force_n).fold(0.0, worse);
        }
        Self {
            system,
            tolerances,
            scale,
            free: free_joints(system, answers),
            family: None,
            shape_only: false,
            forces_found: ForcesFound::default(),
            agreement: SystemAgreement::default(),
        }
    }

    fn run(mut self, answers: &[SystemEquilibrium]) -> Self {
        self.agreement.free_joints = self.free.iter().filter(|free| **free).count();
        for (k, first) in answers.iter().enumerate() {
            self.family = Family::of(self.system, first);
            if k == 0 {
                self.agreement.self_stresses = self.family.as_ref().and_then(Family::dimension);
            }
            self.named(first);
            self.equally_stiff(first);
            self.large(first);
            for second in &answers[k + 1..] {
                self.pair(first, second);
            }
        }
        // One after the other: what is held while one is judged would be there twice.
        for answer in answers {
            let statics = judge(self.system, answer);
            let (solver, place) = (answer.solver.clone(), statics.worst);
            let budget = self.tolerances.statics;
            self.hold(Quantity::Statics { solver, place }, statics.largest(), budget);
            self.agreement.statics.push(statics);
        }
        if !self.agreement.disagreement.is_empty() {
            self.agreement.verdict = Verdict::Disagreed;
        }
        self
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

    /// An answer that names the forces of equally stiff members has them.
    fn equally_stiff(&mut self, answer: &SystemEquilibrium) {
        let named = answer.evidence.self_stresses.as_ref().map(|named| named.choice);
        let complete = [answer.axial_n.len(), answer.reactions_n.len()]
            == [self.system.members().len(), self.system.joints().len()];
        let Some(family) = &self.family else { return };
        if named == Some(ForceChoice::EquallyStiff) && complete {
            let off_n = family.off_equally_stiff_n(self.system, answer, self.no_force_n());
            let unit_n = self.scale.of_forces_n(self.taut_n(answer));
            let solver = answer.solver.clone();
            let budget_n = self.tolerances.forces * unit_n;
            self.hold(Quantity::EquallyStiff { solver }, off_n, budget_n);
        }
    }

    /// The largest axial force of an answer outside of the family, N.
    fn taut_n(&self, answer: &SystemEquilibrium) -> f64 {
        let outside = |k: &usize| self.family.as_ref().is_none_or(|f| !f.takes_part(*k));
        let members = (0..answer.axial_n.len()).filter(outside);
        members.map(|k| answer.axial_n[k].abs()).fold(0.0, worse)
    }

    fn no_force_n(&self) -> f64 {
        NO_FORCE * self.scale.total_n
    }

    /// Forces that exceed all that acts by orders of magnitude, and whether signs leave any open.
    fn large(&mut self, answer: &SystemEquilibrium) {
        if let Some(found) = large(answer, &self.scale) {
            let what = Quantity::LargeForce { solver: answer.solver.clone(), member: found.member };
            self.hold(what, found.ratio, ABSURD);
            self.forces_found.large.get_or_insert(found);
        }
        let least_n = self.no_force_n();
        let complete = [answer.axial_n.len(), answer.joints_m.len()]
            == [self.system.members().len(), self.system.joints().len()];
        let counted = self.family.as_ref().filter(|family| family.dimension().is_some());
        let is_open = || match counted {
            Some(family) => family.is_open(self.system, &answer.axial_n, least_n),
            None => has_more_lengths(self.system, answer),
        };
        self.shape_only |= complete && is_open();
    }

    /// Two answers: their differences, and their second-order behaviour.
    fn pair(&mut self, first: &SystemEquilibrium, second: &SystemEquilibrium) {
        let (turned, [turning, in_level]) = turned_onto(self.system, first, second, &self.free);
        let budget_m = self.tolerances.joints * self.scale.size_m + self.scale.stored_m;
        let mut joints_m = self.joints_apart_m(first, &turned);
        if joints_m > budget_m {
            for joint in sliding(self.system, [first, &turned], self.scale.total_n, budget_m) {
                if !self.free[joint] {
                    self.free[joint] = true;
                    self.agreement.undetermined.push(self.system.joints()[joint].name.to_string());
                }
            }
            joints_m = self.joints_apart_m(first, &turned);
        }
        let mut pair = Pair {
            system: self.system,
            answers: [first, &turned],
            scale: &self.scale,
            tolerance: self.tolerances.forces,
            family: self.family.as_ref(),
        };
        let mut apart = pair.apart();
        let counted = pair.family.is_some_and(|family| family.counts().is_some());
        let between = (apart.value_n > apart.budget_n && !counted && joints_m <= budget_m)
            .then(|| Family::between(self.system, pair.answers))
            .flatten();
        if between.is_some() {
            // Two answers in balance that differ by it show that the forces are open.
            pair.family = between.as_ref();
            apart = pair.apart();
            self.shape_only = true;
        }
        let (named, choices) = pair.named();
        let energy_j = (first.energy_j - second.energy_j).abs();
        if let Some(choices) = choices {
            self.forces_found.choices.get_or_insert(choices);
        }
        let agreement = &mut self.agreement;
        agreement.joints_m = worse(agreement.joints_m, joints_m);
        agreement.forces_n = worse(agreement.forces_n, apart.most_n);
        agreement.energy_j = worse(agreement.energy_j, energy_j);
        agreement.turned_parts = agreement.turned_parts.max(turning);
        agreement.sliding_parts = agreement.sliding_parts.max(in_level);
        let between = [&first.solver, &second.solver].map(SolverName::clone);
        let tolerances = self.tolerances;
        self.hold(Quantity::Joints { between: between.clone() }, joints_m, budget_m);
        let forces = Quantity::Forces { between: between.clone() };
        self.hold(forces, apart.value_n, apart.budget_n);
        if let Some(named) = named {
            let what = Quantity::NamedForces { between: between.clone() };
            self.hold(what, named.value_n, named.budget_n);
        }
        // Of what the places differ by within their budget the loads make so much.
        let moved_j = self.scale.load_n * joints_m.min(budget_m);
        let budget = tolerances.energy * self.scale.energy_j() + self.scale.stored_j + moved_j;
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
}
