//! One question to both solvers about a system: their answers compared, judged and certified.

use census::net::SystemCensus;
use lagrange::net::Seed;
use model::system::{Joint, Kind, Row, System, SystemEquilibrium};
use model::{NoAnswer, NoCensus, Quantity, Reason, Rung, SolverName, Status, Vector};
use numerics::Interval;
use numerics::vector::{minus, norm};
use serde::Serialize;

use super::compare::{SystemAgreement, compare, judge_alone, judge_without};
use super::completeness::{is_at, look_up, lowest_listed, wanted_census};
use super::near::{FAR, LOWER, Near, as_drawn, is_below, lower_j, next_to};
use super::statics::judge;
use super::verified::verify;
use crate::question::{Equations, Question, Solvers, UseCensus};
use crate::tolerances::Tolerances;

/// Starts at random of a system of up to so many members that may push, of which no answer is proved the lowest.
const STARTS: usize = 24;
const STARTED: usize = 60;

/// Both answers for a system with what is known of them.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemAnswer {
    /// One for each solver that has an answer, with its evidence: `lagrange` first.
    pub equilibria: Vec<SystemEquilibrium>,
    /// Why the other solvers that were asked have none.
    pub failures: Vec<SystemFailure>,
    /// The comparison, if there are two to compare.
    pub agreement: Option<SystemAgreement>,
    /// How the first of them lies to the drawing, where the system is drawn: then the question is
    /// the equilibrium next to it, and else the lowest of all.
    pub near: Option<Near>,
    /// The solvers that were asked again, because they had no answer or another equilibrium: next to the lowest
    /// one of a complete census, next to a lower one that other starts lead to, or next to that of the other solver.
    pub asked_again: Vec<SolverName>,
}

