//! The answer of `solve`, for people.

use std::cmp::Ordering;
use std::fmt::Write as _;

use funicular::SolveAnswer;
use model::{Equilibrium, Evidence, SolverName};
use validate::Agreement;

use crate::tables::{
    duration, long, numbers_from, rung, short, system_line, table, vector, word, wrapped,
};

/// Chains up to this many bars are printed joint by joint; longer ones by their ends (`--csv` and
/// `--json` have all).
const PRINTED_BARS: usize = 40;

/// Where the sentences of the ladder begin.
const LADDER_INDENT: usize = 15;

/// The whole answer.
pub fn answer(answer: &SolveAnswer, summary: bool) -> String {
    let (system, equilibria) = (answer.system(), answer.equilibria());
    let mut text = system_line(system);
    text += &overview(equilibria);
    if !summary && let Some(first) = equilibria.first() {
        text += &shape(first, system.bars);
    }
    text += &ladder(equilibria.iter().map(|e| (&e.solver, &e.evidence)));
    for failure in answer.failures() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "No answer of {failure}");
    }
    if let Some(agreement) = answer.agreement() {
        text += &self::agreement(agreement);
    }
    text
}

fn overview(equilibria: &[Equilibrium]) -> String {
    let mut table = table([
        "solver",
        "energy / J",
        "force at start / N",
        "force at end / N",
        "in plane",
        "in space",
        "residual",
        "steps",
        "time",
    ]);
    for e in equilibria {
        table.add_row([
            e.solver.to_string(),
            long(e.energy_j),
            vector(e.reactions_n.start),
            vector(e.reactions_n.end),
            format!("{} ({})", word(&e.stability.in_plane), e.stability.index_in_plane),
            format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space),
            format!("{:.1e}", e.evidence.residual),
            e.evidence.iterations.to_string(),
            duration(e.evidence.solve_s),
        ]);
    }
    numbers_from(&mut table, 1);
    format!("{table}\n(in brackets: the number of directions in which the energy falls)\n\n")
}

/// Joints and forces of one equilibrium; the other solver's agree with it or the verdict says so.
fn shape(e: &Equilibrium, bars: usize) -> String {
    if bars > PRINTED_BARS {
        return format!("{bars} bars are not printed: --csv FILE or --json have them all.\n\n");
    }
    let mut table = table([
        "joint",
        "x / m",
        "y / m",
        "z / m",
        "force x / N",
        "force y / N",
        "force z / N",
        "bar to the next",
        "axial / N",
    ]);
    for (k, (joint, force)) in e.joints_m.iter().zip(&e.multipliers_n).enumerate() {
        let axial = e.axial_n.get(k);
        table.add_row([
            k.to_string(),
            short(joint[0]),
            short(joint[1]),
            short(joint[2]),
            short(force[0]),
            short(force[1]),
            short(force[2]),
            axial.map_or_else(String::new, |a| {
                match a.partial_cmp(&0.0) {
                    Some(Ordering::Less) => "compression",
                    Some(Ordering::Greater) => "tension",
                    _ => "nothing",
                }
                .to_owned()
            }),
            axial.map_or_else(String::new, |a| short(*a)),
        ]);
    }
    numbers_from(&mut table, 1);
    format!(
        "Joints, and the forces at them (on the bar before the joint; at joint 0 on bar 1), by {}:\n{table}\n\n",
        e.solver
    )
}

/// How far each equilibrium is proved, rung by rung.
pub fn ladder<'a>(answers: impl Iterator<Item = (&'a SolverName, &'a Evidence)>) -> String {
    let mut text = String::new();
    for (solver, evidence) in answers {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "Evidence for the answer of {solver}: {}", rung(evidence));
        for s in evidence.ladder.statements() {
            let mark = if s.reached { "+" } else { "-" };
            let line = format!("  {mark} {:<10} {}", s.rung.to_string(), s.how);
            text += &wrapped(&line, LADDER_INDENT);
            text.push('\n');
        }
        if let Some(family) = evidence.force_family {
            text += &wrapped(&format!("  ! {:<10} {family}", "forces"), LADDER_INDENT);
            text.push('\n');
        }
    }
    text + "\n"
}

fn agreement(agreement: &Agreement) -> String {
    let mut text = format!(
        "Agreement: {} (joints {:.1e} m, forces {:.1e} N, energy {:.1e} J)",
        agreement.verdict, agreement.joints_m, agreement.forces_n, agreement.energy_j
    );
    if agreement.force_family.is_some() {
        text += " of the shape alone: the forces are indeterminate";
    }
    if let Some(free) = agreement.free {
        let _ = write!(text, "; not compared: {free}");
    }
    text + "\n"
}
