//! The judgement of an answer from elsewhere.

use model::system::{System, SystemEquilibrium};
use model::{
    Agreed, Convergence, Disagreement, Excess, Ladder, Place, Quantity, Reason, SolverName, Status,
};
use serde::Serialize;

use super::best_forces::{BestForces, best_forces};
use super::bounds::Bounds;
use super::digits::printed;
use super::floor::laid;
use super::given::ForeignAnswer;
use super::nearest::{Nearest, NearestEquilibrium, nearest};
use super::violation::{Held, Measured, Violation};
use crate::systems::placed::{largest_n, placed};
use crate::systems::{ABSURD, Scale, SystemStatics, certify, judge};
use numerics::vector::norm;

/// What the judgement comes to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "finding", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Finding {
    /// An equilibrium is within the tolerance of the answer, by a solver whose forces and lengths
    /// the statics judge finds right.
    Confirmed,
    /// A law is broken by more than the tolerance explains: no equilibrium is within it.
    Refuted,
    /// No law is broken, and the nearest equilibrium found is further off than the tolerance.
    Far {
        /// The largest distance of a joint, m.
        joints_m: f64,
        /// What the tolerance allows, m.
        allowed_m: f64,
    },
    /// The positions are those of an equilibrium, and the forces given differ from its own, which
    /// are unique.
    OtherForces {
        /// The largest difference of an axial force, N.
        forces_n: f64,
        /// What the tolerance allows, N.
        allowed_n: f64,
    },
    /// No law is broken, but forces that are not unique exceed the loads so far that what the
    /// tolerance allows them hides the loads, or that no system bears them: a self-stress of any size
    /// may be among them.
    LoadsHidden {
        /// The member with the largest force, from 1.
        member: usize,
        /// Its axial force, N.
        force_n: f64,
        /// The largest load of a joint, and the prestress of elastic members, N.
        loads_n: f64,
        /// What the tolerance allows a force, N.
        allowed_n: f64,
    },
    /// No law is broken, and no solver found an equilibrium.
    NoEquilibrium,
    /// The forces found do not balance to the tolerance, and no proof says that none do.
    ForcesNotFound,
}

/// Which forces were judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "forces", rename_all = "snake_case")]
pub enum ForcesJudged {
    /// Those of the answer.
    Given,
    /// The answer has none: those that leave the joints least out of balance.
    Found(BestForces),
}

/// An answer from elsewhere, judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judgement {
    /// Whose answer it is.
    pub source: SolverName,
    /// What the judgement comes to.
    #[serde(flatten)]
    pub finding: Finding,
    /// What the tolerance explains.
    pub bounds: Bounds,
    /// Which forces were judged.
    #[serde(flatten)]
    pub forces: ForcesJudged,
    /// To how many digits the given forces were taken as printed, where the tolerance does not explain that they break a
    /// law or differ from those of the equilibrium, and these digits do.
    pub force_digits: Option<usize>,
    /// The smallest power of ten that as tolerance would have confirmed the answer, of one that is
    /// not confirmed.
    pub confirmed_at: Option<f64>,
    /// Everything that is broken.
    pub violations: Vec<Violation>,
    /// The largest violation in units of what the tolerance explains: 1 or less is none.
    pub largest: f64,
    /// The same answer before the statics judge, as strictly as the project's own answers.
    pub statics: SystemStatics,
    /// How far off the nearest equilibrium is.
    pub nearest: Nearest,
    /// How far the answer is proved: the rungs of the equilibrium that it stands for.
    pub ladder: Ladder,
    /// The answer with what follows from its places and forces: the forces of the ground, given or from the
    /// balance of each joint, those at the ends of members, the energy. Where its forces were found and
    /// balance leaves them open, its self-stresses are those of the nearest equilibrium. Of its second
    /// order nothing is said here.
    #[serde(skip)]
    pub answer: SystemEquilibrium,
}

impl Judgement {
    /// Whether the answer stands.
    pub fn is_confirmed(&self) -> bool {
        self.finding == Finding::Confirmed
    }

    /// Whether the answer falls.
    pub fn is_refuted(&self) -> bool {
        self.finding == Finding::Refuted
    }

    /// The nearest equilibrium, if one was found.
    pub fn nearest(&self) -> Option<&NearestEquilibrium> {
        self.nearest.equilibria.first()
    }
}

