//! Numbers that are out of range, and bars whose numbers are not checked yet.

use model::budget::OutOfMemory;
use model::system::{PrestressError, Refusal, SystemError};
use model::{Bar, BarError};

use crate::parameter::number::{BarField, Number, Which};

/// Why a point of a variation is refused: the values describe no problem. Numbers count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum PointError {
    /// Occurs when a number of a bar is out of range.
    #[error("bar {bar}: {error}")]
    Bar { bar: usize, error: BarError },
    /// Occurs when a prestress does not fit its member.
    #[error("bar {bar}: {error}")]
    Prestress { bar: usize, error: PrestressError },
    /// Occurs when all equilibria of a row of rigid bars are followed and these values make it something else.
    #[error("no row of rigid bars between two anchors under upright loads")]
    NoRow,
    /// Occurs when a row cannot have so many bars.
    #[error("a row of {value} bars: a whole number from 1 to {most} is allowed")]
    Count { value: f64, most: usize },
    /// Occurs when a row that gets another count has bars that are not equal.
    #[error(
        "bars {first} to {last} get other numbers than each other: a row with a count has equal bars"
    )]
    Unequal { first: usize, last: usize },
    /// Occurs when a system of so many bars does not fit into memory.
    #[error(transparent)]
    Memory(#[from] OutOfMemory),
    /// Occurs when a number of a system is out of range.
    #[error(transparent)]
    System(#[from] SystemError),
    /// Occurs when the system has no equilibrium: a part falls, lengths do not close a loop.
    #[error(transparent)]
    Refused(#[from] Box<Refusal>),
}

/// The rows, from 0, that get another count, the last one first, with it.
pub(super) fn counts(numbers: &[Number], values: &[f64]) -> Vec<([usize; 2], f64)> {
    let row = |(number, value): (&Number, &f64)| match *number {
        Number::Bar(Which::Range(first, last), BarField::Count) => {
            Some(([first - 1, last - 1], *value))
        }
        _ => None,
    };
    let mut rows: Vec<_> = numbers.iter().zip(values).filter_map(row).collect();
    rows.sort_by_key(|(row, _)| std::cmp::Reverse(*row));
    rows
}

/// A bar whose numbers are not checked yet. A centre and moments that were left out stay so.
#[derive(Clone, PartialEq)]
pub(crate) struct UncheckedBar {
    pub(crate) length_m: f64,
    pub(crate) mass_kg: f64,
    centre_m: Option<f64>,
    inertia_kg_m2: Option<[f64; 3]>,
}

impl UncheckedBar {
    pub(super) fn new(bar: &Bar) -> Self {
        Self {
            length_m: bar.length_m(),
            mass_kg: bar.mass_kg(),
            centre_m: bar.given_centre_m(),
            inertia_kg_m2: bar.given_inertia_kg_m2(),
        }
    }

    pub(super) fn set(&mut self, field: BarField, value: f64) {
        match field {
            BarField::Length => self.length_m = value,
            BarField::Mass => self.mass_kg = value,
            BarField::Centre => self.centre_m = Some(value),
            BarField::Inertia(axis) => {
                let slender = Bar::slender_inertia(self.length_m, self.mass_kg);
                self.inertia_kg_m2.get_or_insert(slender)[axis] = value;
            }
            // Of the member around the bar, and of its row.
            BarField::Stiffness
            | BarField::Prestress
            | BarField::LengthTolerance
            | BarField::Count => {}
        }
    }

    /// A bar of a part of the length and the mass: a thing of the same section cut shorter.
    pub(super) fn divided(&self, part: f64) -> Self {
        let across = part * part * part;
        Self {
            length_m: part * self.length_m,
            mass_kg: part * self.mass_kg,
            centre_m: self.centre_m.map(|centre_m| part * centre_m),
            inertia_kg_m2: self.inertia_kg_m2.map(|[x, y, z]| [part * x, across * y, across * z]),
        }
    }

    /// A bar of the same mass that many times as long: each of its points moves along with it.
    pub(super) fn stretched(&self, factor: f64) -> Self {
        let square = factor * factor;
        Self {
            length_m: factor * self.length_m,
            mass_kg: self.mass_kg,
            centre_m: self.centre_m.map(|centre_m| factor * centre_m),
            inertia_kg_m2: self.inertia_kg_m2.map(|[x, y, z]| [x, square * y, square * z]),
        }
    }

    /// Distance of the centre of weight from the first joint, m.
    pub(crate) fn centre_m(&self) -> f64 {
        self.centre_m.unwrap_or(0.5 * self.length_m)
    }

    pub(super) fn bar(&self) -> Result<Bar, BarError> {
        Bar::given(self.length_m, self.mass_kg, self.centre_m, self.inertia_kg_m2)
    }
}
