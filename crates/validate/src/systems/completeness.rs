//! The rung `complete` for systems: a census lists every equilibrium, and an answer is one of them
//! or refuted.

use census::Settings;
use census::network::{SystemCensus, SystemPosition};
use model::system::{System, SystemEquilibrium};
use model::{NoCensus, Reason, Status};

use crate::answer::UseCensus;
use crate::tolerances::Tolerances;

/// Systems of up to this many members are looked up in their census without being asked to.
const MEMBERS: usize = 24;

/// Chains in them of up to this many bars, with so many tests for each pattern of signs: a second
/// at most.
const BARS: usize = 8;
const TESTS: u64 = 2_000;

/// The accuracy to which a solver may place a joint, in units of the total length.
const PLACED: f64 = 1e-12;

/// Look the answers up in a census, where one is quick or asked for, and say so on their ladders.
pub fn look_up(system: &System, census: UseCensus, answers: &mut [SystemEquilibrium]) {
    let quick = Settings {
        max_bars: BARS,
        max_bridle_bars: BARS,
        max_tests_per_pattern: TESTS,
        ..Settings::default()
    };
    let census = match census {
        UseCensus::Always => SystemCensus::take(system, &Settings::default()),
        UseCensus::Auto if system.members().len() <= MEMBERS => SystemCensus::take(system, &quick),
        UseCensus::Auto | UseCensus::Never => Err(NoCensus::NotAsked),
    };
    for answer in answers {
        match &census {
            Ok(census) => certify_by_census(system, census, answer),
            Err(because) => {
                answer.evidence.ladder.complete = Status::Open(Reason::NoCensus(*because));
            }
        }
    }
}

/// Say on an answer how far a census carries it. One that a complete list refutes loses what it had
/// reached above `converged`.
pub fn certify_by_census(system: &System, census: &SystemCensus, answer: &mut SystemEquilibrium) {
    let distances = census.equilibria.iter().map(|position| distance(system, position, answer));
    let nearest = distances.min_by(f64::total_cmp);
    let ladder = &mut answer.evidence.ladder;
    let accuracy = Tolerances::project().joints.value + PLACED;
    match nearest {
        Some(distance) if distance <= accuracy => ladder.complete = census.completeness(system),
        Some(distance) if census.complete && census.families() == 0 && distance.is_finite() => {
            ladder.refute(distance);
        }
        Some(distance) => ladder.complete = Status::Open(Reason::Elsewhere { distance }),
        None => ladder.complete = Status::Open(Reason::NothingListed),
    }
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
