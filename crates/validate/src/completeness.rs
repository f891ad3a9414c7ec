//! How far a census carries the answer of a solver: alone in a proven box, and one of a complete list.

use census::{Census, SlackFamily};
use model::{Chain, Equilibrium, Evidence, Problem, Rung};

use crate::census_checks::{nearest, placed};

/// Patterns of tension and compression that a census goes through.
#[must_use]
pub fn patterns(census: &Census) -> u64 {
    2_u64.saturating_pow(u32::try_from(census.statistics.bars).unwrap_or(u32::MAX))
}

/// Say on an answer of a solver how far the census carries it: the rungs `verified` and `complete`.
pub fn certify_by_census(problem: &Problem, census: &Census, answer: &mut Equilibrium) {
    let chain = problem.chain();
    let evidence = &mut answer.evidence;
    let place = nearest(chain, census, &answer.joints_m);
    let listed = place.and_then(|place| Some((place, census.equilibria.get(place.number - 1)?)));
    let Some((place, proven)) = listed.filter(|(place, _)| place.beyond <= placed(chain)) else {
        let why = match place {
            _ if in_family(chain, census, answer.energy_j) => {
                "the answer is one of a family with slack bars, which the census lists as a whole: it is not alone in any \
                 box"
                    .to_owned()
            }
            _ if !census.undecided.is_empty() => format!(
                "the census leaves {} cells of pulls undecided, and this answer is in none of its boxes",
                census.undecided.len()
            ),
            Some(place) => format!(
                "the nearest equilibrium of the census lies {:.1e} of the total length away",
                place.beyond
            ),
            None => "the census lists no equilibrium to compare with".to_owned(),
        };
        evidence.miss(Rung::Verified, why.clone());
        evidence.miss(Rung::Complete, why);
        return;
    };
    evidence.reach(
        Rung::Verified,
        format!(
            "Krawczyk's test in intervals: exactly one equilibrium{} in a box of relative width {:.1e}, and this \
             answer within {:.1e} of the total length of it",
            if proven.circle { " (a circle of them, turned about the anchors)" } else { "" },
            proven.width(),
            place.beyond,
        ),
    );
    complete(census, evidence);
}

/// Whether a family of equilibria with slack bars has this energy, to the rounding of a solver.
fn in_family(chain: &Chain, census: &Census, energy_j: f64) -> bool {
    /// Rounding of an energy, in units of weight times length.
    const ROUNDING: f64 = 1e-12;
    let unit_j = chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m();
    let near = |family: &SlackFamily| (family.energy_j.mid() - energy_j).abs() <= ROUNDING * unit_j;
    census.families.iter().any(near)
}

fn complete(census: &Census, evidence: &mut Evidence) {
    if census.complete {
        evidence.reach(
            Rung::Complete,
            format!(
                "one of {} in the plane{}, and no other: {} patterns of tension and compression excluded everywhere \
                 else, in {} cells of pulls",
                census.count_in_plane(),
                match census.families.len() {
                    0 => String::new(),
                    1 => ", besides a family with slack bars".to_owned(),
                    families => format!(", besides {families} families with slack bars"),
                },
                patterns(census),
                census.statistics.cells,
            ),
        );
    } else {
        let why = match &census.topology {
            Err(error) if census.undecided.is_empty() => error.to_string(),
            _ => format!("{} cells of pulls are undecided", census.undecided.len()),
        };
        evidence.miss(Rung::Complete, why);
    }
}
