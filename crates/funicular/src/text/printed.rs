//! How what is printed looks: tables for people or to paste, units, and characters.

use std::sync::OnceLock;

use super::tables::{short, significant};

/// How tables are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "program", derive(clap::ValueEnum))]
pub enum Format {
    /// For a terminal.
    #[default]
    Text,
    /// Tables of Markdown.
    Markdown,
    /// `tabular` of LaTeX.
    Latex,
    /// Lines of CSV.
    Csv,
    /// One object.
    Json,
}

/// A unit for display, and what it stands in the place of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    name: &'static str,
    of: &'static str,
    /// How much of `of` it is.
    size: f64,
}

const fn one(name: &'static str, of: &'static str, size: f64) -> Unit {
    Unit { name, of, size }
}

/// All units. The pound and its force are exact by definition (0.45359237 kg, times standard gravity).
const UNITS: [Unit; 18] = [
    one("N", "N", 1.0),
    one("kN", "N", 1e3),
    one("MN", "N", 1e6),
    one("kgf", "N", 9.806_65),
    one("lbf", "N", 4.448_221_615_260_5),
    one("m", "m", 1.0),
    one("mm", "m", 1e-3),
    one("cm", "m", 1e-2),
    one("km", "m", 1e3),
    one("ft", "m", 0.3048),
    one("in", "m", 0.0254),
    one("J", "J", 1.0),
    one("kJ", "J", 1e3),
    one("MJ", "J", 1e6),
    one("kg", "kg", 1.0),
    one("g", "kg", 1e-3),
    one("t", "kg", 1e3),
    one("lb", "kg", 0.453_592_37),
];

/// The unit of this name.
///
/// # Errors
/// Which are allowed.
pub fn unit(text: &str) -> Result<Unit, String> {
    UNITS
        .into_iter()
        .find(|unit| unit.name == text)
        .ok_or_else(|| format!("allowed are {}", UNITS.map(|unit| unit.name).join(", ")))
}

/// What was asked for, for all that is printed.
static STYLE: OnceLock<Style> = OnceLock::new();

/// How tables look.
#[derive(Debug, Clone, Default)]
pub struct Style {
    /// Characters between the cells.
    pub format: Format,
    /// Units for display.
    pub units: Vec<Unit>,
    /// ASCII alone.
    pub ascii: bool,
}

impl Style {
    /// Print in this way from now on; before anything is printed.
    pub fn install(self) {
        // The first stands: a command asks once.
        let _ = STYLE.set(self);
    }
}

/// How tables are printed.
pub fn format() -> Format {
    STYLE.get().map_or(Format::Text, |style| style.format)
}

/// Whether only ASCII may be printed.
pub fn ascii() -> bool {
    static LOCALE: OnceLock<bool> = OnceLock::new();
    STYLE.get().is_some_and(|style| style.ascii) || *LOCALE.get_or_init(other_characters)
}

/// Whether the locale names a set of characters that is not UTF-8. Where none is named nothing is known of the
/// terminal, and those of today know UTF-8.
fn other_characters() -> bool {
    let set = |name: &&str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let Some(name) = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find(set) else { return false };
    let value = std::env::var_os(name).unwrap_or_default().to_string_lossy().to_lowercase();
    !(value.contains("utf-8") || value.contains("utf8"))
}

/// The unit for display of numbers in a unit of SI: its name, and what to multiply them by.
pub(super) fn display(of: &str) -> Option<(&'static str, f64)> {
    let units = &STYLE.get()?.units;
    units.iter().rev().find(|unit| unit.of == of).map(|unit| (unit.name, unit.size))
}

/// A number with its unit: six significant digits.
pub fn quantity(x: f64, of: &str) -> String {
    numbers(&[x], of, short)
}

/// Some numbers with commas between, the unit behind.
pub fn numbers(all: &[f64], of: &str, digits: impl Fn(f64) -> String) -> String {
    let (name, size) = display(of).unwrap_or((of, 1.0));
    let all: Vec<String> = all.iter().map(|x| digits(x / size)).collect();
    match &all[..] {
        [one] => format!("{one} {name}"),
        _ => format!("({}) {name}", all.join(", ")),
    }
}

/// The head of a column, `Fx / N`, in the unit for display, with the size of that.
pub fn head(text: &str) -> (String, Option<f64>) {
    let found = text.rsplit_once("/ ").and_then(|(what, of)| Some((what, display(of)?)));
    match found {
        Some((what, (name, size))) => (format!("{what}/ {name}"), Some(size)),
        None => (text.to_owned(), None),
    }
}

/// The numbers of a cell in a unit of this size, with as many digits as they have.
pub fn scaled(cell: &str, size: f64) -> String {
    let word = |word: &str| {
        // Also of a vector in brackets.
        let number = word.trim_matches(['(', ')', ',']);
        match number.parse::<f64>() {
            Ok(x) => word.replace(number, &significant(x / size, digits(number).max(6))),
            Err(_) => word.to_owned(),
        }
    };
    cell.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// How many significant digits a number is written with.
fn digits(number: &str) -> usize {
    let mantissa = number.split(['e', 'E']).next().unwrap_or_default();
    mantissa.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit).count()
}

/// The same text in ASCII.
pub fn in_ascii(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\u{2500}' | '\u{2212}' => out.push('-'),
            '\u{2550}' => out.push('='),
            '\u{2026}' => out.push('~'),
            '\u{b0}' => out.push_str("deg"),
            '\u{b2}' => out.push_str("^2"),
            c if c.is_ascii() => out.push(c),
            _ => out.push('?'),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_keep_their_digits_in_another_unit() {
        assert_eq!(scaled("1234.56", 1e3), "1.23456");
        assert_eq!(scaled("-47.0719212345678", 1e3), "-0.0470719212345678");
        assert_eq!(scaled("5 to 7.5", 1e-3), "5000 to 7500");
        assert_eq!(scaled("only this", 1e3), "only this");
        assert_eq!(scaled("(0.122489, 0, -0.380784)", 1e-3), "(122.489, 0, -380.784)");
        assert_eq!(unit("kN").map(|unit| (unit.of, unit.size)), Ok(("N", 1e3)));
        assert!(unit("stone").is_err());
    }
}
