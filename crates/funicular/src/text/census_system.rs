//! The census of a system, for people.

use std::fmt::{self, Write as _};

use model::system::{System, SystemEquilibrium};

use super::answer::ladder;
use super::printable::Printable;
use super::tables::{
    counted, duration, fitted, long, numbers_from, rung, short, table, vector, word, wrapped,
};
use crate::census::SystemCensusAnswer;

/// So many equilibria are printed, and so many joints and members of them one by one; `--json` has
/// all.
const PRINTED: usize = 40;

/// As `funicular census` prints it.
impl fmt::Display for SystemCensusAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(self))
    }
}

/// The whole answer.
fn text(answer: &SystemCensusAnswer) -> String {
    let system = answer.system();
    let mut text = format!(
        "{}: {}, {}\n",
        Printable(system.name()),
        counted(system.members().len(), "member"),
        counted(system.joints().len(), "joint")
    );
    text += &headline(answer);
    let equilibria = answer.equilibria();
    text += &overview(equilibria);
    let mut lines = 0;
    for (k, e) in equilibria.iter().enumerate() {
        lines += system.joints().len() + system.members().len();
        if lines > 2 * PRINTED && k > 0 {
            let _ = writeln!(text, "({} more in --json)", equilibria.len() - k);
            break;
        }
        text += &one(system, k + 1, e);
    }
    text += &chains(answer);
    text += &nets(answer);
    if let Some(first) = equilibria.first() {
        text += &ladder(&[(&first.solver, &first.evidence)]);
    }
    fitted(&text)
}

/// What was found, in a sentence.
fn headline(answer: &SystemCensusAnswer) -> String {
    let census = answer.proven();
    let count = answer.equilibria().len();
    let mut text = format!("{count} {}", if count == 1 { "equilibrium" } else { "equilibria" });
    if census.equilibria.iter().any(|position| position.circle) {
        text += ", each with all its turns about the vertical through its anchors";
    }
    if census.parts.len() > 1 && census.parts.iter().all(|part| part.slack.is_empty()) {
        let parts: Vec<_> = census.parts.iter().map(|part| part.positions.to_string()).collect();
        let _ = write!(text, " ({} of parts that move without each other)", parts.join(" times "));
    }
    match census.families() {
        0 => {}
        families => {
            let _ = write!(text, ", besides {families} families of slack bars");
        }
    }
    text += if census.complete { ": proved to be all." } else { ": NOT proved to be all." };
    wrapped(&text, 0) + "\n\n"
}

fn overview(equilibria: &[SystemEquilibrium]) -> String {
    let mut table = table(["#", "energy / J", "in space", "lowest joint / m", "rung"]);
    for (k, e) in equilibria.iter().take(PRINTED).enumerate() {
        let lowest = e.joints_m.iter().map(|at| at[2]).fold(f64::INFINITY, f64::min);
        table.add_row([
            (k + 1).to_string(),
            long(e.energy_j),
            format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space),
            short(lowest),
            rung(&e.evidence),
        ]);
    }
    numbers_from(&mut table, 1);
    let mut text = format!("{table}\n");
    if equilibria.len() > PRINTED {
        let _ = writeln!(text, "({} more in --json)", equilibria.len() - PRINTED);
    }
    text + "(in brackets: the number of directions in which the energy falls)\n\n"
}

/// Joints and members of one equilibrium.
fn one(system: &System, number: usize, e: &SystemEquilibrium) -> String {
    let name = |joint: usize| Printable(&system.joints()[joint].name).to_string();
    let mut joints = table(["joint", "place / m", "force of the ground / N"]);
    for (k, joint) in system.joints().iter().enumerate() {
        let held = joint.support.at_m().map(|_| vector(e.reactions_n[k]));
        joints.add_row([name(k), vector(e.joints_m[k]), held.unwrap_or_default()]);
    }
    let mut members = table(["from", "to", "largest axial force / N"]);
    for (member, along) in system.members().iter().zip(e.axial_forces(system)) {
        members.add_row([name(member.from), name(member.to), short(along.largest_n())]);
    }
    numbers_from(&mut members, 2);
    format!("Equilibrium {number}:\n{joints}\n{members}\n\n")
}

/// What is known of the chains.
fn chains(answer: &SystemCensusAnswer) -> String {
    let mut text = String::new();
    for part in &answer.proven().parts {
        let Some(chain) = &part.chain else { continue };
        let census = &chain.census;
        let names: Vec<_> = [chain.joints.first(), chain.joints.last()]
            .into_iter()
            .flatten()
            .map(|joint| Printable(&answer.system().joints()[*joint].name).to_string())
            .collect();
        let _ = write!(
            text,
            "{} chain from {}: {} in the plane, alternating sum {}",
            the(&part.slack),
            names.join(" to "),
            census.count_in_plane(),
            census.alternating_sum()
        );
        if let Ok(topology) = &census.topology {
            let _ = write!(text, ", Euler characteristic {}", topology.euler);
        }
        let _ = writeln!(
            text,
            "; {} cells in {}{}.",
            census.statistics.cells,
            duration(census.statistics.seconds),
            match &chain.check {
                Ok(()) => ", every one proved again".to_owned(),
                Err(failure) => format!(". The check: {failure}"),
            }
        );
    }
    if text.is_empty() { text } else { text + "\n" }
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
fn nets(answer: &SystemCensusAnswer) -> String {
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
        } else if net.signs > 0 {
            let _ =
                write!(text, " and all pulls of the strands of {} bars that hold it", net.signs);
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
