//! The words of the evidence, all of them.
//!
//! The alternate form, `{:#}`, tells what is only rounding as a bound, the same on every machine.

mod proofs;
mod reasons;

use std::fmt::Formatter;

use crate::number::Number;

/// What may be only rounding, in the form that is asked for.
fn size(f: &Formatter<'_>, value: f64) -> String {
    let number = Number::size(value, 1);
    if f.alternate() { format!("{number:#}") } else { number.to_string() }
}

/// The place in a list, counted from 1.
pub(super) fn ordinal(number: usize) -> String {
    let ending = match (number % 100, number % 10) {
        (11..=13, _) => "th",
        (_, 1) => "st",
        (_, 2) => "nd",
        (_, 3) => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}

/// A number of things.
pub(super) fn counted(number: usize, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}