/// Why a solver has no answer for a system.
#[derive(Debug, Clone, PartialEq, Serialize, thiserror::Error)]
#[serde(untagged)]
#[non_exhaustive]
pub enum SystemFailure {
    /// Occurs when `lagrange` has no answer.
    #[error("lagrange: {0}")]
    Lagrange(#[from] lagrange::Error),
    /// Occurs when `energy` has no answer.
    #[error("energy: {0}")]
    Energy(#[from] energy::Error),
}

impl SystemFailure {
    /// Whether the lengths of rigid members fit no shape: no search would find one.
    pub fn is_misfit(&self) -> bool {
        matches!(
            self,
            Self::Lagrange(lagrange::Error::Misfit { .. })
                | Self::Energy(energy::Error::Misfit { .. })
        )
    }

    /// Whether supports leave a part free to move along its loads.
    pub fn falls(&self) -> bool {
        matches!(
            self,
            Self::Lagrange(lagrange::Error::Falls { .. })
                | Self::Energy(energy::Error::Falls { .. })
        )
    }

    /// Whether no force is left that decides the shape.
    pub fn is_unloaded(&self) -> bool {
        matches!(
            self,
            Self::Lagrange(lagrange::Error::Unloaded) | Self::Energy(energy::Error::NoLoad)
        )
    }

    /// Whether the search went astray, which another start may mend: no refusal, and no limit of work or memory.
    fn is_astray(&self, system: &System) -> bool {
        use energy::Error as Energy;
        use lagrange::Error as Lagrange;
        // Then other lengths may be kept elsewhere.
        let may_be_slack = system.floor_m().is_some()
            || system.members().iter().any(|member| member.kind != Kind::Bar);
        match self {
            Self::Lagrange(error) => {
                matches!(
                    error,
                    Lagrange::NotConverged { .. }
                        | Lagrange::Unstable { .. }
                        | Lagrange::Escapes { .. }
                        | Lagrange::Jammed(_)
                        | Lagrange::Floor { .. }
                ) || may_be_slack
                    && matches!(error, Lagrange::Misfit { .. } | Lagrange::HeldMisfit { .. })
            }
            Self::Energy(error) => {
                matches!(
                    error,
                    Energy::NotClosed { .. }
                        | Energy::Unbalanced { .. }
                        | Energy::IterationLimit { .. }
                        | Energy::Stalled { .. }
                        | Energy::NoMinimum { .. }
                        | Energy::NoMinimumNear { .. }
                        | Energy::Jammed { .. }
                ) || may_be_slack && matches!(error, Energy::Misfit { .. })
            }
        }
    }

    /// The solver that has no answer.
    pub fn solver(&self) -> SolverName {
        match self {
            Self::Lagrange(_) => SolverName::LAGRANGE,
            Self::Energy(_) => SolverName::ENERGY,
        }
    }
}

impl SystemAnswer {
    /// The answer of one solver, if it has one.
    pub fn by(&self, solver: &SolverName) -> Option<&SystemEquilibrium> {
        self.equilibria.iter().find(|equilibrium| equilibrium.solver == *solver)
    }

    /// Whether both solvers answered and agree, the judge finds both in balance, and no census
    /// refutes them.
    pub fn agrees(&self) -> bool {
        self.agreement.as_ref().is_some_and(SystemAgreement::agrees) && !self.check_failed()
    }

    /// Whether a check has failed: the answers disagree, the judge refuses one, or a complete
    /// census refutes one.
    pub fn check_failed(&self) -> bool {
        let disagree = self.agreement.as_ref().is_some_and(|agreement| !agreement.agrees());
        disagree || self.equilibria.iter().any(|answer| answer.evidence.ladder.failed())
    }

    /// Whether every solver that was asked has an answer, each has converged or is proved to be an
    /// equilibrium, and it is the neighbour of the drawing where that is the question.
    pub fn is_decided(&self) -> bool {
        let known = |answer: &SystemEquilibrium| {
            let ladder = &answer.evidence.ladder;
            // A box around the answer proves more than a residual.
            ladder.converged.is_reached() || ladder.verified.is_reached()
        };
        let asked_for = self.near.as_ref().is_none_or(|near| near.is_neighbour);
        asked_for && self.failures.is_empty() && self.equilibria.iter().all(known)
    }
}

/// Ask for the lowest equilibrium, or for the one next to the structure as it is drawn
/// ([`System::drawing`]). `watch` is told what is being done.
///
/// A solver that has no answer does not take the other's away: see [`SystemAnswer::failures`].
///
/// ```
/// use validate::{Solvers, systems::ask};
/// // The paper's chain as a system of joints and members: its hanging shape has
/// // V = 2.33546865 mgl above three lengths below joint 0, 2.33546865 - 6 from joint 0 itself.
/// let chain = model::cases::paper().into_chain();
/// let answer = ask(&(&chain).into(), Solvers::Both, &|_| {});
/// let energy_mgl = answer.equilibria[0].energy_j / chain.gravity_m_s2();
/// assert!(answer.agrees() && (energy_mgl + 6.0 - 2.335_468_652).abs() < 1e-9);
/// ```
pub fn ask(system: &System, solvers: Solvers, watch: &dyn Fn(&str)) -> SystemAnswer {
    ask_with(system, &Question { solvers, ..Question::default() }, watch)
}

/// The same in full: with which equations, with or without the proofs in interval arithmetic (the
/// rungs `verified` and `complete`), on how many threads.
pub fn ask_with(system: &System, question: &Question, watch: &dyn Fn(&str)) -> SystemAnswer {
    let asked = Asked { system, question, watch };
    let census = question.census;
    let drawing_m = system.drawing();
    let mut answers = match &drawing_m {
        Some(drawing_m) => asked.near_to(&Seed::at(drawing_m.clone())),
        None => asked.lowest(),
    };
    // Without a drawing the lowest is asked for, and a complete list knows it.
    let listed = wanted_census(system, census);
    let mut asked_again = match &listed {
        Ok(listed) if drawing_m.is_none() => asked.ask_again(listed, &mut answers),
        _ => vec![],
    };
    for answer in answers.iter_mut().flatten() {
        if let Some(at) = &drawing_m {
            as_drawn(system, at, answer);
        }
    }
    let (mut near, between) =
        drawing_m.as_ref().and_then(|at| next_to(system, at, &mut answers)).unzip();
    watch("the judges");
    let (mut equilibria, mut failures) = (vec![], vec![]);
    for answer in answers {
        match answer {
            Ok(equilibrium) => equilibria.push(equilibrium),
            Err(failure) => failures.push(failure),
        }
    }
    let mut agreement = judged(system, &mut equilibria, &failures);
    let drawing_m = drawing_m.as_deref();
    // That an answer is the lowest of all is known from the judges.
    if let (Some(at), Some(far), Some(first)) = (drawing_m, &mut near, equilibria.first())
        && !far.is_neighbour
    {
        *far = Near::of(system, at, first);
    }
    if drawing_m.is_none()
        && let Some((both, one)) = asked.lower(&equilibria)
    {
        (equilibria, agreement) = (both, Some(one));
        failures.clear();
        asked_again = vec![SolverName::LAGRANGE, SolverName::ENERGY];
    }
    if !agreement.as_ref().is_some_and(SystemAgreement::agrees) {
        let beside = asked.ask_beside(drawing_m, agreement.as_ref(), &mut equilibria, &failures);
        let is_near = near.as_ref().is_some_and(|near| near.is_neighbour);
        let agreed = match beside {
            Some((solver, one)) => {
                if !asked_again.contains(&solver) {
                    asked_again.push(solver);
                }
                Some(one)
            }
            None if drawing_m.is_some() && !is_near => asked.elsewhere(&mut equilibria, &failures),
            None => None,
        };
        if agreed.is_some() {
            agreement = agreed;
            failures.clear();
            near = drawing_m.map(|at| Near::of(system, at, &equilibria[0]));
        }
    }
    if census == UseCensus::Never {
        for answer in &mut equilibria {
            let not_asked = || Reason::NoCensus(NoCensus::NotAsked);
            answer.evidence.ladder.verified = Status::Open(not_asked());
            answer.evidence.ladder.complete = Status::Open(not_asked());
        }
    } else {
        watch("proofs in interval arithmetic");
        verify(system, &mut equilibria);
        look_up(system, &listed, &mut equilibria);
    }
    if let (Some(near), Some(first)) = (&mut near, equilibria.first())
        && census != UseCensus::Never
    {
        watch("the lowest equilibrium");
        near.lower_j = lower_j(system, question, first);
    }
    if let (Some(near), Some(true)) = (&mut near, between) {
        near.is_neighbour = false;
    }
    SystemAnswer { equilibria, failures, agreement, near, asked_again }
}

/// What a solver has.
type Found = Result<SystemEquilibrium, SystemFailure>;

/// What is asked of which system, and who is told.
#[derive(Clone, Copy)]
struct Asked<'a> {
    system: &'a System,
    question: &'a Question,
    watch: &'a dyn Fn(&str),
}

impl Asked<'_> {
    /// Ask those solvers again that have no answer or end in another equilibrium than the lowest of a complete census, each by its own method next
    /// to that; the names of those that are there now. The census tells where to look, not what holds there.
    fn ask_again(&self, census: &SystemCensus, answers: &mut [Found]) -> Vec<SolverName> {
        let found: Vec<&SystemEquilibrium> = answers.iter().flatten().collect();
        let Some(lowest) = lowest_listed(self.system, census, &found) else { return vec![] };
        let places_m: Vec<Vector> =
            lowest.joints_m.iter().map(|at| at.map(Interval::mid)).collect();
        let is_listed = |answer: &SystemEquilibrium| {
            census.equilibria.iter().any(|position| is_at(self.system, position, answer))
        };
        let mut asked_again = vec![];
        for answer in answers {
            let solver = match answer {
                // The paper's equations have no shape to begin from.
                _ if self.question.equations == Equations::Full => continue,
                // One that is no equilibrium at all is refuted, not replaced.
                Ok(answer) if is_at(self.system, lowest, answer) || !is_listed(answer) => continue,
                Ok(answer) => answer.solver.clone(),
                Err(failure) => failure.solver(),
            };
            let again = self.next_to_by(&places_m, &solver);
            if let Some(again) = again.filter(|again| is_at(self.system, lowest, again)) {
                *answer = Ok(again);
                asked_again.push(solver);
            }
        }
        asked_again
    }

