//! The census, for people.

use std::fmt::{self, Write as _};

use model::Rung;
use model::system::System;

use super::answer::system_line;
use super::census_chain;
use super::printable::Printable;
use super::tables::{
    counted, fitted, long, numbers_from, rung, short, significant, table, vector, word, wrapped,
};
use crate::census::{CensusAnswer, Found, InRow, LargeCensusAnswer};

/// So many equilibria are printed; `--json` and `--csv` have all.
const PRINTED: usize = 40;

/// Digits of an energy in joules where it also stands in its own unit, with all.
const ENERGY_DIGITS: usize = 10;

/// So many lines of members are printed, those of whole equilibria; of the first one in any case.
const PRINTED_MEMBERS: usize = 80;

/// Where the sentences of the ladder begin.
const LADDER_INDENT: usize = 14;

/// As `funicular census` prints it.
impl fmt::Display for CensusAnswer {
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

/// The whole answer.
fn text(answer: &CensusAnswer) -> String {
    let mut text = system_line(answer.system()) + "\n" + &headline(answer);
    if !answer.equilibria.is_empty() {
        text += &overview(answer);
        text += &energies(answer);
        text += &joints(answer);
        text += &members(answer);
        text += &evidence(answer);
    }
    text += &chains(answer);
    text += &nets(answer);
    fitted(&text)
}

pub(crate) fn plural<'a>(number: usize, one: &'a str, many: &'a str) -> &'a str {
    if number == 1 { one } else { many }
}

/// What was found, in a sentence.
fn headline(answer: &CensusAnswer) -> String {
    let census = &answer.census;
    let mut text =
        format!("{} {}", census.count, plural(census.count, "equilibrium", "equilibria"));
    let circles = answer.row().and(census.chains().next()).map(|chain| chain.circle_count);
    match circles {
        // Both images of a circle are listed.
        Some(Some(circles)) => {
            let _ = write!(
                text,
                " in a vertical plane, {circles} {} in space (any turn about the anchors' vertical is one more)",
                plural(circles, "circle", "circles")
            );
        }
        Some(None) => text += " in a vertical plane",
        None if census.circles => {
            text += ", each with all its turns about the vertical through its anchors";
        }
        None => {}
    }
    if census.parts.len() > 1 && census.parts.iter().all(|part| part.slack.is_empty()) {
        let parts: Vec<_> = census.parts.iter().map(|part| part.count.to_string()).collect();
        let _ = write!(text, " ({} of parts that move without each other)", parts.join(" times "));
    }
    let upright = census.chains().flat_map(|chain| &chain.straight).filter(|at| at.upright).count();
    for (number, one, many) in [
        (census.slack_families, "family of slack bars", "families of slack bars"),
        (upright, "upright position with any force", "upright positions with any force"),
    ] {
        if number > 0 {
            let _ = write!(text, ", {number} {}", plural(number, one, many));
        }
    }
    text += if census.decided { ": proved to be all." } else { ": NOT proved to be all." };
    wrapped(&text, 0) + "\n\n"
}

/// The equilibria that are printed in so many lines each, with their labels, and of a row of bars what only its census
/// knows.
fn printed(answer: &CensusAnswer, number: usize) -> impl Iterator<Item = (String, &Found)> {
    answer.equilibria.iter().take(number).enumerate().map(|(k, found)| (found.label(k), found))
}

fn overview(answer: &CensusAnswer) -> String {
    let is_row = answer.row().is_some();
    let of_row = |names: &'static [&'static str]| names.iter().copied().filter(move |_| is_row);
    let lowest = (!is_row).then_some("lowest joint / m");
    let names = ["#", "energy / J"].into_iter().chain(of_row(&["bars", "in plane"]));
    let names = names.chain(["in space"]).chain(lowest).chain(["box", "rung"]);
    let mut rows = table(names);
    for (label, found) in printed(answer, PRINTED) {
        let e = &found.equilibrium;
        let in_space = format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space);
        let index = e.stability.index_in_plane.unwrap_or_default();
        let cells = if let Some(InRow { signs, in_plane, .. }) = &found.in_row {
            let energy = significant(e.energy_j, ENERGY_DIGITS);
            vec![energy, pattern(signs), format!("{} ({index})", word(in_plane)), in_space]
        } else {
            let lowest_m = e.joints_m.iter().map(|at| at[2]).fold(f64::INFINITY, f64::min);
            vec![long(e.energy_j), in_space, short(lowest_m)]
        };
        let proof = [format!("{:.0e}", found.box_width()), rung(&e.evidence)];
        rows.add_row(std::iter::once(label).chain(cells).chain(proof));
    }
    numbers_from(&mut rows, 1);
    let mut text = format!("{rows}\n");
    left_out(&mut text, answer.census.count, PRINTED, "equilibria");
    if is_row {
        let signs =
            answer.equilibria.iter().filter_map(|found| Some(&found.in_row.as_ref()?.signs));
        let dots =
            if signs.flatten().any(|sign| *sign == 0) { ", a dot next to nothing" } else { "" };
        let _ = write!(text, "Bars from the start, T in tension, C in compression{dots}. ");
    }
    let mirrored = if is_row && answer.census.circles {
        "\n1' is the mirror image of 1, on the same circle."
    } else {
        ""
    };
    let _ = writeln!(
        text,
        "In brackets: the number of directions in which the energy falls.\nBox: the largest relative width of the \
         enclosures that prove the equilibrium.{mirrored}\n"
    );
    text
}

