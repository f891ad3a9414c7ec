//! The answer of `solve` for a system of bars, for people.

use std::fmt::Write as _;

use funicular::SystemSolution;
use model::system::{System, SystemEquilibrium};

use crate::answer::ladder;
use crate::printable::Printable;
use crate::tables::{duration, long, numbers_from, short, table, vector, word};

/// Joints and members up to this many are printed one by one; of more the extremes.
const PRINTED: usize = 40;

/// The whole answer.
pub fn answer(solution: &SystemSolution, summary: bool) -> String {
    let system = solution.system();
    let mut text = format!(
        "{}: {} members, {} m long, {} joints, {} kg, g = {} m/s^2\n\n",
        Printable(system.name()),
        system.members().len(),
        short(system.total_length_m()),
        system.joints().len(),
        short(system.total_mass_kg()),
        short(system.gravity_m_s2()),
    );
    text += &overview(solution.equilibria());
    if let Some(first) = solution.equilibria().first() {
        if !summary && system.joints().len().max(system.members().len()) <= PRINTED {
            text += &joints(system, first);
            text += &members(system, first);
        }
        text += &extremes(system, first);
    }
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

fn joints(system: &System, e: &SystemEquilibrium) -> String {
    let mut table = table(["joint", "x / m", "y / m", "z / m", "force of the ground / N"]);
    for (k, joint) in system.joints().iter().enumerate() {
        let held = joint.support.at_m().map(|_| vector(e.reactions_n[k]));
        let [x, y, z] = e.joints_m[k].map(short);
        table.add_row([Printable(&joint.name).to_string(), x, y, z, held.unwrap_or_default()]);
    }
    numbers_from(&mut table, 1);
    format!("Joints, by {}:\n{table}\n\n", e.solver)
}

fn members(system: &System, e: &SystemEquilibrium) -> String {
    let mut table = table(["from", "to", "axial force / N", ""]);
    for (member, axial) in system.members().iter().zip(&e.axial_n) {
        let name = |joint: usize| Printable(&system.joints()[joint].name).to_string();
        let what = match axial {
            n if *n > 0.0 => "tension",
            n if *n < 0.0 => "compression",
            _ => "no force",
        };
        table.add_row([name(member.from), name(member.to), short(*axial), what.to_owned()]);
    }
    numbers_from(&mut table, 2);
    format!("Members (their weight at their joints by the lever rule):\n{table}\n\n")
}

/// The lowest joint, and the members with the largest forces.
fn extremes(system: &System, e: &SystemEquilibrium) -> String {
    let mut text = String::new();
    let joints = system.joints().iter().zip(&e.joints_m);
    if let Some((joint, at)) = joints.min_by(|(_, a), (_, b)| a[2].total_cmp(&b[2])) {
        let _ = writeln!(text, "Lowest joint: {}, at {} m.", Printable(&joint.name), vector(*at));
    }
    let axial = || system.members().iter().zip(&e.axial_n);
    let most = axial().max_by(|(_, a), (_, b)| a.total_cmp(b));
    let least = axial().min_by(|(_, a), (_, b)| a.total_cmp(b));
    for (what, extreme) in [("tension", most), ("compression", least)] {
        let Some((member, axial)) = extreme else { continue };
        if (*axial > 0.0) == (what == "tension") && axial.abs() > 0.0 {
            let name = |joint: usize| Printable(&system.joints()[joint].name);
            let (from, to) = (name(member.from), name(member.to));
            let size = short(axial.abs());
            let _ = writeln!(text, "Largest {what}: {size} N, in the member from {from} to {to}.");
        }
    }
    text + "\n"
}