    /// Two answers that differ (mirror images, a mast that stands and one that leans): ask the solver of the higher one again next
    /// to the other, or the one that has no answer at all; of two that are as high, or next to a drawing, where the nearer one
    /// comes first, one after the other. What is known must be in balance, stable, and next to the drawing, if there is one: but
    /// for a barrier on the straight way where the other answer is unstable; and where there is no other, wherever the lowest of
    /// all is, or what a structure that does not stay where it is drawn has come down to. If both agree then, the solver and the
    /// comparison.
    fn ask_beside(
        &self,
        drawing_m: Option<&[Vector]>,
        agreement: Option<&SystemAgreement>,
        answers: &mut Vec<SystemEquilibrium>,
        failures: &[SystemFailure],
    ) -> Option<(SolverName, SystemAgreement)> {
        let are_level = agreement.is_some_and(|agreement| {
            let mut excesses = agreement.disagreement.excesses.iter();
            !excesses.any(|excess| matches!(excess.what, Quantity::Energy { .. }))
        });
        let known: Vec<(&SystemEquilibrium, SolverName)> = match (&answers[..], failures) {
            ([known], [failure]) if failure.is_astray(self.system) => {
                vec![(known, failure.solver())]
            }
            ([first, second], []) => {
                // Next to a drawing the nearer one comes first, and else the lower one.
                let [one, other] = [first, second].map(|answer| match drawing_m {
                    Some(at) => Near::of(self.system, at, answer).moved,
                    None => answer.energy_j,
                });
                let (best, rest) = if one < other { (first, second) } else { (second, first) };
                let both = are_level || drawing_m.is_some();
                let rest_too = both.then(|| (rest, best.solver.clone()));
                [(best, rest.solver.clone())].into_iter().chain(rest_too).collect()
            }
            _ => return None,
        };
        if self.question.equations == Equations::Full {
            return None;
        }
        let budget = Tolerances::project().statics;
        let (both, found) = known.into_iter().find_map(|(known, solver)| {
            let unstable = answers.iter().any(|answer| answer.stability.index_in_space > 0);
            let is_next = |at: &[Vector]| {
                let near = Near::of(self.system, at, known);
                let alone = || {
                    known.evidence.ladder.optimal.is_reached() || is_below(self.system, at, known)
                };
                near.is_neighbour || unstable && near.moved <= FAR || answers.len() == 1 && alone()
            };
            let stays = known.stability.index_in_space == 0;
            if !stays || !drawing_m.is_none_or(is_next) || !judge(self.system, known).passes(budget)
            {
                return None;
            }
            let again = self.next_to_by(&known.joints_m, &solver)?;
            let mut both = vec![known.clone(), again];
            both.sort_by_key(|answer| answer.solver != SolverName::LAGRANGE);
            let one = compare(self.system, &mut both, &Tolerances::project());
            // Along motions that cost nothing, but for what is judged as free, the drawing says where; else a common start would.
            let is_placed = drawing_m.is_some() || one.unresisted(known) == 0;
            (one.agrees() && is_placed).then_some((both, (solver, one)))
        })?;
        *answers = both;
        Some(found)
    }

