//! Tables and numbers for the terminal.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table, presets};
use model::{Evidence, SystemSummary, Vector, cases};

use crate::printable::Printable;

/// Width of tables where no terminal says its own: what every terminal, mail and report has room
/// for.
const WIDTH: u16 = 80;

/// A table in the house style: thin rules, as wide as its content or the terminal.
pub fn table<'a>(head: impl IntoIterator<Item = &'a str>) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_HORIZONTAL_ONLY.row_separator(LineStyle::none()))
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_header(head.into_iter().collect::<Vec<_>>());
    if table.width().is_none() {
        table.set_width(WIDTH);
    }
    table
}

/// Right-align the columns from `first` on, close to each other, and break none of their numbers.
pub fn numbers_from(table: &mut Table, first: usize) {
    for column in table.column_iter_mut().skip(first) {
        column.set_cell_alignment(CellAlignment::Right);
        column.set_constraint(ColumnConstraint::ContentWidth);
        column.set_padding((0, 1));
    }
}

/// The registry: chains and systems.
pub fn cases() -> String {
    let mut chains = table(["case", "what it is"]);
    for case in cases::all() {
        chains.add_row([case.name, case.about]);
    }
    let mut systems = table(["system of bars", "what it is"]);
    for exhibit in cases::exhibits() {
        systems.add_row([exhibit.name, exhibit.about]);
    }
    format!("{chains}\n\n{systems}\n")
}

/// What is solved, in a line of its own.
pub fn system_line(system: &SystemSummary) -> String {
    format!(
        "{}: {} bars, {} m long, {} kg,\nanchors {} m apart, g = {} m/s^2\n\n",
        Printable(&system.name),
        system.bars,
        short(system.total_length_m),
        short(system.total_mass_kg),
        short(system.span_m),
        short(system.gravity_m_s2),
    )
}

/// A number for reading: six significant digits.
pub fn short(x: f64) -> String {
    significant(x, 6)
}

/// A number for comparing: fifteen significant digits.
pub fn long(x: f64) -> String {
    significant(x, 15)
}

/// `digits` significant digits, in plain notation where that is readable.
pub fn significant(x: f64, digits: usize) -> String {
    if x.abs() < f64::MIN_POSITIVE {
        return "0".to_owned();
    }
    let exponent = x.abs().log10().floor();
    if !(-4.0..7.0).contains(&exponent) {
        return format!("{x:.*e}", digits - 1);
    }
    // Between 0 and digits + 3, by the test above.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small and not negative"
    )]
    let decimals = (digits as f64 - 1.0 - exponent).max(0.0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

pub fn vector(v: Vector) -> String {
    format!("({})", v.map(short).join(", "))
}

/// A paragraph in lines that fit a terminal of 80 columns, all but the first indented. A longer
/// word stays whole.
pub fn wrapped(paragraph: &str, indent: usize) -> String {
    const COLUMNS: usize = 80;
    let mut lines = String::new();
    let mut column = 0;
    for (k, word) in paragraph.split(' ').enumerate() {
        let length = word.chars().count();
        if k > 0 && column + 1 + length > COLUMNS {
            lines.push('\n');
            lines.extend(std::iter::repeat_n(' ', indent));
            column = indent;
        } else if k > 0 {
            lines.push(' ');
            column += 1;
        }
        lines.push_str(word);
        column += length;
    }
    lines
}

/// The highest rung that an answer has reached.
pub fn rung(evidence: &Evidence) -> String {
    evidence.rung().map_or_else(|| "none".to_owned(), |rung| rung.to_string())
}

/// The serialised name of a unit variant.
pub fn word(value: &impl serde::Serialize) -> String {
    serde_json::to_value(value).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
}

pub fn duration(seconds: f64) -> String {
    if seconds < 1e-3 {
        format!("{:.1} us", seconds * 1e6)
    } else if seconds < 1.0 {
        format!("{:.1} ms", seconds * 1e3)
    } else {
        format!("{seconds:.2} s")
    }
}

#[cfg(test)]
mod tests {
    use super::{significant, wrapped};

    #[test]
    fn paragraphs_fit_eighty_columns_and_lose_nothing() {
        let paragraph = format!("  + verified  {}", "interval ".repeat(40).trim_end());
        let lines = wrapped(&paragraph, 14);
        assert!(lines.starts_with("  + verified  interval interval "));
        assert!(lines.lines().count() > 4 && lines.lines().all(|line| line.len() <= 80));
        assert!(lines.lines().skip(1).all(|line| line.starts_with("              interval")));
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(words(&lines), words(&paragraph));
        assert_eq!(wrapped("short", 4), "short");
    }

    #[test]
    fn numbers_keep_their_digits_and_drop_their_zeros() {
        assert_eq!(significant(1.0, 6), "1");
        assert_eq!(significant(-0.648_944_835_9, 6), "-0.648945");
        assert_eq!(significant(1.234_567_89e-9, 6), "1.23457e-9");
        assert_eq!(significant(123_456_789.0, 6), "1.23457e8");
        assert_eq!(significant(0.0, 6), "0");
        assert_eq!(significant(1200.0, 3), "1200");
    }
}
