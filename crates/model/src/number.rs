//! Numbers as they are told to a reader: the value, and how many of its digits mean something.
//!
//! What differs from processor to processor is the rounding of sines and cosines, a few units of
//! the last place. A page that is to be the same on every machine tells numbers of that size as a
//! bound, and all others with no more digits than are stable: that is what the alternate form,
//! `{:#}`, does.

use std::fmt::{self, Display, Formatter};

/// A number with the digits that it is told with.
///
/// ```
/// use model::number::Number;
/// assert_eq!(Number::decimals(-0.6489, 3).to_string(), "-0.649");
/// assert_eq!(Number::significant(0.522_916_3, 4).to_string(), "0.5229");
/// // Rounding, in full for those who look, as a bound for those who compare.
/// let rounding = Number::size(3.1e-16, 0);
/// assert_eq!(format!("{rounding}"), "3e-16");
/// assert_eq!(format!("{rounding:#}"), "<\u{a0}10⁻¹²");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// The value.
    pub value: f64,
    /// How it is told.
    pub digits: Digits,
}

/// How a number is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// So many decimals.
    Decimals(usize),
    /// So many significant digits; below 1e-6 a bound.
    Significant(usize),
    /// An integer as it is; anything else with four significant digits.
    Count,
    /// The order of magnitude of a rounding: so many decimals and a power of ten.
    Size(usize),
}

impl Number {
    /// A fixed number of decimals.
    pub const fn decimals(value: f64, decimals: usize) -> Self {
        Self { value, digits: Digits::Decimals(decimals) }
    }

    /// Significant digits, or a bound where the number is rounding.
    pub const fn significant(value: f64, digits: usize) -> Self {
        Self { value, digits: Digits::Significant(digits) }
    }

    /// A number that counts something.
    ///
    /// ```
    /// use model::number::Number;
    /// assert_eq!(Number::count(4.0).to_string(), "4");
    /// ```
    pub const fn count(value: f64) -> Self {
        Self { value, digits: Digits::Count }
    }

    /// An order of magnitude, with so many decimals.
    pub const fn size(value: f64, decimals: usize) -> Self {
        Self { value, digits: Digits::Size(decimals) }
    }

    /// The stable form within a sentence: `less than` where a cell of a table has a sign.
    ///
    /// ```
    /// assert_eq!(model::number::Number::significant(1e-15, 2).in_words(), "less than 10⁻¹²");
    /// ```
    pub fn in_words(self) -> String {
        match bound(self.value) {
            Some(bound) if self.is_told_as_bound() => format!("less than {bound}"),
            _ => format!("{self:#}"),
        }
    }

    /// Whether the stable form of small values is a bound.
    fn is_told_as_bound(self) -> bool {
        match self.digits {
            Digits::Decimals(_) => false,
            Digits::Significant(_) | Digits::Size(_) => true,
            Digits::Count => self.value.fract().abs() > 0.0,
        }
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let x = self.value;
        match self.digits {
            Digits::Decimals(decimals) => f.write_str(&fixed(x, decimals)),
            Digits::Significant(digits) => f.write_str(&measured(x, digits)),
            Digits::Count if x.fract().abs() > 0.0 => f.write_str(&measured(x, COUNTED)),
            Digits::Count => f.write_str(&fixed(x, 0)),
            Digits::Size(decimals) if f.alternate() => f.write_str(&measured(x, decimals + 1)),
            Digits::Size(_) if x.abs() <= 0.0 => f.write_str("0"),
            Digits::Size(decimals) => write!(f, "{x:.decimals$e}"),
        }
    }
}

/// A number in a sentence: four significant digits, with a power of ten where zeros would hide them.
///
/// ```
/// use model::number::Brief;
/// assert_eq!(Brief(8.0).to_string(), "8");
/// assert_eq!(Brief(-1234.56).to_string(), "-1235");
/// assert_eq!(Brief(0.0).to_string(), "0");
/// assert_eq!(Brief(1.234_56e-7).to_string(), "1.235e-7");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Brief(pub f64);

impl Display for Brief {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        Rounded { value: self.0, digits: 4 }.fmt(f)
    }
}

/// A number to so many significant digits, with a power of ten where zeros would hide them; zero has no sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounded {
    /// The number.
    pub value: f64,
    /// The digits, at least 1.
    pub digits: usize,
}

impl Display for Rounded {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { value, digits } = *self;
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        let rounded = text.parse().unwrap_or(value) + 0.0;
        if rounded.abs() <= 0.0 || (LEAST..MANY).contains(&rounded.abs()) {
            write!(f, "{rounded}")
        } else {
            write!(f, "{rounded:e}")
        }
    }
}

/// Below this, and from that on, zeros would hide the digits of a number in a sentence.
const LEAST: f64 = 1e-4;
const MANY: f64 = 1e9;

/// Significant digits of a number that is not a whole number.
const COUNTED: usize = 4;

/// Bounds for what is only rounding, largest first: value and text. A number is told as the
/// smallest of them that it stays below.
const BOUNDS: [(f64, &str); 3] = [(1e-6, "10⁻⁶"), (1e-9, "10⁻⁹"), (1e-12, "10⁻¹²")];

/// The smallest bound that a number stays below.
fn bound(x: f64) -> Option<&'static str> {
    BOUNDS.iter().rfind(|(bound, _)| x.abs() < *bound).map(|(_, text)| *text)
}

/// `digits` significant digits in plain notation, or a bound where the number is rounding.
fn measured(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return "not a number".to_owned();
    }
    match bound(x) {
        Some(bound) => format!("<\u{a0}{bound}"),
        None if x.abs() < SMALL => powered(x, digits),
        None => significant(x, digits),
    }
}

/// Below this zeros would hide the digits.
const SMALL: f64 = 1e-3;

/// Digits and a power of ten.
fn powered(x: f64, digits: usize) -> String {
    let text = format!("{x:.*e}", digits.saturating_sub(1));
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let raised = exponent.chars().filter_map(|c| match c {
        '-' => Some('⁻'),
        digit => RAISED.get(digit.to_digit(10)? as usize).copied(),
    });
    format!("{digits}×10{}", raised.collect::<String>())
}

/// Digits as exponents.
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// A fixed number of decimals, never a negative zero.
fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(positive) if positive.bytes().all(|b| matches!(b, b'0' | b'.')) => positive.to_owned(),
        _ => text,
    }
}

/// `digits` significant digits without trailing zeros.
fn significant(x: f64, digits: usize) -> String {
    trimmed(&fixed(x, decimals(x, digits, usize::MAX))).to_owned()
}

/// The decimals that show so many significant digits of a number, and no more than `most`.
///
/// ```
/// use model::number::decimals;
/// assert_eq!([12.5, 0.125, 1e-9, 0.0].map(|x| decimals(x, 4, 6)), [2, 4, 6, 6]);
/// ```
pub fn decimals(x: f64, digits: usize, most: usize) -> usize {
    let wanted = digits as f64 - 1.0 - x.abs().log10().floor();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it saturates")]
    let wanted = wanted as usize;
    wanted.min(most)
}

/// A number in decimals without the zeros at its end.
pub fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}
