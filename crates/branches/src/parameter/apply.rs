//! From numbers to chains.

use model::budget::OutOfMemory;
use model::system::{PrestressError, SystemError, SystemRefusal};
use model::{Anchors, Bar, BarError, Chain, ChainError, Problem, Refusal};

use crate::parameter::base::Base;
use crate::parameter::number::{AnchorEnd, BarField, Number, Which};
use crate::parameter::rows;

/// Why a point of a variation is refused: the values describe no problem.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointError {
    /// Occurs when a number of a bar is out of range.
    #[error("bar {bar}: {error}")]
    Bar {
        /// Number of the bar, from 1.
        bar: usize,
        /// What is wrong with it.
        error: BarError,
    },
    /// Occurs when a prestress does not fit its member.
    #[error("bar {bar}: {error}")]
    Prestress {
        /// Number of the bar, from 1.
        bar: usize,
        /// What is wrong with it.
        error: PrestressError,
    },
    /// Occurs when a number of the chain is out of range.
    #[error(transparent)]
    Chain(#[from] ChainError),
    /// Occurs when a row cannot have so many bars.
    #[error("a row of {value} bars: a whole number from 1 to {most} is allowed")]
    Count {
        /// The count.
        value: f64,
        /// The largest that is allowed.
        most: usize,
    },
    /// Occurs when a row that gets another count has bars that are not equal.
    #[error(
        "bars {first} to {last} get other numbers than each other: a row with a count has equal bars"
    )]
    Unequal {
        /// Number of the first bar of the row, from 1.
        first: usize,
        /// Number of the last one.
        last: usize,
    },
    /// Occurs when a system of so many bars does not fit into memory.
    #[error(transparent)]
    Memory(#[from] OutOfMemory),
    /// Occurs when the chain is no equilibrium problem: out of reach, straight, without mass.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// Occurs when a number of a system is out of range.
    #[error(transparent)]
    System(#[from] SystemError),
    /// Occurs when the system has no equilibrium: a part falls, lengths do not close a loop.
    #[error(transparent)]
    SystemRefused(#[from] Box<SystemRefusal>),
}

/// The chain with these numbers in place of its own, validated.
///
/// # Errors
///
/// [`PointError`] when a number is out of range or the chain has no answer.
pub fn apply(base: &Chain, numbers: &[(Number, f64)]) -> Result<Problem, PointError> {
    let UncheckedChain { gravity_m_s2, anchors, mut bars } = UncheckedChain::new(base, numbers);
    for (row, value) in counts(base, numbers) {
        let [first, last] = row;
        let old = last - first + 1;
        let count = rows::number(value, bars.len() - old)?;
        if bars[first..=last].windows(2).any(|two| two[0] != two[1]) {
            return Err(PointError::Unequal { first: first + 1, last: last + 1 });
        }
        let bar = bars[first].divided(old as f64 / count as f64);
        bars.splice(first..=last, std::iter::repeat_n(bar, count));
    }
    let bars = bars
        .iter()
        .enumerate()
        .map(|(k, bar)| bar.bar().map_err(|error| PointError::Bar { bar: k + 1, error }));
    let bars: Vec<Bar> = bars.collect::<Result<_, _>>()?;
    let chain = Chain::new(base.name(), gravity_m_s2, anchors, bars)?;
    Ok(Problem::new(chain)?)
}

/// The rows, from 0, that get another count, the last one first, with it.
pub(super) fn counts<B: Base>(base: &B, numbers: &[(Number, f64)]) -> Vec<([usize; 2], f64)> {
    let row = |(number, value): &(Number, f64)| match base.resolved(number) {
        Number::Bar(Which::Range(first, last), BarField::Count) => {
            Some(([first - 1, last - 1], *value))
        }
        _ => None,
    };
    let mut rows: Vec<_> = numbers.iter().filter_map(row).collect();
    rows.sort_by_key(|(row, _)| std::cmp::Reverse(*row));
    rows
}

/// The numbers of a chain, not checked: between two points of a path they need not describe a
/// problem.
pub(crate) struct UncheckedChain {
    pub(crate) gravity_m_s2: f64,
    pub(crate) anchors: Anchors,
    pub(crate) bars: Vec<UncheckedBar>,
}

impl UncheckedChain {
    pub(crate) fn new(base: &Chain, numbers: &[(Number, f64)]) -> Self {
        let mut chain = Self {
            gravity_m_s2: base.gravity_m_s2(),
            anchors: *base.anchors(),
            bars: base.bars().iter().map(UncheckedBar::new).collect(),
        };
        for (number, value) in numbers {
            chain.set(number, *value);
        }
        chain
    }

    fn set(&mut self, number: &Number, value: f64) {
        match number {
            Number::Gravity => self.gravity_m_s2 = value,
            Number::Anchor(AnchorEnd::Start, axis) => self.anchors.start_m[*axis] = value,
            Number::Anchor(AnchorEnd::End, axis) => self.anchors.end_m[*axis] = value,
            // A chain has none of them; its variations are refused before.
            Number::Loads
            | Number::Lengths
            | Number::Floor
            | Number::Joint(..)
            | Number::Row(..) => {}
            Number::Bar(which, field) => {
                let named = self.bars.iter_mut().enumerate().filter(|(k, _)| which.has(k + 1));
                for (_, bar) in named {
                    bar.set(*field, value);
                }
            }
        }
    }
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

    /// Distance of the centre of weight from the first joint, m.
    pub(crate) fn centre_m(&self) -> f64 {
        self.centre_m.unwrap_or(0.5 * self.length_m)
    }

    pub(super) fn bar(&self) -> Result<Bar, BarError> {
        Bar::given(self.length_m, self.mass_kg, self.centre_m, self.inertia_kg_m2)
    }
}
