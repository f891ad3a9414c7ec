//! How far a census carries the answer of a solver: alone in a proven box, and one of a complete
//! list.

use census::{Census, SlackFamily};
use model::{Chain, Equilibrium, Problem, Reason, Status, Vector, Verified};

use crate::census_checks::{Nearest, nearest, nearest_straight, placed};
use crate::tolerances::Tolerances;

/// Say on an answer of a solver how far the census carries it: the rungs `verified` and `complete`.
/// An answer that a complete census refutes loses what it had reached above `converged`.
///
/// ```
/// use census::{Census, Settings};
/// use model::Rung;
/// use validate::completeness::certify_by_census;
/// let problem = model::cases::paper();
/// let mut found = lagrange::solve(&problem, &lagrange::Settings::default())?.equilibrium;
/// let census = Census::take(&problem, &Settings::default())?;
/// certify_by_census(&problem, &census, &mut found);
/// assert!(found.evidence.ladder.is_reached(Rung::Verified));
/// // A joint a millimetre off is at none of the listed equilibria.
/// found.joints_m[1][2] += 1e-3;
/// certify_by_census(&problem, &census, &mut found);
/// assert!(!found.evidence.ladder.is_reached(Rung::Verified));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certify_by_census(problem: &Problem, census: &Census, answer: &mut Equilibrium) {
    let chain = problem.chain();
    let ladder = &mut answer.evidence.ladder;
    let place = nearest(chain, census, &answer.joints_m);
    let listed = place.and_then(|place| Some((place, census.equilibria.get(place.number - 1)?)));
    if let Some((place, proven)) = listed.filter(|(place, _)| place.beyond <= placed(chain)) {
        ladder.verified = Status::Reached(Verified {
            box_width: proven.width(),
            distance: place.beyond,
            circle: proven.circle,
            system: None,
        });
        ladder.complete = census.completeness();
    } else {
        match unlisted(chain, census, &answer.joints_m, answer.energy_j) {
            Reason::RefutedByCensus { distance } => ladder.refute(distance),
            reason => {
                ladder.verified = Status::Open(reason.clone());
                ladder.complete = Status::Open(reason);
            }
        }
    }
}

/// Why an answer is not among the isolated equilibria of the list.
pub(crate) fn unlisted(
    chain: &Chain,
    census: &Census,
    joints_m: &[Vector],
    energy_j: f64,
) -> Reason {
    let near = |distance: Option<f64>| distance.filter(|distance| !refutes(chain, *distance));
    if let Some(distance) = near(nearest_straight(chain, census, joints_m)) {
        Reason::AtStraight { distance }
    } else {
        not_listed(chain, census, nearest(chain, census, joints_m), energy_j)
    }
}

/// The same where it is at no other position that the census names.
fn not_listed(chain: &Chain, census: &Census, place: Option<Nearest>, energy_j: f64) -> Reason {
    if in_family(chain, census, energy_j) {
        return Reason::SlackFamily;
    }
    match (census.undecided.len(), place) {
        (0, Some(place)) if census.complete && refutes(chain, place.beyond) => {
            Reason::RefutedByCensus { distance: place.beyond }
        }
        (0, Some(place)) => Reason::Elsewhere { distance: place.beyond },
        (0, None) => Reason::NothingListed,
        (cells, _) => Reason::NotAmongDecided { cells },
    }
}

/// Whether an answer at this distance of all equilibria differs from them, to the accuracy that
/// answers are asked to agree to.
fn refutes(chain: &Chain, distance: f64) -> bool {
    distance > Tolerances::project().joints + placed(chain)
}

/// Whether a family of equilibria with slack bars has this energy, to the rounding of a solver.
fn in_family(chain: &Chain, census: &Census, energy_j: f64) -> bool {
    /// Rounding of an energy, in units of weight times length.
    const ROUNDING: f64 = 1e-12;
    let unit_j = chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m();
    let near = |family: &SlackFamily| (family.energy_j.mid() - energy_j).abs() <= ROUNDING * unit_j;
    census.families.iter().any(near)
}

#[cfg(test)]
mod tests;