/// Why nothing was judged.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the tolerance of an answer must lie between {LEAST:e} and {MOST:e}, got {tolerance:e}")]
pub struct ToleranceError {
    /// As asked for.
    pub tolerance: f64,
}

/// Below this rounding decides.
const LEAST: f64 = 1e-13;
/// Above this every shape is an equilibrium.
const MOST: f64 = 0.1;
/// The tolerances that are tried for an answer that is not confirmed at its own.
const POWERS: [f64; 12] =
    [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, MOST];

/// Judge an answer. `watch` is told what is being done.
///
/// # Errors
/// [`ToleranceError`] when the tolerance is out of range.
///
/// ```
/// use model::system::{Joint, Member, System};
/// use validate::foreign::{Finding, ForeignAnswer, bounds::TOLERANCE, judge_foreign};
/// // A lamp of 2 N on two cables of 5 m between anchors 6 m apart hangs 4 m below them.
/// let joints = vec![
///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
///     Joint::anchor("B", [3.0, 0.0, 0.0]),
///     Joint::free("lamp").with_mass(0.2),
/// ];
/// let body = model::Bar::homogeneous(5.0, 0.0)?;
/// let members = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
/// let system = System::new("lamp", 10.0, joints, members)?;
/// let at = |z: f64| vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, z]];
/// let finding = |z: f64| {
///     let answer = ForeignAnswer::in_order(&system, "a table", at(z), None).unwrap();
///     judge_foreign(&system, &answer, TOLERANCE, &|_| {}).unwrap()
/// };
/// assert_eq!(finding(-4.0).finding, Finding::Confirmed);
/// // A centimetre too low, both cables are 8 mm too long.
/// let low = finding(-4.01);
/// assert_eq!(low.finding, Finding::Refuted);
/// assert!((low.violations[0].value - 0.008).abs() < 1e-4);
/// assert!((low.nearest().unwrap().joints_m - 0.01).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn judge_foreign(
    system: &System,
    answer: &ForeignAnswer,
    tolerance: f64,
    watch: &dyn Fn(&str),
) -> Result<Judgement, ToleranceError> {
    if !(LEAST..=MOST).contains(&tolerance) {
        return Err(ToleranceError { tolerance });
    }
    let Trial { mut bounds, forces, mut completed, measured, mut force_digits } =
        trial(system, answer, tolerance, watch);
    let nearest = nearest(system, &completed, bounds.position_m, watch);
    let within = |bounds| finding(system, answer, (&completed, &measured), &nearest, bounds);
    let mut finding = within(&bounds);
    if matches!(finding, Finding::OtherForces { .. }) {
        let (digits, printed) = as_printed(answer, &bounds);
        if within(&printed) == Finding::Confirmed {
            (bounds, force_digits, finding) = (printed, Some(digits), Finding::Confirmed);
        }
    }
    watch("the rungs");
    let ladder = ladder(system, &completed, finding, &measured, &nearest, &bounds);
    let statics = judge(system, &completed);
    if let Some(reactions_n) = &answer.reactions_n {
        completed.reactions_n.clone_from(reactions_n);
    }
    if answer.axial_n.is_none() {
        completed.evidence.self_stresses = nearest.self_stresses().cloned();
    }
    Ok(Judgement {
        source: answer.source.clone(),
        finding,
        bounds,
        forces,
        force_digits,
        confirmed_at: match finding {
            Finding::Confirmed => None,
            _ => confirmed_at(system, answer, tolerance, &nearest, watch),
        },
        violations: measured.violations,
        largest: measured.largest,
        statics,
        nearest,
        ladder,
        answer: completed,
    })
}

/// An answer before all laws at a tolerance.
struct Trial {
    bounds: Bounds,
    forces: ForcesJudged,
    completed: SystemEquilibrium,
    measured: Measured,
    force_digits: Option<usize>,
}

