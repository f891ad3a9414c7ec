//! Small oscillations as text.

use std::fmt::{self, Write as _};

use comfy_table::{CellAlignment, ColumnConstraint};

use super::printable::Printable;
use super::tables::{Table, counted, numbers_from, short, table, wrapped};
use crate::enclosed::Enclosed;
use crate::modes::{ModesAnswer, WithModes};

/// The modes of an equilibrium as a table.
fn rows(found: &WithModes) -> Table {
    let head = ["mode", "omega^2 / s^-2", "+-", "f / Hz", "rate / s^-1", "what"];
    let is_enclosed = matches!(found.enclosed, Enclosed::Reached { .. });
    let shown = |column: &usize| is_enclosed || *column != 2;
    let mut rows = table(head.into_iter().enumerate().filter(|(k, _)| shown(k)).map(|(_, h)| h));
    for (k, mode) in found.modes.iter().enumerate() {
        let cell = |x: Option<f64>| x.map(short).unwrap_or_default();
        let cells = [
            (k + 1).to_string(),
            short(mode.omega2_s2),
            mode.omega2_between_s2.map(|ends| within(mode.omega2_s2, ends)).unwrap_or_default(),
            cell(mode.frequency_hz),
            cell(mode.rate_1_s),
            mode.what.clone(),
        ];
        rows.add_row(cells.into_iter().enumerate().filter(|(k, _)| shown(k)).map(|(_, c)| c));
    }
    numbers_from(&mut rows, 1);
    // Numbers are whole, and words take what is left of the line.
    if let Some(number) = rows.column_mut(0) {
        number.set_constraint(ColumnConstraint::ContentWidth);
    }
    if let Some(what) = rows.column_iter_mut().last() {
        what.remove_constraint();
        what.set_cell_alignment(CellAlignment::Left);
    }
    rows
}

/// How far from a number the ends of its enclosure lie at most: one digit, rounded up.
fn within(x: f64, [low, high]: [f64; 2]) -> String {
    let most = (high - x).max(x - low);
    if most <= 0.0 {
        return "0".to_owned();
    }
    // A digit that is rounded down is the next one: at most 9 becomes 10.
    let rounded = format!("{most:.0e}");
    if rounded.parse().is_ok_and(|shown: f64| shown >= most) {
        return rounded;
    }
    let unit = 10.0_f64.powf(most.log10().floor());
    format!("{:.0e}", most + unit)
}

/// What is proved of the frequencies, in words.
fn proved(enclosed: &Enclosed) -> String {
    match enclosed {
        Enclosed::Reached { width_m, inertia: Some(inertia) } => format!(
            "every omega^2 is enclosed by interval arithmetic, about an equilibrium proved in a box {width_m:.1e} m wide; \
             proved: {} negative, {} zero, {} positive",
            inertia.negative, inertia.zero, inertia.positive
        ),
        Enclosed::Reached { width_m, inertia: None } => format!(
            "every omega^2 is enclosed by interval arithmetic, about an equilibrium proved in a box {width_m:.1e} m wide; \
             where the enclosure holds zero the sign is not proved"
        ),
        Enclosed::Open { because } => {
            format!("omega^2 are not enclosed by interval arithmetic: {because}")
        }
    }
}

/// As `funicular modes` prints it.
impl fmt::Display for ModesAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(self))
    }
}

fn text(answer: &ModesAnswer) -> String {
    let mut out = format!("{}\n", Printable(&answer.system.name));
    for found in &answer.equilibria {
        let (listed, all) = (found.modes.len(), found.modes_in_all);
        let _ = writeln!(
            out,
            "\nequilibrium {}, {} J, by {}: {}, {} unstable",
            found.label,
            short(found.energy_j),
            found.solver,
            counted(all, "mode"),
            found.index_by_modes
        );
        if listed < all {
            let _ = writeln!(
                out,
                "the lowest {listed}; the inertia of the factorised stiffness counts no other below"
            );
        }
        if all == 0 {
            let _ = writeln!(
                out,
                "nothing moves while members keep their lengths: what has a stiffness_n oscillates"
            );
        } else {
            let _ = writeln!(out, "{}", rows(found));
            let _ = writeln!(out, "{}", wrapped(&proved(&found.enclosed), 2));
        }
        if found.index_in_space != found.index_by_modes {
            let falls = counted(found.index_in_space, "direction");
            let note = format!(
                "The solver counts {falls} in which the energy falls. Modes are those of members that resist \
                 both ways; what is just taut, or bears nothing, resists on one side alone."
            );
            let _ = writeln!(out, "{}", wrapped(&note, 2));
        }
    }
    let all = if answer.complete {
        "These are all equilibria, by the census."
    } else if !answer.is_neighbour {
        "Not the neighbour of the shape given: see `funicular solve`."
    } else {
        "Of the equilibria that the solvers find; there may be others."
    };
    let _ = writeln!(out, "\n{all}");
    out
}
