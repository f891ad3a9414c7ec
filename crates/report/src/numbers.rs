//! Numbers within running text; in tables they stay numbers ([`Cell`](crate::cell::Cell)).

use model::number::Number;

/// A fixed number of decimals.
pub(crate) fn fixed(x: f64, decimals: usize) -> String {
    Number::decimals(x, decimals).to_string()
}

/// Significant digits, or a bound in words where the number is rounding.
pub(crate) fn in_words(x: f64, digits: usize) -> String {
    Number::significant(x, digits).in_words()
}
