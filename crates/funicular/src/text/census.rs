//! The census, for people.

use std::fmt::{self, Write as _};

use model::Rung;

use super::tables::{
    duration, fitted, long, numbers_from, rung, short, significant, system_line, table, vector,
    word, wrapped,
};
use crate::census::{CensusAnswer, ChainCensusAnswer, Found, LargeCensusAnswer, Summary};

/// So many equilibria are printed; `--json` and `--csv` have all.
const PRINTED: usize = 40;

/// Digits of an energy in joules: in its own unit it has all.
const ENERGY_DIGITS: usize = 10;

/// So many lines of bars are printed, those of whole equilibria; of the first one in any case.
const PRINTED_BARS: usize = 80;

/// So many undecided boxes and slack families are printed.
const PRINTED_OPEN: usize = 12;

/// Where the sentences of the ladder begin.
const LADDER_INDENT: usize = 14;

/// As `funicular census` prints it.
impl fmt::Display for ChainCensusAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(self))
    }
}

/// The same of its first equilibria.
impl fmt::Display for LargeCensusAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.first.fmt(f)
    }
}

/// The same of any system.
impl fmt::Display for CensusAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Chain(found) => found.fmt(f),
            Self::System(found) => found.fmt(f),
        }
    }
}

/// The whole answer.
fn text(answer: &ChainCensusAnswer) -> String {
    let mut text = system_line(&answer.system);
    text += &headline(&answer.census);
    if !answer.equilibria.is_empty() {
        text += &overview(answer);
        text += &reactions(answer);
        text += &bars(answer);
        text += &evidence(answer);
    }
    text += &families(&answer.census);
    text += &merged(&answer.census);
    text += &undecided(&answer.census);
    text += &sums(&answer.census);
    fitted(&text)
}

fn plural<'a>(number: usize, one: &'a str, many: &'a str) -> &'a str {
    if number == 1 { one } else { many }
}

/// What was found, in a sentence.
fn headline(census: &Summary) -> String {
    let mut text = format!(
        "{} {} in a vertical plane",
        census.count,
        plural(census.count, "equilibrium", "equilibria")
    );
    if let Some(circles) = census.circle_count {
        // Both images of a circle are listed.
        let _ = write!(
            text,
            ", {circles} {} in space (any turn about the anchors' vertical is one more)",
            plural(circles, "circle", "circles")
        );
    }
    let slack = census.slack_families.len();
    if slack > 0 {
        let _ = write!(text, ", {slack} {} of slack bars", plural(slack, "family", "families"));
    }
    let merged = census.degenerate.len();
    if merged > 0 {
        let _ = write!(text, ", {merged} degenerate {}", plural(merged, "one", "ones"));
    }
    let upright = census.straight.iter().filter(|straight| straight.upright).count();
    if upright > 0 {
        let _ = write!(
            text,
            ", {upright} upright {} with any force",
            plural(upright, "position", "positions")
        );
    }
    text += if census.decided { ": proved to be all." } else { ": NOT proved to be all." };
    wrapped(&text, 0) + "\n\n"
}

