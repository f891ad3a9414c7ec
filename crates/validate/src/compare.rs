//! Answers held against each other, and each against Newton's laws.

use model::{
    Agreed, Chain, Disagreement, Equilibrium, Excess, ForceFamily, FreeJoints, Ladder, NoAnswer,
    NoCensus, Problem, Quantity, Reason, SolverName, StabilityDifference, Status,
};
use serde::{Serialize, Serializer};

use crate::certificate::certify;
use crate::consistency::{Consistency, consistency};
use crate::differences::{Differences, worst};
use crate::force_family::force_family;
use crate::free::free_joints;
use crate::statics::{Statics, judge};
use crate::tolerances::Tolerances;
use crate::units::Units;

/// How far answers agree: the object `agreement` of the JSON. Of more than two, the largest
/// differences of any two.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// Largest distance of a joint in one answer from the same joint in another, m.
    pub joints_m: f64,
    /// Largest difference of a joint force, N.
    pub forces_n: f64,
    /// Largest difference of the energies, J.
    pub energy_j: f64,
    /// With both anchors on one vertical every turn about it is an equilibrium too: the angle by
    /// which the second answer was turned onto the first before the comparison, rad.
    pub turned_rad: Option<f64>,
    /// Number of joints that are proved to be free, in all answers: they may be anywhere that the
    /// lengths of their bars allow, so their places are judged by Newton's laws alone.
    pub free_joints: usize,
    /// The same, which ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub free: Option<FreeJoints>,
    /// Where equilibrium does not determine the forces: the family of those of the first answer.
    /// Then agreement is evidence for the shape alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_family: Option<ForceFamily>,
    /// Where one solver does not tell the least curvature in the plane from zero and another one
    /// does, with the same number of directions of falling energy: no contradiction.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub curvature_undecided: Vec<StabilityDifference>,
    /// Violations of Newton's laws by each answer.
    pub statics: Vec<Statics>,
    /// Whether the other numbers of each answer follow from its joints and forces; in JSON under
    /// the key of schema version 1, `books`.
    #[serde(rename = "books")]
    pub consistency: Vec<Consistency>,
    /// Whether all of these are within their budgets.
    pub verdict: Verdict,
    /// What speaks against it.
    #[serde(flatten, serialize_with = "with_sentences")]
    pub disagreement: Disagreement,
}

/// The key `reasons` with the words, and the numbers beside it.
pub(crate) fn with_sentences<S: Serializer>(
    disagreement: &Disagreement,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Keys<'a> {
        reasons: Vec<String>,
        #[serde(flatten)]
        numbers: &'a Disagreement,
    }
    Keys { reasons: disagreement.sentences(), numbers: disagreement }.serialize(serializer)
}

/// Whether answers are one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// All differences are within their budgets, and all answers in balance.
    Agreed,
    /// Something is not.
    Disagreed,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if *self == Self::Agreed { "agreed" } else { "disagreed" })
    }
}

impl Agreement {
    /// Whether the answers are one.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.verdict == Verdict::Agreed
    }

    /// The rung `agreed` of the answers that were compared.
    fn rung(&self, solvers: Vec<SolverName>) -> Status<Agreed> {
        if !self.agrees() {
            return Status::Open(Reason::SolversDisagree(self.disagreement.clone()));
        }
        Status::Reached(Agreed {
            solvers,
            joints_m: self.joints_m,
            forces_n: self.forces_n,
            energy_j: self.energy_j,
            statics: worst(self.statics.iter().map(Statics::largest)),
            free_joints: self.free,
            room: None,
            shape_only: self.force_family.is_some(),
            curvature_undecided: self.curvature_undecided.clone(),
            forces_found: None,
        })
    }
}

