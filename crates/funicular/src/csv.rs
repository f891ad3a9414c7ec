//! Numbers and names as cells of CSV.

use std::fmt;

use model::number::decimals;

use crate::text::tables::{fixed, short};

/// What is this much smaller than the largest of its kind is the rounding of a zero: solvers agree
/// to less.
const ROUNDING: f64 = 1e-12;

/// How the numbers of one kind are written: zeros that rounding has left as `5.5e-17` or `-0.0` as
/// 0. (JSON keeps all digits.)
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numbers {
    rounding: f64,
    largest: f64,
    /// Decimals of numbers that differ by little of what they are; else six digits each.
    decimals: Option<usize>,
}

impl Numbers {
    /// For numbers of which these are the largest.
    pub(crate) fn of<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Self {
        let largest = numbers.into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        Self { rounding: ROUNDING * largest, largest, decimals: None }
    }

    /// The same for numbers that are apart by no more than this, as coordinates far from their origin: six digits of
    /// that.
    pub(crate) fn apart(mut self, by: f64) -> Self {
        /// Six digits of a number show three of a difference as large as this part of it.
        const LITTLE: f64 = 1e-3;
        if by > 0.0 && by < LITTLE * self.largest {
            self.decimals = Some(decimals(by, 6, 9));
        }
        self
    }

    /// Of columns with names and units: what is beside the largest number of its unit rounding is 0.
    pub(crate) fn of_columns(
        heads: &[(String, &str)],
        values: impl Fn(usize) -> Vec<f64>,
    ) -> Vec<Self> {
        let columns: Vec<Vec<f64>> = (0..heads.len()).map(values).collect();
        let column = |(column, (_, unit)): (&Vec<f64>, &(String, &str))| {
            let of_unit = columns.iter().zip(heads).filter(|(_, (_, other))| other == unit);
            let most = column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let least = column.iter().copied().fold(f64::INFINITY, f64::min);
            let rounding = Self::of(of_unit.flat_map(|(column, _)| column)).rounding;
            Self { rounding, ..Self::of(column).apart(most - least) }
        };
        columns.iter().zip(heads).map(column).collect()
    }

    /// The number, or 0.
    pub(crate) fn number(self, x: f64) -> f64 {
        if x.abs() <= self.rounding { 0.0 } else { x }
    }

    /// For reading.
    pub(crate) fn short(self, x: f64) -> String {
        let x = self.number(x);
        self.decimals.map_or_else(|| short(x), |decimals| fixed(x, decimals))
    }

    /// In the fewest digits that read back to it.
    pub(crate) fn cell(self, x: f64) -> String {
        exact(&self.number(x))
    }

    /// Three of them with commas between.
    pub(crate) fn cells(self, at: model::Vector) -> String {
        at.map(|x| self.cell(x)).join(",")
    }
}

/// A number in the fewest digits that read back to it.
pub(crate) fn exact(x: &impl fmt::Debug) -> String {
    format!("{x:?}")
}

/// The same, empty where there is none.
pub(crate) fn or_empty(x: Option<impl fmt::Debug>) -> String {
    x.map_or_else(String::new, |x| exact(&x))
}

/// A name, in quotes where it has to be (RFC 4180), and never a formula.
pub(crate) fn quoted(name: impl fmt::Display) -> String {
    let name = name.to_string();
    let name = model::text_cell(&name);
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.into_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::{Numbers, quoted};

    #[test]
    fn roundings_of_zero_are_zero_and_nothing_else_is() {
        let numbers = Numbers::of(&[-2.0, 0.5]);
        for (x, wanted) in
            [(-0.0, "0.0"), (5.5e-17, "0.0"), (-2e-12, "0.0"), (3e-12, "3e-12"), (0.1, "0.1")]
        {
            assert_eq!(numbers.cell(x), wanted);
        }
        assert_eq!(numbers.cells([1.0, -1e-16, -2.5]), "1.0,0.0,-2.5");
        // All of a kind may be small.
        assert_eq!(Numbers::of(&[1e-20]).cell(1e-21), "1e-21");
    }

    #[test]
    fn names_with_commas_and_quotes_are_quoted() {
        assert_eq!(quoted("lamp"), "lamp");
        assert_eq!(quoted("=HYPERLINK(\"x\",1)"), "\"'=HYPERLINK(\"\"x\"\",1)\"");
        assert_eq!(quoted("a \"b\", c"), "\"a \"\"b\"\", c\"");
    }
}