/// Energies in their own unit.
fn energies(answer: &CensusAnswer) -> String {
    let Some((unit, row)) = answer.census.unit.zip(answer.system().as_row()) else {
        return String::new();
    };
    // The paper counts the energy of its example from the last anchor, 2 l below the first.
    let chain = row.problem().chain();
    let [start, end] = [chain.anchors().start_m[2], chain.anchors().end_m[2]];
    let shift_j = chain.total_mass_kg() * chain.gravity_m_s2() * (start - end);
    let shift = shift_j / unit.energy_unit_j;
    let symbol = unit.energy_symbol;
    let scaled = format!("V / {symbol}");
    let from_end = format!("V / {symbol} from end");
    let other_zero = answer.census.circles && shift.abs() > 0.0;
    let mut rows = table(["#", &scaled].into_iter().chain(other_zero.then_some(&*from_end)));
    for (label, found) in printed(answer, PRINTED) {
        let energy = found.in_row.as_ref().map_or(f64::NAN, |found| found.energy_scaled);
        let from_end = other_zero.then(|| long(energy + shift));
        rows.add_row([label, long(energy)].into_iter().chain(from_end));
    }
    let start = row.joints().next().map(|joint| answer.system().joints()[joint].name.text());
    let start = start.unwrap_or_default();
    numbers_from(&mut rows, 1);
    format!(
        "Energy V from the height of joint {}{}; {symbol}: {}:\n{rows}\n\n",
        Printable(&start),
        if other_zero { " (from end: of the last anchor)" } else { "" },
        unit.energy_unit,
    )
}

/// `TTC`; bars without force are dots.
pub(crate) fn pattern(signs: &[i8]) -> String {
    let letter = |sign: &i8| match sign {
        1 => 'T',
        -1 => 'C',
        _ => '.',
    };
    signs.iter().map(letter).collect()
}

pub(super) fn left_out(text: &mut String, all: usize, printed: usize, what: &str) {
    if all > printed {
        let _ = writeln!(
            text,
            "... and {} {what} more: --json or --csv FILE have them all.",
            all - printed
        );
    }
}

/// Of how many equilibria joints and members are printed.
fn in_full(answer: &CensusAnswer) -> usize {
    (PRINTED_MEMBERS / answer.system().members().len().max(1)).clamp(1, PRINTED)
}

/// The name of a joint.
fn name(system: &System, joint: usize) -> String {
    Printable(&system.joints()[joint].name).to_string()
}

/// The label on the first line of each equilibrium.
fn first(k: usize, label: &str) -> String {
    if k == 0 { label.to_owned() } else { String::new() }
}

/// Places and forces of the ground, joint by joint.
fn joints(answer: &CensusAnswer) -> String {
    let system = answer.system();
    let mut rows = table(["#", "joint", "place / m", "force of the ground / N"]);
    for (label, found) in printed(answer, in_full(answer)) {
        let e = &found.equilibrium;
        for (k, joint) in system.joints().iter().enumerate() {
            let held = joint.support.at_m().map(|_| vector(e.reactions_n[k]));
            let place = vector(e.joints_m[k]);
            rows.add_row([first(k, &label), name(system, k), place, held.unwrap_or_default()]);
        }
    }
    // Vectors may be broken over lines, labels not.
    numbers_from(&mut rows, 4);
    format!("{rows}\n\n")
}

/// Forces, member by member; of a row of bars also their angles.
fn members(answer: &CensusAnswer) -> String {
    let (system, row) = (answer.system(), answer.row());
    let angles = ["angle / deg", "signed / deg", "known to"].into_iter().filter(|_| row.is_some());
    let names = ["#", "from", "to"].into_iter().chain(angles).chain(["axial / N"]);
    let mut rows = table(names);
    let printed_in_full = in_full(answer);
    for (label, found) in printed(answer, printed_in_full) {
        let axial = found.equilibrium.axial_forces(system);
        for (k, (member, axial)) in system.members().iter().zip(axial).enumerate() {
            let bar = row.and_then(|row| row.members.iter().position(|member| *member == k));
            let angles = bar.zip(found.in_row.as_ref()).map(|(bar, found)| {
                let known =
                    format!("{:.0e}", found.enclosures.angles_rad[bar].width().to_degrees());
                [long(found.angles_deg[bar]), long(found.angles_signed_deg[bar]), known]
            });
            let ends = [first(k, &label), name(system, member.from), name(system, member.to)];
            rows.add_row(
                ends.into_iter()
                    .chain(angles.into_iter().flatten())
                    .chain([short(axial.largest_n())]),
            );
        }
    }
    numbers_from(&mut rows, 3);
    let about = if row.is_some() {
        "Angles from the descending vertical, towards the last anchor (on one vertical: towards +Y). "
    } else {
        ""
    };
    let mut text =
        format!("{about}Axial forces where they are largest, tension positive:\n{rows}\n");
    left_out(
        &mut text,
        answer.census.count,
        printed_in_full,
        "equilibria with their joints and members",
    );
    text + "\n"
}