/// Hold answers against each other, every two of them, and each against Newton's laws, and write
/// what that proves into their evidence: `agreed`, and `optimal` where a certificate exists.
///
/// # Panics
///
/// When there are fewer than two answers: one alone is judged by [`judge_alone`].
///
/// ```
/// use validate::{Tolerances, compare};
/// let problem = model::cases::paper();
/// let mut answers = [
///     lagrange::solve(&problem, &lagrange::Settings::default())?.equilibrium,
///     energy::minimise(&problem, &energy::Settings::default())?.equilibrium,
/// ];
/// let agreement = compare(&problem, &mut answers, &Tolerances::project());
/// // The anchors are on one vertical: the second answer is turned onto the first.
/// assert!(agreement.agrees() && agreement.turned_rad.is_some());
/// assert!(agreement.joints_m < 1e-12);
/// // An answer that is off by a micrometre is told from the other.
/// answers[1].joints_m[1][2] += 1e-6;
/// assert!(!compare(&problem, &mut answers, &Tolerances::project()).agrees());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn compare(
    problem: &Problem,
    answers: &mut [Equilibrium],
    tolerances: &Tolerances,
) -> Agreement {
    assert!(answers.len() >= 2, "{} answers cannot be compared", answers.len());
    let agreement = agreement(problem.chain(), answers, tolerances);
    let solvers = answers.iter().map(|answer| answer.solver.clone()).collect();
    let rung = agreement.rung(solvers);
    for answer in answers {
        answer.evidence.ladder.agreed = rung.clone();
        certify_rung(problem, answer);
    }
    agreement
}

/// Judge one answer that has no second to compare with.
pub fn judge_alone(problem: &Problem, answer: &mut Equilibrium) -> Statics {
    let (chain, tolerances) = (problem.chain(), Tolerances::project());
    let statics = judge(chain, &answer.joints_m, &answer.multipliers_n);
    let units = Units::new(chain, &answer.multipliers_n);
    let mut judgement = Judgement::new(&tolerances, units);
    judgement.alone(&answer.solver, &statics, &consistency(chain, answer));
    let excesses = judgement.found.excesses;
    answer.evidence.ladder.agreed = Status::Open(if excesses.is_empty() {
        Reason::OneSolverOnly { solver: answer.solver.clone(), statics: statics.largest() }
    } else {
        Reason::JudgeRefuses { excesses }
    });
    certify_rung(problem, answer);
    statics
}

/// Judge one answer where another solver was asked and has none.
pub fn judge_without(
    problem: &Problem,
    answer: &mut Equilibrium,
    other: SolverName,
    because: NoAnswer,
) -> Statics {
    let judged = judge_alone(problem, answer);
    other_has_none(&mut answer.evidence.ladder, other, because);
    judged
}

/// Say on an answer judged alone that another solver was asked. What the judge refuses stays
/// refused.
pub(crate) fn other_has_none(ladder: &mut Ladder, solver: SolverName, because: NoAnswer) {
    if let Some(Reason::OneSolverOnly { statics, .. }) = ladder.agreed.reason() {
        let statics = *statics;
        ladder.agreed = Status::Open(Reason::OtherSolverWithoutAnswer { solver, because, statics });
    }
}

/// The rungs above `agreed`.
fn certify_rung(problem: &Problem, answer: &mut Equilibrium) {
    let proof = certify(problem, answer);
    answer.evidence.force_family = force_family(problem.chain(), answer);
    let ladder = &mut answer.evidence.ladder;
    ladder.verified = Status::Open(Reason::NoCensus(NoCensus::NotAsked));
    ladder.complete = Status::Open(Reason::NoCensus(NoCensus::NotAsked));
    ladder.optimal = match proof {
        Ok(certificate) => Status::Reached(certificate.proof()),
        Err(because) => Status::Open(Reason::NoCertificate(because)),
    };
}

/// What the budgets are held against, one after the other.
struct Judgement<'a> {
    tolerances: &'a Tolerances,
    units: Units,
    found: Disagreement,
    undecided: Vec<StabilityDifference>,
}

impl<'a> Judgement<'a> {
    fn new(tolerances: &'a Tolerances, units: Units) -> Self {
        Self { tolerances, units, found: Disagreement::default(), undecided: Vec::new() }
    }
}

