//! From numbers to chains.

use model::system::{PrestressError, SystemError, SystemRefusal};
use model::{Anchors, Bar, BarError, Chain, ChainError, Problem, Refusal};

use crate::parameter::number::{AnchorEnd, BarField, Number};

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
    let UncheckedChain { gravity_m_s2, anchors, bars } = UncheckedChain::new(base, numbers);
    let bars = bars
        .iter()
        .enumerate()
        .map(|(k, bar)| bar.bar().map_err(|error| PointError::Bar { bar: k + 1, error }));
    let bars: Vec<Bar> = bars.collect::<Result<_, _>>()?;
    let chain = Chain::new(base.name(), gravity_m_s2, anchors, bars)?;
    Ok(Problem::new(chain)?)
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
            Number::Loads | Number::Floor | Number::Joint(..) | Number::Row(..) => {}
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
            // Of the member around the bar.
            BarField::Stiffness | BarField::Prestress | BarField::LengthTolerance => {}
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
