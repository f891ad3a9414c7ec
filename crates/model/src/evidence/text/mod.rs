//! The words of the evidence, all of them.
//!
//! The alternate form, `{:#}`, tells what is only rounding as a bound, the same on every machine.

mod open;
mod reached;

use std::fmt::Formatter;

use crate::number::Number;

/// What may be only rounding, in the form that is asked for.
fn size(f: &Formatter<'_>, value: f64) -> String {
    let number = Number::size(value, 1);
    if f.alternate() { format!("{number:#}") } else { number.to_string() }
}

/// A number of things.
fn counted(number: usize, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}