impl Judgement<'_> {
    fn hold(&mut self, what: Quantity, value: f64, budget: f64) {
        // NaN is over every budget.
        if value.is_nan() || value > budget {
            self.found.excesses.push(Excess { what, value, budget });
        }
    }

    /// Two answers: their differences, and their second-order behaviour.
    fn pair(&mut self, [first, second]: [&Equilibrium; 2], differences: &Differences) {
        let (tolerances, units) = (self.tolerances, self.units);
        let between = [&first.solver, &second.solver].map(SolverName::clone);
        self.hold(
            Quantity::Joints { between: between.clone() },
            differences.joints_m,
            tolerances.joints.value * units.length_m + units.rounding_m,
        );
        self.hold(
            Quantity::Forces { between: between.clone() },
            differences.forces_n,
            tolerances.forces.value * units.force_n,
        );
        self.hold(
            Quantity::Energy { between: between.clone() },
            differences.energy_j,
            tolerances.energy.value * units.energy_j,
        );
        let found = [first.stability, second.stability];
        if found[0] != found[1] {
            let compatible = found[0].is_compatible_with(&found[1]);
            let found = StabilityDifference { between, found };
            if compatible { &mut self.undecided } else { &mut self.found.stability }.push(found);
        }
    }

    /// One answer by itself.
    fn alone(&mut self, solver: &SolverName, statics: &Statics, consistency: &Consistency) {
        let tolerances = self.tolerances;
        let solver = || solver.clone();
        self.hold(
            Quantity::Statics { solver: solver(), bar: statics.worst_bar },
            statics.largest(),
            tolerances.statics.value,
        );
        self.hold(
            Quantity::EnergyOfJoints { solver: solver() },
            consistency.energy,
            tolerances.energy.value,
        );
        self.hold(
            Quantity::AxialForcesAndReactions { solver: solver() },
            consistency.forces(),
            tolerances.statics.value,
        );
    }
}

fn agreement(chain: &Chain, answers: &[Equilibrium], tolerances: &Tolerances) -> Agreement {
    let units = Units::new(chain, &answers[0].multipliers_n);
    let mut judgement = Judgement::new(tolerances, units);
    let free = common(
        answers.iter().map(|answer| free_joints(chain, &answer.joints_m).map(|(_, joints)| joints)),
    );
    // Answers of one family name the same line; where one is none of a family, forces are compared
    // as they are.
    let families: Vec<_> = answers.iter().map(|answer| force_family(chain, answer)).collect();
    let all = families.iter().all(Option::is_some);
    let family = families.into_iter().next().flatten().filter(|_| all);
    let mut differences = Vec::new();
    for (k, first) in answers.iter().enumerate() {
        for second in &answers[k + 1..] {
            let found = Differences::of(chain, [first, second], free, family.as_ref());
            judgement.pair([first, second], &found);
            differences.push(found);
        }
    }
    let statics: Vec<_> =
        answers.iter().map(|a| judge(chain, &a.joints_m, &a.multipliers_n)).collect();
    let consistency: Vec<_> = answers.iter().map(|a| consistency(chain, a)).collect();
    for ((answer, statics), consistency) in answers.iter().zip(&statics).zip(&consistency) {
        judgement.alone(&answer.solver, statics, consistency);
    }
    let verdict = if judgement.found.is_empty() { Verdict::Agreed } else { Verdict::Disagreed };
    Agreement {
        joints_m: worst(differences.iter().map(|d| d.joints_m)),
        forces_n: worst(differences.iter().map(|d| d.forces_n)),
        energy_j: worst(differences.iter().map(|d| d.energy_j)),
        turned_rad: differences.first().and_then(|d| d.turned_rad),
        free_joints: free.map_or(0, |free| free.count()),
        free,
        force_family: family,
        curvature_undecided: judgement.undecided,
        statics,
        consistency,
        verdict,
        disagreement: judgement.found,
    }
}

/// What all have in common; nothing if they differ.
fn common<T: PartialEq>(mut all: impl Iterator<Item = Option<T>>) -> Option<T> {
    let first = all.next()??;
    all.all(|other| other.as_ref() == Some(&first)).then_some(first)
}

#[cfg(test)]
mod tests;
