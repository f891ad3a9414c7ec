//! Tables and numbers for the terminal.

use std::fmt;
use std::ops::{Deref, DerefMut};

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, presets};
use model::number::{decimals, trimmed};
use model::{Evidence, Vector};

use super::printable::Printable;
use super::printed::{self, Format, head, scaled};
use crate::csv::quoted;

/// Width of tables where no terminal says its own: what every terminal, mail and report has room
/// for.
const WIDTH: u16 = 80;

/// Heads of columns, narrow where together they are wider than this.
pub(super) fn heads(of: &[(String, &'static str)], room: usize) -> Vec<String> {
    let narrow = of.iter().map(|(name, _)| name.chars().count() + 2).sum::<usize>() > room;
    of.iter().map(|(name, unit)| heading(name, unit, narrow)).collect()
}

/// The head of a column with its unit below, in lines at every dot if it is to be narrow.
pub(super) fn heading(name: &str, unit: &str, narrow: bool) -> String {
    let name = Printable(name).to_string();
    let name = if narrow { name.replace('.', ".\n") } else { name };
    if unit == "1" { name } else { format!("{name}\n/ {unit}") }
}

/// Stands before each line of a table to paste, until it is printed: all other lines are comments there.
pub const PASTED: char = '\u{1}';

/// A table, in the format and the units that are asked for.
pub struct Table {
    inner: comfy_table::Table,
    head: Vec<String>,
    /// The size of the unit of each column, where it is not that of SI.
    sizes: Vec<Option<f64>>,
}

/// A table in the house style: thin rules, as wide as its content or the terminal. Where a head ends with a
/// unit, `Fx / N`, the numbers below are shown in the unit for display.
pub fn table<'a>(names: impl IntoIterator<Item = &'a str>) -> Table {
    let (names, sizes): (Vec<_>, Vec<_>) = names.into_iter().map(head).unzip();
    let mut inner = comfy_table::Table::new();
    inner
        .load_style(presets::UTF8_HORIZONTAL_ONLY.row_separator(LineStyle::none()))
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_header(names.clone());
    if inner.width().is_none() {
        inner.set_width(WIDTH);
    }
    Table { inner, head: names, sizes }
}

impl Table {
    /// One more row.
    pub fn add_row(&mut self, cells: impl IntoIterator<Item = impl Into<String>>) {
        let sizes = self.sizes.iter().copied().chain(std::iter::repeat(None));
        let cells = cells.into_iter().zip(sizes).map(|(cell, size)| {
            let cell = cell.into();
            size.map_or_else(|| cell.clone(), |size| scaled(&cell, size))
        });
        self.inner.add_row(cells.collect::<Vec<_>>());
    }

    /// Whether no cell has to be broken over lines.
    pub(super) fn fits(&self) -> bool {
        let widths = self.inner.column_max_content_widths();
        let wanted: usize = widths.iter().map(|width| usize::from(*width) + 2).sum();
        wanted + 2 <= usize::from(self.inner.width().unwrap_or(WIDTH))
    }

    /// All cells, the head first, each in one line.
    fn rows(&self) -> Vec<Vec<String>> {
        let line = |cell: &str| cell.replace(".\n", ".").replace('\n', " ");
        let head = self.head.iter().map(|cell| line(cell)).collect();
        let rows = self.inner.row_iter();
        let cells = rows.map(|row| row.cell_iter().map(|cell| line(&cell.content())).collect());
        std::iter::once(head).chain(cells).collect()
    }
}

impl Deref for Table {
    type Target = comfy_table::Table;

    fn deref(&self) -> &comfy_table::Table {
        &self.inner
    }
}

impl DerefMut for Table {
    fn deref_mut(&mut self) -> &mut comfy_table::Table {
        &mut self.inner
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = match printed::format() {
            Format::Text | Format::Json => return self.inner.fmt(f),
            Format::Markdown => markdown(&self.rows()),
            Format::Latex => latex(&self.rows()),
            Format::Csv => self.rows().iter().map(|row| joined(row, ",", cell)).collect(),
        };
        let lines: Vec<String> = lines.iter().map(|line| format!("{PASTED}{line}")).collect();
        f.write_str(&lines.join("\n"))
    }
}

fn joined(row: &[String], between: &str, cell: fn(&str) -> String) -> String {
    row.iter().map(|text| cell(text)).collect::<Vec<_>>().join(between)
}

/// Which columns have numbers alone.
fn numeric(rows: &[Vec<String>]) -> Vec<bool> {
    let columns = rows.first().map_or(0, Vec::len);
    let number = |cell: &String| cell.is_empty() || cell.parse::<f64>().is_ok();
    let column = |k: usize| rows.iter().skip(1).filter_map(move |row| row.get(k));
    (0..columns).map(|k| column(k).all(number) && column(k).any(|cell| !cell.is_empty())).collect()
}

fn markdown(rows: &[Vec<String>]) -> Vec<String> {
    let cell = |text: &str| text.replace('|', "\\|");
    let line = |row: &Vec<String>| format!("| {} |", joined(row, " | ", cell));
    let rule =
        numeric(rows).iter().map(|right| if *right { "---:|" } else { "---|" }).collect::<String>();
    let mut lines: Vec<String> = rows.iter().map(line).collect();
    lines.insert(1, format!("|{rule}"));
    lines
}

fn latex(rows: &[Vec<String>]) -> Vec<String> {
    let line = |row: &Vec<String>| joined(row, " & ", escaped) + " \\\\";
    let sides: String = numeric(rows).iter().map(|right| if *right { 'r' } else { 'l' }).collect();
    let mut lines = vec![format!("\\begin{{tabular}}{{{sides}}}"), "\\hline".to_owned()];
    for (k, row) in rows.iter().enumerate() {
        lines.push(line(row));
        if k == 0 {
            lines.push("\\hline".to_owned());
        }
    }
    lines.extend(["\\hline", "\\end{tabular}"].map(str::to_owned));
    lines
}

/// A text in LaTeX.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => out.extend(['\\', c]),
            _ => out.push(c),
        }
    }
    out
}

