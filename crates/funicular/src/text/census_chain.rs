//! What the census of a chain says besides its equilibria, for people.

use std::fmt::Write as _;

use super::census::{left_out, pattern, plural};
use super::tables::{duration, long, numbers_from, short, table};
use crate::census::Chain;

/// So many undecided boxes and slack families are printed.
const PRINTED_OPEN: usize = 12;

/// All that is known of its list.
pub(super) fn text(chain: &Chain) -> String {
    families(chain) + &undecided(chain) + &sums(chain)
}

fn families(chain: &Chain) -> String {
    if chain.slack_families.is_empty() {
        return String::new();
    }
    let mut rows =
        table(["bars", "energy / J", "gap / m", "dimension", "index in plane", "index in space"]);
    for family in chain.slack_families.iter().take(PRINTED_OPEN) {
        rows.add_row([
            pattern(&family.signs),
            long(family.energy_j.mid()),
            short(family.gap_m.mid()),
            format!("{}{}", family.dimension_in_plane, if family.is_manifold { "" } else { " *" }),
            family.index_in_plane.to_string(),
            family.index_in_space.to_string(),
        ]);
    }
    numbers_from(&mut rows, 1);
    let mut text = format!(
        "Families of equilibria in which the bars with a dot are slack (they carry nothing and bridge the gap in any \
         way they can;\nthe dimension is that in the plane, where two slack bars have two ways):\n{rows}\n"
    );
    if chain.slack_families.iter().any(|family| !family.is_manifold) {
        text += "* not a manifold: the slack bars also fit into one line, or close upon themselves folded";
        text += if chain.decided { "; no other equilibrium is near.\n" } else { ".\n" };
    }
    left_out(&mut text, chain.slack_families.len(), PRINTED_OPEN, "families");
    text + "\n"
}

fn undecided(chain: &Chain) -> String {
    if chain.undecided.is_empty() {
        return String::new();
    }
    let mut rows = table(["pull, level / N", "pull, upright / N", "patterns", "first", "why"]);
    for open in chain.undecided.iter().take(PRINTED_OPEN) {
        let [level, upright] = open.pull_n.map_or_else(
            || ["unbounded".to_owned(), "unbounded".to_owned()],
            |parts| parts.map(|part| format!("{} .. {}", short(part.lo()), short(part.hi()))),
        );
        rows.add_row([
            level,
            upright,
            open.pattern_count.to_string(),
            open.patterns.first().map_or_else(String::new, |signs| pattern(signs)),
            open.why.clone(),
        ]);
    }
    let mut text = format!(
        "Undecided: {} {} of pulls on the first anchor may hold more equilibria, or none:\n{rows}\n",
        chain.undecided.len(),
        plural(chain.undecided.len(), "box", "boxes"),
    );
    left_out(&mut text, chain.undecided.len(), PRINTED_OPEN, "boxes");
    text + "\n"
}

/// What the check proved, and what it did not.
fn check_line(chain: &Chain) -> String {
    let listed = "Check: every equilibrium listed is proved again without the search";
    match (&chain.check.failure, chain.check.refuted) {
        (None, _) if chain.decided && chain.euler_characteristic.is_none() => {
            format!("{listed}. That the list is complete rests on the search alone.")
        }
        (None, _) if chain.decided => format!(
            "{listed}. That the list is complete rests on the search: the check would see if one alone, the lowest \
             or the highest were missing, not every pair."
        ),
        (None, _) => format!("{listed}."),
        (Some(failure), true) => format!("Check FAILED: {failure}."),
        (Some(failure), false) => {
            format!("Check NOT DECIDED: {failure}. Nothing is shown to be wrong.")
        }
    }
}

/// Positions in which the bars lie in one line.
fn straight(chain: &Chain) -> String {
    let Some(first) = chain.straight.first() else { return String::new() };
    let count = chain.straight.len();
    let ways = format!(
        "In {count} {} the bars lie in the line between the anchors ({}: + towards the last, - back",
        plural(count, "position", "positions"),
        pattern(&first.along)
    );
    let what = match (first.upright, chain.decided) {
        (true, true) => {
            "). They hang or stand upright: equilibria too,\nunder any force along them, a family each; no other \
             equilibrium is near any of these"
        }
        (true, false) => {
            "). They hang or stand upright: equilibria too,\nbut the force along them is not determined"
        }
        (false, true) => {
            "). No force holds them there, the energy\nrises and falls from them, and no equilibrium is near"
        }
        (false, false) => ").\nNo force holds them there, and the energy rises and falls from them",
    };
    format!("{ways}{what}.\n")
}

/// The cross-checks, and what it took.
fn sums(chain: &Chain) -> String {
    let mut text = String::new();
    let manifolds = chain.slack_families.iter().all(|family| family.is_manifold);
    match (&chain.euler_characteristic, &chain.betti) {
        (Some(euler), Some(_)) if !manifolds => {
            let _ = writeln!(
                text,
                "By index in the plane: {:?}, without the families marked *, whose part in the sum of (-1)^index is not \
                 known. Sum without them: {}. Euler characteristic of the configuration space, from the lengths alone: \
                 {euler}.",
                chain.count_by_index, chain.alternating_sum,
            );
        }
        (Some(euler), Some(betti)) => {
            let _ = writeln!(
                text,
                "By index in the plane: {:?}. Sum of (-1)^index: {}. Euler characteristic of the configuration space, from \
                 the lengths alone: {euler} (Betti numbers {betti:?}).",
                chain.count_by_index, chain.alternating_sum,
            );
        }
        _ => {
            let _ = writeln!(
                text,
                "By index in the plane: {:?}. No Euler characteristic to compare with: {}.",
                chain.count_by_index,
                chain.topology_unknown.as_deref().unwrap_or("not known"),
            );
        }
    }
    text += &straight(chain);
    let _ = writeln!(text, "{}", check_line(chain));
    let s = &chain.statistics;
    let _ = writeln!(
        text,
        "{} cells of pulls, {} proofs of existence, {}.",
        s.cells,
        s.proofs,
        duration(s.seconds)
    );
    text
}

#[cfg(test)]
mod tests {
    use census::CheckError;

    use super::*;
    use crate::census::Check;

    #[test]
    fn a_proof_that_fails_is_not_told_as_a_refutation() {
        let problem = crate::Problem::case("three-equal-bars").unwrap();
        let answer = crate::Census::new().run(&problem).unwrap();
        let line = |failure: Option<CheckError>| {
            let mut chain = answer.census.chains().next().unwrap().clone();
            chain.check = Check {
                passed: failure.is_none(),
                refuted: failure.as_ref().is_some_and(CheckError::refutes),
                failure: failure.map(|error| error.to_string()),
            };
            check_line(&chain)
        };
        assert!(
            line(None).contains("is proved again") && line(None).contains("rests on the search")
        );
        let refuted = line(Some(CheckError::Empty { number: 2 }));
        assert_eq!(refuted, "Check FAILED: the neighbourhood of equilibrium 2 holds none.");
        let open = line(Some(CheckError::NotOne { number: 2 }));
        assert!(open.starts_with("Check NOT DECIDED") && open.contains("is not proved to hold"));
        assert!(!open.contains("FAILED"));
    }
}
