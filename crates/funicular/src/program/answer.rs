//! The answer of `solve`, for people.

use std::fmt::Write as _;

use funicular::{Extremes, SolveAnswer};
use model::system::{Kind, Member, Support, System, SystemEquilibrium};
use model::{Evidence, SolverName, Vector};

use crate::printable::Printable;
use crate::shape::Shape;
use crate::tables::{duration, long, numbers_from, rung, short, table, word, wrapped};

/// Where the sentences of the ladder begin.
const LADDER_INDENT: usize = 15;

/// The whole answer.
pub fn answer(solution: &SolveAnswer, summary: bool) -> String {
    let system = solution.system();
    let (members, joints) = (system.members().len(), system.joints().len());
    let name = format!("{}: {members} members between {joints} joints,", Printable(system.name()));
    let mut text = format!(
        "{}\n{} m long, {} kg, g = {} m/s^2\n\n",
        wrapped(&name, 0),
        short(system.total_length_m()),
        short(system.total_mass_kg()),
        short(system.gravity_m_s2()),
    );
    if let Some(first) = solution.equilibria().first() {
        text += &shape(system, first, summary);
    }
    text += &overview(solution.equilibria());
    text += &question(solution);
    text += &ladder(solution.equilibria().iter().map(|e| (&e.solver, &e.evidence)));
    for failure in solution.failures() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "No answer of {failure}");
    }
    if let Some(agreement) = solution.agreement() {
        let _ = writeln!(
            text,
            "Agreement: {} (joints {:.1e} m, forces {:.1e} N, energy {:.1e} J)",
            agreement.verdict, agreement.joints_m, agreement.forces_n, agreement.energy_j
        );
    }
    text
}

/// Which question is answered where no shape was given.
fn lowest(proved: bool) -> &'static str {
    if proved {
        "The lowest equilibrium of all (proved).\n"
    } else {
        "The lowest equilibrium of all (not proved).\n"
    }
}

/// In a line which question this answers.
fn question(solution: &SolveAnswer) -> String {
    let proved = solution.equilibria().iter().any(|e| e.evidence.ladder.optimal.is_reached());
    let Some(near) = solution.near() else {
        return lowest(proved).to_owned();
    };
    let moved = format!(
        "joint {} is {:.3e} m from it, {:.2} % of the shortest member there",
        Printable(&near.joint),
        near.moved_m,
        100.0 * near.moved
    );
    let barrier = near.barrier_j.map_or_else(String::new, |barrier_j| {
        format!(", and the energy rises by {barrier_j:.3e} J on the way")
    });
    let found = if near.is_neighbour {
        format!("The equilibrium nearest to the shape given ({moved})")
    } else {
        format!("Not the neighbour of the shape given ({moved}{barrier})")
    };
    let lower = match near.lower_j {
        Some(lower_j) => format!("; a lower one exists, at {} J", long(lower_j)),
        None if proved => "; it is the lowest of all (proved)".to_owned(),
        None => String::new(),
    };
    wrapped(&format!("{found}{lower}."), 0) + "\n"
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
        let mut more = |mark: char, of: &str, what: &dyn std::fmt::Display| {
            text += &wrapped(&format!("  {mark} {of:<10} {what}"), LADDER_INDENT);
            text.push('\n');
        };
        if let Some(family) = &evidence.force_family {
            more('!', "forces", family);
        }
        if let Some(stresses) = &evidence.self_stresses {
            more('!', "forces", stresses);
        }
        if let Some(rigidity) = &evidence.rigidity {
            more(' ', "rigidity", rigidity);
        }
    }
    text + "\n"
}

fn overview(equilibria: &[SystemEquilibrium]) -> String {
    let mut table = table(["solver", "energy / J", "in space", "residual", "steps", "time"]);
    for e in equilibria {
        table.add_row([
            e.solver.to_string(),
            long(e.energy_j),
            format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space),
            format!("{:.1e}", e.evidence.residual),
            e.evidence.iterations.to_string(),
            duration(e.evidence.solve_s),
        ]);
    }
    numbers_from(&mut table, 1);
    format!("{table}\n(in brackets: the number of directions in which the energy falls)\n\n")
}

fn shape(system: &System, e: &SystemEquilibrium, summary: bool) -> String {
    let held = system.joints().iter().zip(&e.reactions_n).enumerate();
    let lies = |force: &[f64; 3]| force.iter().any(|n| n.abs() > 0.0);
    // What a plane keeps in it, as that of a planar drawing, is shown where it bears something.
    let holds = |support: Support| matches!(support, Support::Fixed { .. } | Support::Line { .. });
    let held = held.filter(|(_, (joint, force))| holds(joint.support) || lies(force));
    let shape = Shape {
        name: &|joint| Printable(&system.joints()[joint].name).to_string(),
        ends: &|bar| [system.members()[bar].from, system.members()[bar].to],
        joints_m: &e.joints_m,
        axial: e.axial_forces(system),
        extremes: Extremes::of(system, e),
        reactions_n: held.map(|(k, (_, force))| (k, *force)).collect(),
        idle: &|bar| idle(&system.members()[bar], &e.joints_m),
        ranges: e.evidence.self_stresses.as_ref().and_then(|family| family.ranges.as_deref()),
        solver: &e.solver,
    };
    shape.text(summary)
}

/// What a member without force does: a cable or a strut may be away from its length, or have it and
/// bear nothing, which decides nothing about either.
fn idle(member: &Member, joints_m: &[Vector]) -> &'static str {
    /// A member whose length is off by less than this part of it has it.
    const JUST: f64 = 1e-10;
    let [a, b] = [joints_m[member.from], joints_m[member.to]];
    let distance_m = (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
    let longer = distance_m / member.body.length_m() - 1.0;
    match member.kind {
        Kind::Cable if longer < -JUST => "slack",
        Kind::Cable => "just taut",
        Kind::Strut if longer > JUST => "loose",
        Kind::Strut => "just tight",
        Kind::Bar => "no force",
    }
}
