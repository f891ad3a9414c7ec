//! Derivatives as text.

use std::fmt::{self, Write as _};

use model::Vector;

use super::printable::Printable;
use super::tables::{numbers_from, short, table};
use crate::csv::Numbers;
use crate::derivatives::{AnchorStiffness, NumberGradient, ParameterChange};

/// Of a gradient the largest are printed; of more anchors each alone.
const PRINTED: usize = 24;
const MOST_ANCHORS: usize = 3;

/// The matrices of all pairs of anchors.
pub fn stiffness(pairs: &[AnchorStiffness]) -> String {
    let mut text = String::new();
    let own = pairs.iter().filter(|pair| pair.of == pair.by).count();
    let shown = pairs.iter().filter(|pair| own <= MOST_ANCHORS || pair.of == pair.by);
    for pair in shown {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "\nforce of the ground at {} by a move of {}, N/m:",
            Printable(&pair.of),
            Printable(&pair.by)
        );
        let numbers = Numbers::of(pair.stiffness_n_m.as_flattened());
        let mut rows = table(["force", "by x", "by y", "by z"]);
        for (axis, row) in ["Fx", "Fy", "Fz"].into_iter().zip(pair.stiffness_n_m) {
            let cells = row.map(|x| numbers.short(x));
            rows.add_row([axis.to_owned()].into_iter().chain(cells));
        }
        numbers_from(&mut rows, 1);
        let _ = writeln!(text, "{rows}");
    }
    if own > MOST_ANCHORS {
        let _ = writeln!(text, "\n({own} anchors; --json has the matrices of all pairs)");
    }
    text
}

/// As `funicular derivatives --of` prints it.
impl fmt::Display for NumberGradient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&gradient(self))
    }
}

fn gradient(found: &NumberGradient) -> String {
    let mut order: Vec<_> = found.derivatives.iter().collect();
    order.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
    let mut text = format!("\n{} = {}\n", Printable(&found.of), short(found.value));
    let mut rows = table(["parameter", "derivative", "unit"]);
    for one in order.iter().take(PRINTED) {
        // What is a zero depends on the unit.
        let alike = found.derivatives.iter().filter(|other| other.unit == one.unit);
        let value = Numbers::of(alike.map(|other| &other.value)).short(one.value);
        rows.add_row([Printable(&one.parameter).to_string(), value, one.unit.clone()]);
    }
    numbers_from(&mut rows, 1);
    let _ = writeln!(text, "{rows}");
    if order.len() > PRINTED {
        let all = order.len();
        let _ = writeln!(text, "(the largest {PRINTED} of {all}; --csv and --json have all)");
    }
    text
}

/// As `funicular derivatives --by` prints it.
impl fmt::Display for ParameterChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&change(self))
    }
}

fn change(found: &ParameterChange) -> String {
    let mut text = format!("\nper {} of {}\n", found.unit, Printable(&found.by));
    vectors(&mut text, ["joint", "x / m", "y / m", "z / m"], &found.joints_m);
    vectors(&mut text, ["support", "Fx / N", "Fy / N", "Fz / N"], &found.reactions_n);
    let mut rows = table(["bar", "axial / N"]);
    let numbers = Numbers::of(&found.axial_n);
    for (k, force) in found.axial_n.iter().enumerate().take(PRINTED) {
        rows.add_row([(k + 1).to_string(), numbers.short(*force)]);
    }
    numbers_from(&mut rows, 1);
    let _ = writeln!(text, "{rows}");
    more(&mut text, found.axial_n.len());
    text
}

fn vectors(text: &mut String, head: [&str; 4], list: &[(String, Vector)]) {
    let mut rows = table(head);
    let numbers = Numbers::of(list.iter().flat_map(|(_, v)| v));
    for (name, v) in list.iter().take(PRINTED) {
        let cells = v.map(|x| numbers.short(x));
        rows.add_row([Printable(name).to_string()].into_iter().chain(cells));
    }
    numbers_from(&mut rows, 1);
    let _ = writeln!(text, "{rows}");
    more(text, list.len());
}

fn more(text: &mut String, all: usize) {
    if all > PRINTED {
        let _ = writeln!(text, "(the first {PRINTED} of {all}; --json has all)");
    }
}