fn trial(system: &System, answer: &ForeignAnswer, tolerance: f64, watch: &dyn Fn(&str)) -> Trial {
    let bounds = Bounds::of_positions(system, &answer.joints_m, tolerance);
    let laid = laid(system, &answer.joints_m, &bounds);
    let (forces, axial_n) = if let Some(axial_n) = &answer.axial_n {
        (ForcesJudged::Given, axial_n.clone())
    } else {
        watch("the forces that leave the joints least out of balance");
        let best = best_forces(&laid, &answer.joints_m, &bounds);
        let axial_n = best.axial_n.clone();
        (ForcesJudged::Found(best), axial_n)
    };
    watch("the laws, member by member");
    let completed = placed(&laid, &answer.source, &answer.joints_m, &axial_n);
    let given = answer.reactions_n.iter().flatten();
    let largest = given.map(|force| norm(*force)).fold(largest_n(system, &completed), f64::max);
    let bounds = bounds.with_largest_force(largest);
    let measured = |bounds: &Bounds| measure([system, &laid], answer, &completed, &forces, bounds);
    let strict = measured(&bounds);
    let of_forces = strict.violations.iter().all(|violation| violation.law.unit() == "N");
    if answer.axial_n.is_some() && of_forces && !strict.violations.is_empty() {
        let (digits, bounds) = as_printed(answer, &bounds);
        let measured = measured(&bounds);
        if measured.violations.is_empty() {
            return Trial { bounds, forces, completed, measured, force_digits: Some(digits) };
        }
    }
    Trial { bounds, forces, completed, measured: strict, force_digits: None }
}

/// To how many digits the forces given were printed, and what that leaves of them.
fn as_printed(answer: &ForeignAnswer, bounds: &Bounds) -> (usize, Bounds) {
    let numbers = answer.axial_n.iter().flatten().copied();
    let ground = answer.reactions_n.iter().flatten().flatten().copied();
    let (digits, half_a_unit_n) = printed(numbers.chain(ground));
    (digits, Bounds { force_n: bounds.force_n.max(half_a_unit_n), ..*bounds })
}

/// The smallest of the larger powers of ten at which an answer is confirmed by the equilibrium that
/// was found next to it.
fn confirmed_at(
    system: &System,
    answer: &ForeignAnswer,
    tolerance: f64,
    nearest: &Nearest,
    watch: &dyn Fn(&str),
) -> Option<f64> {
    let apart_m = nearest.equilibria.first()?.joints_m;
    POWERS.into_iter().filter(|power| *power > tolerance).find(|power| {
        if Bounds::of_positions(system, &answer.joints_m, *power).position_m < apart_m {
            return false;
        }
        let Trial { bounds, completed, measured, .. } = trial(system, answer, *power, watch);
        let judged = (&completed, &measured);
        finding(system, answer, judged, nearest, &bounds) == Finding::Confirmed
    })
}

/// Every law: lengths, supports and floor of the system, balances of what is laid on it.
fn measure(
    [system, laid]: [&System; 2],
    answer: &ForeignAnswer,
    completed: &SystemEquilibrium,
    forces: &ForcesJudged,
    bounds: &Bounds,
) -> Measured {
    let given = *forces == ForcesJudged::Given;
    let held = Held { system, answer: completed, bounds };
    let mut measured = held.geometry_and_laws(given);
    let (laid, reactions_n) = (Held { system: laid, ..held }, answer.reactions_n.as_deref());
    match forces {
        ForcesJudged::Given => {
            held.tensions(answer, &mut measured);
            laid.balance_given(reactions_n, &mut measured);
        }
        ForcesJudged::Found(best) => laid.balance_found(best, &mut measured),
    }
    if let Some(reactions_n) = reactions_n {
        laid.whole(reactions_n, &mut measured);
    }
    held.above_floor(&mut measured);
    measured
}

/// What it comes to.
fn finding(
    system: &System,
    answer: &ForeignAnswer,
    (completed, measured): (&SystemEquilibrium, &Measured),
    nearest: &Nearest,
    bounds: &Bounds,
) -> Finding {
    if !measured.violations.is_empty() {
        return Finding::Refuted;
    }
    if measured.open {
        return Finding::ForcesNotFound;
    }
    let Some(found) = nearest.equilibria.first() else { return Finding::NoEquilibrium };
    let (joints_m, allowed_m) = (found.joints_m, bounds.position_m);
    // NaN is no confirmation.
    if joints_m.is_nan() || joints_m > allowed_m {
        return Finding::Far { joints_m, allowed_m };
    }
    // What places allow an elastic force is for the laws: the equilibrium's own has no part in it.
    let (forces_n, allowed_n) = (found.forces_n, bounds.force_n);
    if answer.axial_n.is_some() && found.forces_unique == Some(true) && forces_n > allowed_n {
        return Finding::OtherForces { forces_n, allowed_n };
    }
    if found.forces_unique != Some(true)
        && let Some(hidden) = loads_hidden(system, completed, bounds)
    {
        return hidden;
    }
    Finding::Confirmed
}

