//! The answer of `solve`, for people.

use std::fmt::Write as _;

use funicular::SolveAnswer;
use model::{Equilibrium, Evidence, SolverName, Vector};
use validate::Agreement;

use crate::shape::Shape;
use crate::tables::{duration, long, rung, short, system_line, table, vector, word, wrapped};

/// Where the sentences of the ladder begin.
const LADDER_INDENT: usize = 15;

/// The whole answer.
pub fn answer(answer: &SolveAnswer, summary: bool) -> String {
    let (system, equilibria) = (answer.system(), answer.equilibria());
    let mut text = system_line(system);
    if let Some(first) = equilibria.first() {
        text += &shape(first).text(summary);
    }
    text += &overview(equilibria, answer.agreement().and_then(|agreement| agreement.turned_rad));
    text += lowest(equilibria.iter().any(|e| e.evidence.ladder.optimal.is_reached()));
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

/// Which question is answered where no shape was given.
pub fn lowest(proved: bool) -> &'static str {
    if proved {
        "The lowest equilibrium of all (proved).\n"
    } else {
        "The lowest equilibrium of all (not proved).\n"
    }
}

/// A column for each solver. Where the chain turns freely, the second answer is shown turned onto
/// the first.
fn overview(equilibria: &[Equilibrium], turned_rad: Option<f64>) -> String {
    let head = [String::new()].into_iter().chain(equilibria.iter().map(|e| e.solver.to_string()));
    let mut table = table([""; 0]);
    table.set_header(head);
    let mut row = |what: &str, cell: &dyn Fn(usize, &Equilibrium) -> String| {
        let cells = equilibria.iter().enumerate().map(|(k, e)| cell(k, e));
        table.add_row([what.to_owned()].into_iter().chain(cells));
    };
    let force = |k: usize, f: Vector| vector(if k == 1 { turn(f, turned_rad) } else { f });
    row("energy / J", &|_, e| long(e.energy_j));
    row("force at start / N", &|k, e| force(k, e.reactions_n.start));
    row("force at end / N", &|k, e| force(k, e.reactions_n.end));
    row("in the plane", &|_, e| {
        format!("{} ({})", word(&e.stability.in_plane), e.stability.index_in_plane)
    });
    row("in space", &|_, e| {
        format!("{} ({})", word(&e.stability.in_space), e.stability.index_in_space)
    });
    row("residual", &|_, e| format!("{:.1e}", e.evidence.residual));
    row("steps", &|_, e| e.evidence.iterations.to_string());
    row("time", &|_, e| duration(e.evidence.solve_s));
    let turned = turned_rad.map_or_else(String::new, |angle| {
        format!(
            "(the chain turns freely about the vertical through its anchors: energy is shown turned by {} degrees)\n",
            short(angle.to_degrees())
        )
    });
    let turned = wrapped(&turned, 1);
    format!(
        "{table}\n(in brackets: the number of directions in which the energy falls)\n{turned}\n"
    )
}

/// A force turned about the vertical. What the rounding of the turn leaves of a component
/// counts as zero.
fn turn(force @ [x, y, z]: Vector, angle_rad: Option<f64>) -> Vector {
    let Some(angle_rad) = angle_rad else { return force };
    let (sin, cos) = angle_rad.sin_cos();
    let rounding = f64::EPSILON * x.hypot(y).hypot(z);
    let turned = [cos * x - sin * y, sin * x + cos * y, z];
    turned.map(|component: f64| if component.abs() <= rounding { 0.0 } else { component })
}

/// One equilibrium; the other solver's agrees with it or the verdict says so.
fn shape(e: &Equilibrium) -> Shape<'_> {
    let last = e.joints_m.len().saturating_sub(1);
    Shape {
        name: &|joint| joint.to_string(),
        ends: &|bar| [bar, bar + 1],
        joints_m: &e.joints_m,
        axial: e.axial_forces(),
        reactions_n: vec![(0, e.reactions_n.start), (last, e.reactions_n.end)],
        forces_n: Some(&e.multipliers_n),
        idle: &|_| "no force",
        ranges: None,
        solver: &e.solver,
    }
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