fn overview(answer: &ChainCensusAnswer) -> String {
    // The paper counts the energy of its example from the last anchor, 2 l below the first.
    let anchors = answer.problem.chain().anchors();
    let [start, end] = [anchors.start_m[2], anchors.end_m[2]];
    let shift_j = answer.system.total_mass_kg * answer.system.gravity_m_s2 * (start - end);
    let shift = shift_j / answer.census.energy_unit_j;
    let unit = answer.census.energy_symbol;
    let scaled = format!("V / {unit}");
    let from_end = format!("V / {unit} from end");
    let other_zero = answer.census.circles && shift.abs() > 0.0;
    let mut rows = table(["#", "energy / J", "bars", "in plane", "in space", "box", "rung"]);
    let mut energies = table(["#", &scaled].into_iter().chain(other_zero.then_some(&*from_end)));
    for found in answer.equilibria.iter().take(PRINTED) {
        let e = &found.equilibrium;
        let from_end = other_zero.then(|| long(found.energy_scaled + shift));
        energies
            .add_row([found.label.clone(), long(found.energy_scaled)].into_iter().chain(from_end));
        rows.add_row([
            found.label.clone(),
            significant(e.energy_j, ENERGY_DIGITS),
            pattern(&found.signs),
            format!("{} ({})", word(&e.stability.in_plane), e.stability.index_in_plane),
            format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space),
            format!("{:.0e}", found.box_width),
            rung(&e.evidence),
        ]);
    }
    numbers_from(&mut rows, 1);
    numbers_from(&mut energies, 1);
    let mut text = format!("{rows}\n");
    left_out(&mut text, answer.census.count, PRINTED, "equilibria");
    let _ = writeln!(
        text,
        "Bars from the start, T in tension, C in compression{}. In brackets: the number of directions in which the \
         energy falls.\nBox: the largest relative width of the enclosures that prove the equilibrium.{}\n\n\
         Energy V from the height of joint 0{}; {unit}: {}:\n{energies}\n",
        if answer.equilibria.iter().any(|found| found.signs.contains(&0)) {
            ", a dot next to nothing"
        } else {
            ""
        },
        if answer.census.circles {
            "\n1' is the mirror image of 1, on the same circle."
        } else {
            ""
        },
        if other_zero { " (from end: of the last anchor)" } else { "" },
        answer.census.energy_unit,
    );
    text
}

/// What a bar does, by its sign.
fn carries(sign: i8) -> &'static str {
    match sign {
        1 => "tension",
        -1 => "compression",
        _ => "nothing",
    }
}

/// `TTC`; bars without force are dots.
fn pattern(signs: &[i8]) -> String {
    signs
        .iter()
        .map(|sign| match sign {
            1 => 'T',
            -1 => 'C',
            _ => '.',
        })
        .collect()
}

fn left_out(text: &mut String, all: usize, printed: usize, what: &str) {
    if all > printed {
        let _ = writeln!(
            text,
            "... and {} {what} more: --json or --csv FILE have them all.",
            all - printed
        );
    }
}

/// The forces of the ground.
fn reactions(answer: &ChainCensusAnswer) -> String {
    let mut rows = table(["#", "force at start / N", "force at end / N"]);
    for found in answer.equilibria.iter().take(PRINTED) {
        let reactions = &found.equilibrium.reactions_n;
        rows.add_row([found.label.clone(), vector(reactions.start), vector(reactions.end)]);
    }
    numbers_from(&mut rows, 1);
    let mut text = format!("Forces of the ground on the chain:\n{rows}\n");
    left_out(&mut text, answer.census.count, PRINTED, "equilibria");
    text + "\n"
}

/// Angles and forces, bar by bar.
fn bars(answer: &ChainCensusAnswer) -> String {
    let printed = (PRINTED_BARS / answer.system.bars.max(1)).clamp(1, PRINTED);
    let mut rows = table(["#", "bar", "angle / deg", "signed / deg", "known to", "axial / N", ""]);
    for found in answer.equilibria.iter().take(printed) {
        let forces = found.equilibrium.axial_forces();
        for (k, angle) in found.angles_deg.iter().enumerate() {
            let axial = forces.get(k).map_or_else(String::new, |along| short(along.largest_n()));
            let width = found.enclosures.angles_rad.get(k).map_or(0.0, |[low, high]| high - low);
            rows.add_row([
                if k == 0 { found.label.clone() } else { String::new() },
                (k + 1).to_string(),
                long(*angle),
                found.angles_signed_deg.get(k).copied().map_or_else(String::new, long),
                format!("{:.0e}", width.to_degrees()),
                axial,
                carries(found.signs.get(k).copied().unwrap_or_default()).to_owned(),
            ]);
        }
    }
    numbers_from(&mut rows, 1);
    let mut text = format!(
        "Angles from the descending vertical, towards the last anchor (on one vertical: towards +Y):\n{rows}\n"
    );
    left_out(&mut text, answer.census.count, printed, "equilibria with their angles and forces");
    text + "\n"
}