    /// A structure that does not stay where it is drawn, as a mast that has lost a guy, and of which the descent from there
    /// has not come to an end that both solvers know: the lowest equilibrium, if both find it without the drawing. The
    /// comparison.
    fn elsewhere(
        &self,
        answers: &mut Vec<SystemEquilibrium>,
        failures: &[SystemFailure],
    ) -> Option<SystemAgreement> {
        let astray =
            !failures.is_empty() && failures.iter().all(|failure| failure.is_astray(self.system));
        if !astray
            || self.question.solvers != Solvers::Both
            || self.question.equations == Equations::Full
        {
            return None;
        }
        let question = Question { census: UseCensus::Never, ..*self.question };
        let answer = ask_with(&self.system.clone().undrawn(), &question, self.watch);
        let agreement = answer.agreement.filter(SystemAgreement::agrees)?;
        *answers = answer.equilibria;
        Some(agreement)
    }

    /// A lower equilibrium than those found, where members may push and none is proved the lowest: `energy` from places at
    /// random, and if that ends lower both solvers next to it. What both find there, and the comparison, if they agree.
    fn lower(
        &self,
        found: &[SystemEquilibrium],
    ) -> Option<(Vec<SystemEquilibrium>, SystemAgreement)> {
        let pushes = self.system.members().iter().any(|member| member.kind != Kind::Cable);
        let is_asked = self.question.solvers == Solvers::Both
            && self.question.equations != Equations::Full
            && self.question.census != UseCensus::Never;
        let is_lowest = found.iter().any(|answer| answer.evidence.ladder.optimal.is_reached());
        if !is_asked || is_lowest || !pushes || self.system.members().len() > STARTED {
            return None;
        }
        (self.watch)("other starts");
        let known_j = found.iter().map(|answer| answer.energy_j).reduce(f64::min)?;
        let settings = self.question.energy();
        let ends = (1..=STARTS).filter_map(|start| {
            let places_m = scattered(self.system, start);
            Some(energy::net::minimise_from(self.system, &places_m, &settings).ok()?.equilibrium)
        });
        let stable = ends.filter(|end| end.stability.index_in_space == 0);
        let lowest = stable.min_by(|a, b| a.energy_j.total_cmp(&b.energy_j))?;
        let unit_j = self.system.total_load_n() * self.system.total_length_m();
        if lowest.energy_j >= known_j - LOWER * unit_j {
            return None;
        }
        let at_rest = Seed::at_rest(lowest.joints_m);
        let both = self.near_to(&at_rest).into_iter();
        let mut both = both.collect::<Result<Vec<_>, _>>().ok()?;
        let one = compare(self.system, &mut both, &Tolerances::project());
        let is_stable = both.iter().all(|answer| answer.stability.index_in_space == 0);
        (is_stable && one.agrees()).then_some((both, one))
    }