/// Whether the loads are lost beside the forces of an answer: each of them, where many joints bear
/// one.
fn loads_hidden(
    system: &System,
    completed: &SystemEquilibrium,
    bounds: &Bounds,
) -> Option<Finding> {
    let (loads_n, allowed_n) = (Scale::new(system, completed).seen_n(), bounds.force_n);
    let forces = completed.axial_n.iter().enumerate();
    let (k, &force_n) = forces.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let hidden = allowed_n >= loads_n || force_n.abs() >= ABSURD * loads_n;
    let finding = Finding::LoadsHidden { member: k + 1, force_n, loads_n, allowed_n };
    (loads_n > 0.0 && hidden).then_some(finding)
}

/// The rungs of an answer that is confirmed are those of the equilibrium that it stands for.
fn ladder(
    system: &System,
    completed: &SystemEquilibrium,
    finding: Finding,
    measured: &Measured,
    nearest: &Nearest,
    bounds: &Bounds,
) -> Ladder {
    let convergence = Convergence {
        residual_of: "largest violation of a law in units of what the tolerance explains",
        residual: measured.largest,
        tolerance: Some(1.0),
        iterations: 0,
        force_uncertainty: None,
    };
    let mut ladder = Ladder::default();
    if finding == Finding::Confirmed {
        ladder.converged = Status::Reached(convergence);
        if let Some(found) = nearest.equilibria.first() {
            ladder.agreed = agreed(completed, nearest, bounds, found);
            let own = &found.equilibrium.evidence.ladder;
            ladder.verified = own.verified.clone();
            ladder.complete = own.complete.clone();
            ladder.optimal = own.optimal.clone();
        }
        return ladder;
    }
    let refused = |what, value, budget| Reason::JudgeRefuses {
        excesses: vec![Excess { what, value, budget }],
    };
    let solver = completed.solver.clone();
    let place = measured.worst().map_or(Place::Whole, |violation| violation.place);
    ladder.converged = if measured.violations.is_empty() {
        Status::Reached(convergence)
    } else {
        Status::Open(Reason::AboveTolerance(convergence))
    };
    let apart =
        |found: &NearestEquilibrium, excess: fn([SolverName; 2]) -> Quantity, value, budget| {
            let what = excess([solver.clone(), found.equilibrium.solver.clone()]);
            let excesses = vec![Excess { what, value, budget }];
            Reason::SolversDisagree(Disagreement { excesses })
        };
    ladder.agreed = Status::Open(match (finding, nearest.equilibria.first()) {
        _ if !measured.violations.is_empty() => {
            refused(Quantity::Statics { solver: solver.clone(), place }, measured.largest, 1.0)
        }
        (Finding::LoadsHidden { member, force_n, loads_n, allowed_n }, _) => {
            let most = ABSURD.min(force_n.abs() / allowed_n);
            let solver = solver.clone();
            refused(Quantity::LargeForce { solver, member }, force_n.abs() / loads_n, most)
        }
        (Finding::OtherForces { forces_n, allowed_n }, Some(found)) => {
            apart(found, |between| Quantity::Forces { between }, forces_n, allowed_n)
        }
        (_, Some(found)) => {
            let budget_m = bounds.position_m;
            apart(found, |between| Quantity::Joints { between }, found.joints_m, budget_m)
        }
        (_, None) => Reason::NotTried,
    });
    // A certificate needs no second answer: it bounds the energy of every configuration.
    if let Err(because) = certify(system, completed) {
        ladder.optimal = Status::Open(Reason::NoCertificate(because));
    }
    ladder
}

/// Whether both solvers stand behind the equilibrium.
fn agreed(
    completed: &SystemEquilibrium,
    nearest: &Nearest,
    bounds: &Bounds,
    found: &NearestEquilibrium,
) -> Status<Agreed> {
    let own = &found.equilibrium.evidence.ladder.agreed;
    let Status::Reached(agreement) = own else { return own.clone() };
    let near = nearest.equilibria.iter().filter(|one| one.joints_m <= bounds.position_m);
    let solvers = near.map(|one| one.equilibrium.solver.clone());
    Status::Reached(Agreed {
        solvers: std::iter::once(completed.solver.clone()).chain(solvers).collect(),
        joints_m: found.joints_m,
        forces_n: found.forces_n,
        energy_j: found.energy_j.abs(),
        shape_only: found.forces_unique != Some(true),
        ..agreement.clone()
    })
}

#[cfg(test)]
mod tests;
