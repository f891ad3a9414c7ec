//! The rung `complete` for systems: a census lists every equilibrium, and an answer is one of them
//! or refuted.

use census::Settings;
use census::net::{SystemCensus, SystemPosition};
use model::system::{System, SystemEquilibrium};
use model::{NoCensus, Reason, Status, Vector};

use super::near::LOWER;
use crate::question::UseCensus;
use crate::tolerances::Tolerances;

/// Systems of up to this many members are looked up in their census without being asked to.
const MEMBERS: usize = 24;

/// Chains in them of up to this many bars, with so many tests for each pattern of signs: a second
/// at most.
const BARS: usize = 8;
const TESTS: u64 = 2_000;

/// The accuracy to which a solver may place a joint, in units of the total length.
const PLACED: f64 = 1e-12;

/// The census of a system, if that is a matter of a second.
///
/// # Errors
/// [`NoCensus`]; of a large system, that it was not asked for.
pub fn quick_census(system: &System) -> Result<SystemCensus, NoCensus> {
    let quick = Settings { max_bars: BARS, max_tests_per_pattern: TESTS, ..Settings::default() };
    if system.members().len() > MEMBERS {
        return Err(NoCensus::NotAsked);
    }
    SystemCensus::take(system, &quick)
}

/// The census that is wanted.
///
/// # Errors
/// [`NoCensus`]; also that it was not asked for.
pub fn wanted_census(system: &System, census: UseCensus) -> Result<SystemCensus, NoCensus> {
    match census {
        UseCensus::Always => SystemCensus::take(system, &Settings::default()),
        UseCensus::Auto => quick_census(system),
        UseCensus::Never => Err(NoCensus::NotAsked),
    }
}

/// The lowest equilibrium of a complete census, as long as it is stable, there are answers, and none is lower; of
/// several, the one that the first of the answers is in. (Where no solver has an answer, what is listed may stand on
/// struts above a fall without end.)
pub(super) fn lowest_listed<'a>(
    system: &System,
    census: &'a SystemCensus,
    answers: &[&SystemEquilibrium],
) -> Option<&'a SystemPosition> {
    if !census.complete || census.families() > 0 || answers.is_empty() {
        return None;
    }
    let listed = census.equilibria.iter();
    let least_j = listed.clone().map(|position| position.energy_j.hi()).min_by(f64::total_cmp)?;
    let rounding_j = LOWER * system.total_load_n() * system.total_length_m();
    if answers.iter().any(|answer| answer.energy_j < least_j - rounding_j) {
        return None;
    }
    let mut lowest = listed.filter(|position| position.energy_j.lo() <= least_j + rounding_j);
    let first = lowest.clone().next();
    let holds =
        |position: &&SystemPosition| answers.iter().any(|answer| is_at(system, position, answer));
    lowest.find(holds).or(first)
}

/// Whether an answer is that position, to the accuracy that solvers are held to.
pub(super) fn is_at(system: &System, at: &SystemPosition, answer: &SystemEquilibrium) -> bool {
    distance(system, at, answer) <= Tolerances::project().joints + PLACED
}

/// Look the answers up in the census that was wanted, and say on their ladders what it knows of them.
pub fn look_up(
    system: &System,
    census: &Result<SystemCensus, NoCensus>,
    answers: &mut [SystemEquilibrium],
) {
    for answer in answers {
        match census {
            Ok(census) => certify_by_census(system, census, answer),
            Err(because) => {
                let verified = answer.evidence.ladder.verified.is_reached();
                let asked = verified && *because != NoCensus::NotAsked;
                let only = || SystemCensus::of_cables(system, &answer.joints_m, &answer.axial_n);
                match asked.then(only).flatten() {
                    Some(census) => certify_by_census(system, &census, answer),
                    None => {
                        answer.evidence.ladder.complete = Status::Open(Reason::NoCensus(*because));
                    }
                }
            }
        }
    }
}

/// Say on an answer how far a census carries it. One that a complete list refutes loses what it had
/// reached above `converged`.
pub fn certify_by_census(system: &System, census: &SystemCensus, answer: &mut SystemEquilibrium) {
    let distances = census.equilibria.iter().map(|position| distance(system, position, answer));
    let nearest = distances.min_by(f64::total_cmp);
    let accuracy = Tolerances::project().joints + PLACED;
    if nearest.is_some_and(|distance| distance <= accuracy) {
        answer.evidence.ladder.complete = census.completeness(system);
        return;
    }
    let is_whole = census.complete && census.families() == 0;
    let because = unlisted_row(system, census, answer).unwrap_or(match nearest {
        Some(distance) if is_whole && distance.is_finite() => Reason::RefutedByCensus { distance },
        Some(distance) => Reason::Elsewhere { distance },
        None => Reason::NothingListed,
    });
    let ladder = &mut answer.evidence.ladder;
    match because {
        Reason::RefutedByCensus { distance } => ladder.refute(distance),
        because => ladder.complete = Status::Open(because),
    }
}

/// Why the census of a row does not list an answer: it also knows straight positions
/// and families with slack bars.
fn unlisted_row(
    system: &System,
    census: &SystemCensus,
    answer: &SystemEquilibrium,
) -> Option<Reason> {
    let row = system.as_row()?;
    let of_row = census.chains().find(|chain| chain.joints.iter().copied().eq(row.joints()))?;
    let joints_m: Vec<Vector> =
        row.joints().map(|k| answer.joints_m.get(k).copied()).collect::<Option<_>>()?;
    let chain = row.problem().chain();
    Some(crate::completeness::unlisted(chain, &of_row.census, &joints_m, answer.energy_j))
}

/// How far outside of a listed position the worst coordinate of an answer lies, in units of the
/// total length; of what turns freely the heights alone count. NaN is infinitely far.
fn distance(system: &System, position: &SystemPosition, answer: &SystemEquilibrium) -> f64 {
    if position.joints_m.len() != answer.joints_m.len() {
        return f64::INFINITY;
    }
    let axes = if position.circle { 2..3 } else { 0..3 };
    let places = position.joints_m.iter().zip(&answer.joints_m);
    let apart = places.flat_map(|(enclosure, at)| {
        axes.clone().map(|k| (enclosure[k].lo() - at[k]).max(at[k] - enclosure[k].hi()))
    });
    let worst_m =
        apart.fold(0.0, |most: f64, x| if x.is_nan() { f64::INFINITY } else { most.max(x) });
    worst_m / system.total_length_m()
}

#[cfg(test)]
mod tests;