    /// What one solver finds next to an equilibrium.
    fn next_to_by(&self, places_m: &[Vector], solver: &SolverName) -> Option<SystemEquilibrium> {
        let alone =
            if *solver == SolverName::LAGRANGE { Solvers::Lagrange } else { Solvers::Energy };
        let question = Question { solvers: alone, ..*self.question };
        let at_rest = Seed::at_rest(places_m.to_vec());
        Asked { question: &question, ..*self }.near_to(&at_rest).into_iter().flatten().next()
    }

    /// What the solvers find next to some places.
    fn near_to(&self, seed: &Seed) -> Vec<Found> {
        let lagrange = || lagrange::net::solve_from(self.system, seed, &self.question.lagrange());
        let energy =
            || energy::net::minimise_near(self.system, &seed.joints_m, &self.question.energy());
        self.by_each(&|| Ok(lagrange()?.equilibrium), &|| Ok(energy()?.equilibrium))
    }

    /// The lowest equilibrium that each solver finds.
    fn lowest(&self) -> Vec<Found> {
        self.by_each(&|| self.by_lagrange(), &|| self.by_energy())
    }

    /// What each solver finds that is asked, by its own method.
    fn by_each(&self, lagrange: &dyn Fn() -> Found, energy: &dyn Fn() -> Found) -> Vec<Found> {
        let (members, joints) = (self.system.members().len(), self.system.joints().len());
        let mut answers = vec![];
        if self.question.solvers != Solvers::Energy {
            (self.watch)(&format!("lagrange: forces and closures of {members} members"));
            answers.push(lagrange());
        }
        if self.question.solvers != Solvers::Lagrange {
            (self.watch)(&format!("energy: minimisation over the places of {joints} joints"));
            answers.push(energy());
        }
        answers
    }