/// How far the equilibria are proved, rung by rung: every reason once, with the equilibria it holds
/// for.
fn evidence(answer: &ChainCensusAnswer) -> String {
    let all = answer.equilibria.len();
    let mut text = match answer.census.count {
        count if count > all => format!("Evidence of the first {all} of {count}:\n"),
        _ => "Evidence:\n".to_owned(),
    };
    for step in Rung::ALL.into_iter().filter(|rung| *rung != Rung::Converged) {
        let reached = |found: &&Found| found.equilibrium.evidence.ladder.is_reached(step);
        let there: Vec<&Found> = answer.equilibria.iter().filter(reached).collect();
        let how = |found: Option<&Found>| {
            found.map_or_else(String::new, |found| found.equilibrium.evidence.ladder.how(step))
        };
        let missed = answer.equilibria.iter().find(|found| !reached(found));
        let mark = if there.is_empty() { '-' } else { '+' };
        let mut line = format!("  {mark} {:<9} {} of {all}", step.to_string(), there.len());
        // Of many, the one with the widest box speaks for all.
        if let Some(widest) = there.iter().max_by(|a, b| a.box_width.total_cmp(&b.box_width)) {
            line = format!("{line}: {}", how(Some(widest)));
        }
        if let Some(missed) = missed {
            line = format!("{line}; not {}: {}", missed.label, how(Some(missed)));
        }
        text += &wrapped(&line, LADDER_INDENT);
        text.push('\n');
    }
    text + "\n"
}