/// A cell of CSV; one that a spreadsheet would compute is kept from that.
fn cell(text: &str) -> String {
    if text.parse::<f64>().is_ok() { text.to_owned() } else { quoted(text) }
}

/// What is printed, ready for the format that is asked for: where tables are pasted as LaTeX or CSV the lines between
/// them are comments.
pub fn finished(text: &str) -> String {
    let comment = match printed::format() {
        Format::Text | Format::Json => return text.to_owned(),
        Format::Markdown => "",
        Format::Latex => "% ",
        Format::Csv => "# ",
    };
    let line = |line: &str| match line.strip_prefix(PASTED) {
        Some(pasted) => pasted.to_owned(),
        None if line.is_empty() => String::new(),
        None => format!("{comment}{line}"),
    };
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

/// Longest text of a first column that is a number, as `12'`, and is not broken either.
const LABEL: usize = 3;

/// Right-align the columns from `first` on, close to each other, and break none of their numbers.
pub fn numbers_from(table: &mut Table, first: usize) {
    let label = |row: &Vec<String>| row.first().is_none_or(|cell| cell.chars().count() <= LABEL);
    if table.rows().iter().all(label)
        && let Some(column) = table.column_mut(0)
    {
        column.set_constraint(ColumnConstraint::ContentWidth);
    }
    for column in table.column_iter_mut().skip(first) {
        column.set_cell_alignment(CellAlignment::Right);
        column.set_constraint(ColumnConstraint::ContentWidth);
        column.set_padding((0, 1));
    }
}

/// A number for reading: six significant digits.
pub fn short(x: f64) -> String {
    significant(x, 6)
}

/// A number for comparing: fifteen significant digits.
pub fn long(x: f64) -> String {
    significant(x, 15)
}

/// Two numbers to so many significant digits, rounded away from each other, where they differ by more than rounding.
pub fn outwards(ends: [f64; 2], digits: usize) -> [String; 2] {
    let shown = |(x, sign): (f64, f64)| {
        let nearest = significant(x, digits);
        let inside = nearest.parse().is_ok_and(|shown: f64| sign * (shown - x) < -1e-14 * x.abs());
        let unit = 10_f64.powf(x.abs().log10().floor() + 1.0 - digits as f64);
        if inside { significant(x + sign * unit, digits) } else { nearest }
    };
    [(ends[0], -1.0), (ends[1], 1.0)].map(shown)
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
    fixed(x, decimals(x, digits, usize::MAX))
}

/// So many decimals, but no zeros at their end.
pub fn fixed(x: f64, decimals: usize) -> String {
    trimmed(&format!("{x:.decimals$}")).to_owned()
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

/// A text whose sentences fit into 80 columns: what is no line of a table is wrapped.
pub(super) fn fitted(text: &str) -> String {
    let is_prose = |line: &str| !line.starts_with([' ', PASTED, '\u{2500}', '\u{2550}']);
    let fit = |line: &str| if is_prose(line) { wrapped(line, 2) } else { line.to_owned() };
    text.split('\n').map(fit).collect::<Vec<_>>().join("\n")
}

/// A number of things, in words: `1 member`, `2 members`.
pub(crate) fn counted(number: usize, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
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
    use super::{outwards, significant, wrapped};

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
    #[test]
    fn ranges_are_rounded_outwards() {
        assert_eq!(outwards([241.937_59, 242.729_01], 6), ["241.937", "242.73"]);
        assert_eq!(outwards([0.3, 0.3], 6), ["0.3", "0.3"]);
        assert_eq!(outwards([-1.000_000_1e-9, 0.0], 6), ["-1.00001e-9", "0"]);
        assert_eq!(outwards([-9.999_994, 9.999_996], 6), ["-10", "10"]);
    }
}
