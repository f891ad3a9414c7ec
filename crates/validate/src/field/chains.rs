//! Hanging chains of collections of optimisation problems: CUTEst and COPS.

use model::{Anchors, Bar, Chain, Problem};
use toml::{Table, Value};

use super::entry::{BothSolvers, Compared, Entry};
use crate::built_in::{count, key, numbers, parsed, tables};

const CATENA: &str = "CATENA of CUTEst, github.com/ralna/CUTEst (SIF file by Ph. L. Toint, 1993)";
const COPS: &str = "E. D. Dolan, J. J. More, T. S. Munson, COPS 3.0, ANL/MCS-TM-273 (2004)";

/// The optima of CATENA, each half of a chain between level anchors.
///
/// # Panics
/// Never: a test reads the file that is compiled in.
pub fn cutest() -> Vec<Entry> {
    let catena = parsed(include_str!("../../data/external/cutest-catena.toml"));
    key(&catena, "published", tables).into_iter().map(|optimum| one(&catena, optimum)).collect()
}

fn one(catena: &Table, optimum: &Table) -> Entry {
    let beams = key(optimum, "beams", count);
    let title = format!("half of a chain of {} bars", 2 * beams);
    let Some(problem) = chain(catena, beams) else {
        return Entry::not_judged(title, CATENA, "the chain could not be built");
    };
    let first = lagrange::solve(&problem, &lagrange::Settings::default());
    let second = energy::minimise(&problem, &energy::Settings::default());
    let (Ok(first), Ok(second)) = (first, second) else {
        return Entry::not_judged(title, CATENA, "a solver has no answer");
    };
    let energies = [first.equilibrium.energy_j, second.equilibrium.energy_j];
    let printed = key(optimum, "energy_j", Value::as_str);
    let number = Compared {
        // The energy is flat at its minimum, and known to rounding.
        digits: 11,
        ..Compared::new("least energy / J", printed, 0.5 * energies[0], None)
    };
    let apart_j = 0.5 * (energies[0] - energies[1]).abs();
    let below_j = number.ours - number.published;
    Entry {
        title,
        source: CATENA,
        solvers: Some(BothSolvers::Least { apart_j, below_j }),
        numbers: vec![number],
        by_hand: None,
        not_judged: None,
    }
}

/// The chain and its mirror image.
fn chain(catena: &Table, beams: usize) -> Option<Problem> {
    let [fraction, total_mass_kg, gravity_m_s2] =
        numbers(catena, ["fraction", "total_mass_kg", "gravity_m_s2"]);
    let bar = Bar::homogeneous(1.0, total_mass_kg / beams as f64).ok()?;
    let end_m = [2.0 * fraction * beams as f64, 0.0, 0.0];
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    let chain = Chain::new("CATENA", gravity_m_s2, anchors, vec![bar; 2 * beams]).ok()?;
    Problem::new(chain).ok()
}

/// What is published and not judged, with the reasons.
pub fn not_judged() -> Vec<Entry> {
    let incomplete = "input incomplete: no source with all of it was at hand";
    vec![
        Entry::not_judged(
            "COPS, hanging chain",
            COPS,
            "the optima belong to a discretisation that is not a chain of bars; both tend to the same catenary",
        ),
        Entry::not_judged(
            "CATENARY of CUTEst",
            "CATENARY of CUTEst, github.com/ralna/CUTEst",
            "its file has an index wrong, and describes no chain",
        ),
        Entry::not_judged(
            "HANGING of CUTEst",
            "HANGING of CUTEst, github.com/ralna/CUTEst",
            incomplete,
        ),
        Entry::not_judged("cable with two loads", "O'Brien (1967)", incomplete),
        Entry::not_judged("cable with one load", "Michalos and Birnstiel (1960)", incomplete),
        Entry::not_judged("cable element", "Jayaraman and Knudson (1981)", incomplete),
        Entry::not_judged(
            "static lines of MoorDyn's tests",
            "MoorDyn, tests/Mooring/QuasiStatic, github.com/FloatingArrayDesign/MoorDyn",
            "the numbers are of a moving line that lies on the floor",
        ),
    ]
}

#[cfg(test)]
mod tests;