fn families(census: &Summary) -> String {
    if census.slack_families.is_empty() {
        return String::new();
    }
    let mut rows =
        table(["bars", "energy / J", "gap / m", "dimension", "index in plane", "index in space"]);
    let middle = |[low, high]: [f64; 2]| 0.5 * low + 0.5 * high;
    for family in census.slack_families.iter().take(PRINTED_OPEN) {
        rows.add_row([
            pattern(&family.signs),
            long(middle(family.energy_j)),
            short(middle(family.gap_m)),
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
    if census.slack_families.iter().any(|family| !family.is_manifold) {
        text +=
            "* no manifold: the slack bars also fit into one line, or close upon themselves folded";
        text += if census.decided { "; no other equilibrium is near.\n" } else { ".\n" };
    }
    left_out(&mut text, census.slack_families.len(), PRINTED_OPEN, "families");
    text + "\n"
}

/// Equilibria at which several have merged.
fn merged(census: &Summary) -> String {
    if census.degenerate.is_empty() {
        return String::new();
    }
    let mut rows = table(["bars", "energy / J", "multiplicity", "degree", "angles / deg"]);
    for merged in census.degenerate.iter().take(PRINTED_OPEN) {
        let angle = |[low, high]: &[f64; 2]| short((0.5 * low + 0.5 * high).to_degrees());
        let [low, high] = merged.energy_j;
        rows.add_row([
            pattern(&merged.signs),
            long(0.5 * low + 0.5 * high),
            match merged.multiplicity {
                Some(2) => "2 (a fold)".to_owned(),
                Some(number) => number.to_string(),
                None => "a family".to_owned(),
            },
            merged.degree.to_string(),
            merged.angles_rad.iter().map(angle).collect::<Vec<_>>().join(", "),
        ]);
    }
    numbers_from(&mut rows, 1);
    let mut text = format!(
        "Degenerate equilibria, at which several have merged (bars with a dot carry nothing; the second derivative \
         of the energy\nvanishes in some direction; degree: the sum of (-1)^index over those into which it falls apart \
         when the chain is changed a little):\n{rows}\n"
    );
    left_out(&mut text, census.degenerate.len(), PRINTED_OPEN, "of them");
    text + "\n"
}

fn undecided(census: &Summary) -> String {
    if census.undecided.is_empty() {
        return String::new();
    }
    let mut rows = table(["pull, level / N", "pull, upright / N", "patterns", "first", "why"]);
    for open in census.undecided.iter().take(PRINTED_OPEN) {
        let [level, upright] = open.pull_n.map_or_else(
            || ["unbounded".to_owned(), "unbounded".to_owned()],
            |parts| parts.map(|[low, high]| format!("{} .. {}", short(low), short(high))),
        );
        rows.add_row([
            level,
            upright,
            open.pattern_count.to_string(),
            open.patterns.first().map_or_else(String::new, |signs| pattern(signs)),
            match open.at_most {
                Some(number) => format!("{}; at most {number} equilibria", open.why),
                None => open.why.clone(),
            },
        ]);
    }
    let mut text = format!(
        "Undecided: {} {} of pulls on the first anchor may hold more equilibria, or none:\n{rows}\n",
        census.undecided.len(),
        plural(census.undecided.len(), "box", "boxes"),
    );
    left_out(&mut text, census.undecided.len(), PRINTED_OPEN, "boxes");
    text + "\n"
}

/// What the check proved, and what it did not.
fn check_line(census: &Summary) -> String {
    let listed = "Check: every equilibrium listed is proved again without the search";
    match (&census.check.failure, census.check.refuted) {
        (None, _) if census.decided && census.euler_characteristic.is_none() => {
            format!("{listed}. That the list is complete rests on the search alone.")
        }
        (None, _) if census.decided => format!(
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
fn straight(census: &Summary) -> String {
    let Some(first) = census.straight.first() else { return String::new() };
    let count = census.straight.len();
    let ways = format!(
        "In {count} {} the bars lie in the line between the anchors ({}: + towards the last, - back",
        plural(count, "position", "positions"),
        pattern(&first.along)
    );
    let what = match (first.upright, census.decided) {
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
fn sums(census: &Summary) -> String {
    let mut text = String::new();
    let manifolds = census.slack_families.iter().all(|family| family.is_manifold);
    match (&census.euler_characteristic, &census.betti) {
        (Some(euler), Some(_)) if !manifolds => {
            let _ = writeln!(
                text,
                "By index in the plane: {:?}, without the families marked *, whose part in the sum of (-1)^index is not \
                 known. Sum without them: {}. Euler characteristic of the configuration space, from the lengths alone: \
                 {euler}.",
                census.count_by_index, census.alternating_sum,
            );
        }
        (Some(euler), Some(betti)) => {
            let _ = writeln!(
                text,
                "By index in the plane: {:?}. Sum of (-1)^index: {}. Euler characteristic of the configuration space, from \
                 the lengths alone: {euler} (Betti numbers {betti:?}).",
                census.count_by_index, census.alternating_sum,
            );
        }
        _ => {
            let _ = writeln!(
                text,
                "By index in the plane: {:?}. No Euler characteristic to compare with: {}.",
                census.count_by_index,
                census.topology_unknown.as_deref().unwrap_or("not known"),
            );
        }
    }
    text += &straight(census);
    let _ = writeln!(text, "{}", check_line(census));
    let s = &census.statistics;
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
    use census::{Census, CheckError, Settings};

    use super::*;

    #[test]
    fn a_proof_that_fails_is_not_told_as_a_refutation() {
        let problem = model::cases::paper();
        let census = Census::take(&problem, &Settings::default()).unwrap();
        let line =
            |verdict| check_line(&ChainCensusAnswer::new(&problem, census.clone(), verdict).census);
        assert!(
            line(Ok(())).contains("is proved again")
                && line(Ok(())).contains("rests on the search")
        );
        let refuted = line(Err(CheckError::Empty { number: 2 }));
        assert_eq!(refuted, "Check FAILED: the neighbourhood of equilibrium 2 holds none.");
        let open = line(Err(CheckError::NotOne { number: 2 }));
        assert!(open.starts_with("Check NOT DECIDED") && open.contains("is not proved to hold"));
        assert!(!open.contains("FAILED"));
    }
}