/// How far the equilibria are proved, rung by rung: every reason once, with the equilibria it holds
/// for.
fn evidence(answer: &CensusAnswer) -> String {
    let all = answer.equilibria.len();
    let mut text = match answer.census.count {
        count if count > all => format!("Evidence of the first {all} of {count}:\n"),
        _ => "Evidence:\n".to_owned(),
    };
    for step in Rung::ALL.into_iter().filter(|rung| *rung != Rung::Converged) {
        let reached = |found: &Found| found.equilibrium.evidence.ladder.is_reached(step);
        let how = |found: &Found| found.equilibrium.evidence.ladder.how(step);
        let there: Vec<&Found> = answer.equilibria.iter().filter(|found| reached(found)).collect();
        let mark = if there.is_empty() { '-' } else { '+' };
        let mut line = format!("  {mark} {:<9} {} of {all}", step.to_string(), there.len());
        // Of many, the one with the widest box speaks for all.
        if let Some(widest) = there.iter().max_by(|a, b| a.box_width().total_cmp(&b.box_width())) {
            line = format!("{line}: {}", how(widest));
        }
        if let Some((label, missed)) = printed(answer, all).find(|(_, found)| !reached(found)) {
            line = format!("{line}; not {label}: {}", how(missed));
        }
        text += &wrapped(&line, LADDER_INDENT);
        text.push('\n');
    }
    text + "\n"
}

/// What is known of the chains.
fn chains(answer: &CensusAnswer) -> String {
    let mut text = String::new();
    for (part, proven) in answer.census.parts.iter().zip(&answer.proven().parts) {
        let Some(chain) = &part.chain else { continue };
        if let (None, [first, .., last]) = (answer.row(), &chain.joints[..]) {
            let (the, count) = (the(&proven.slack), chain.count_in_plane);
            let [first, last] = [first, last].map(Printable);
            let _ = writeln!(text, "{the} chain from {first} to {last} has {count} in the plane.");
        }
        text += &census_chain::text(chain);
    }
    text
}

/// "The", or with which members slack.
fn the(slack: &[usize]) -> String {
    let numbers: Vec<String> = slack.iter().map(|member| (member + 1).to_string()).collect();
    match slack.len() {
        0 => "The".to_owned(),
        1 => format!("With member {} slack the", numbers[0]),
        _ => format!("With members {} slack the", numbers.join(", ")),
    }
}

/// What is known of the nets.
fn nets(answer: &CensusAnswer) -> String {
    /// So many undecided boxes are printed.
    const OPEN: usize = 5;
    let names = |joints: &[usize]| -> String {
        let name = |k: &usize| Printable(&answer.system().joints()[*k].name).to_string();
        joints.iter().map(name).collect::<Vec<_>>().join(", ")
    };
    let mut text = String::new();
    for part in &answer.proven().parts {
        let Some(net) = &part.net else { continue };
        let _ = write!(
            text,
            "{} net of {}: {}",
            the(&part.slack),
            counted(net.closures, "closure"),
            match &net.knots[..] {
                [] => "no place to be searched".to_owned(),
                knots => format!("all places of {}", names(knots)),
            }
        );
        if !net.swings.is_empty() {
            let _ = write!(text, "; {} by closed forms", names(&net.swings));
        }
        let _ = writeln!(text, "; {} boxes, {} undecided.", net.cells, net.undecided.len());
        if net.in_plane {
            let among = "among the configurations in the vertical plane of its anchors";
            let list = if net.undecided.is_empty() { "complete" } else { "not complete even" };
            let _ = writeln!(
                text,
                "The list is {list} {among}; no others were looked for: in space it moves in too many ways."
            );
        }
        for open in net.undecided.iter().take(OPEN) {
            let places: Vec<String> = net
                .knots
                .iter()
                .zip(&open.knots_m)
                .map(|(knot, at)| {
                    let at = at.map(|part| format!("{:.4} to {:.4}", part.lo(), part.hi()));
                    format!("{} at ({}) m", names(std::slice::from_ref(knot)), at.join(", "))
                })
                .collect();
            let _ = writeln!(text, "Undecided ({}): {}", open.reason, places.join("; "));
        }
    }
    if text.is_empty() { text } else { text + "\n" }
}