    /// A row between two anchors by the condensed equations, where these have an answer, or by the paper's; any other system
    /// by all members.
    fn by_lagrange(&self) -> Found {
        if let Some(row) = self.system.as_row() {
            let bars = self.system.members().len();
            if self.question.equations == Equations::Full {
                let found = lagrange::solve(row.problem(), &self.question.full(bars))?;
                return Ok(row.equilibrium(found.equilibrium));
            }
            // The bits of the answer do not depend on how many share the work.
            let mut solver = lagrange::condensed::Solver::with_processors(self.question.threads);
            if let Ok(found) = solver.solve(row.problem(), &self.question.condensed(bars)) {
                drop(solver);
                return Ok(row.equilibrium(found.equilibrium));
            }
        }
        let found = lagrange::net::solve(self.system, &self.question.lagrange())?;
        Ok(found.equilibrium)
    }

    /// A row between two anchors over the directions of its bars, where that has an answer; any other system over the places of its joints.
    fn by_energy(&self) -> Found {
        let usual = energy::Settings::default();
        let max_iterations =
            self.question.passes(self.system.members().len(), usual.max_iterations);
        let settings = energy::Settings { max_iterations, ..usual };
        // One whose bars are not known well enough has no answer.
        let over_directions = |row: &Row| {
            let found = energy::minimise(row.problem(), &settings).ok()?.equilibrium;
            found.evidence.ladder.is_reached(Rung::Converged).then_some(found)
        };
        if let Some((row, found)) =
            self.system.as_row().and_then(|row| Some((row, over_directions(row)?)))
        {
            return Ok(row.equilibrium(found));
        }
        let found = energy::net::minimise(self.system, &self.question.energy())?;
        Ok(found.equilibrium)
    }
}

/// Places of the joints without pattern, as far apart as the longest member and the supports, above the floor.
fn scattered(system: &System, start: usize) -> Vec<Vector> {
    /// Fractions of multiples of the plastic number's powers fill a cube evenly.
    const STEPS: [f64; 3] = [0.819_172_513_396_164, 0.671_043_606_703_789, 0.549_700_477_901_897];
    let longest_m = system.members().iter().map(|m| m.body.length_m()).fold(0.0, f64::max);
    let origin_m = system.reference_m();
    let held = system.joints().iter().filter_map(|joint| joint.support.at_m());
    let reach_m = held.map(|at_m| norm(minus(at_m, origin_m))).fold(2.0 * longest_m, f64::max);
    let floor_m = system.floor_m().unwrap_or(f64::NEG_INFINITY);
    let place = |(k, joint): (usize, &Joint)| {
        let number = (start * 97 + k * 13 + 1) as f64;
        let [x, y, z]: Vector = std::array::from_fn(|axis| {
            origin_m[axis] + reach_m * (2.0 * (number * STEPS[axis]).fract() - 1.0)
        });
        joint.support.nearest_m([x, y, z.max(floor_m)])
    };
    system.joints().iter().enumerate().map(place).collect()
}

/// Answers are compared; a single one is only judged by Newton's laws.
fn judged(
    system: &System,
    equilibria: &mut [SystemEquilibrium],
    failures: &[SystemFailure],
) -> Option<SystemAgreement> {
    match equilibria {
        [] => None,
        [answer] => {
            match failures.first() {
                Some(failure) => {
                    judge_without(system, answer, failure.solver(), NoAnswer::Refused);
                }
                None => judge_alone(system, answer),
            }
            None
        }
        several => Some(compare(system, several, &Tolerances::project())),
    }
}

#[cfg(test)]
mod tests;
