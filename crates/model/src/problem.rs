//! Chains that have an answer, and the refusal of those that have none.

use crate::readable::{Computed, Readable};
use crate::{Anchors, Bar, Chain};

/// How near to straight is straight, relative to the total length.
///
/// The span, the total length and their difference each carry a rounding error of about one unit in
/// the last place of the total; sixteen units leave room for them and for the roundings in the
/// decimal numbers of a file. A chain this straight cannot be told from a taut one.
pub const STRAIGHT_TOLERANCE: f64 = 16.0 * f64::EPSILON;

/// What the rounding of the anchors' coordinates can change the span by, relative to the largest of
/// them: six coordinates, half a unit in the last place each.
const ANCHOR_ROUNDING: f64 = 3.0 * f64::EPSILON;

/// A chain for which the question "where does it come to rest, with which forces?" has an answer.
///
/// ```
/// use model::{Anchors, Bar, Chain, Problem, Refusal};
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [3.5, 0.0, 0.0] };
/// let chain = Chain::new("too short", 9.81, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 3])?;
/// assert_eq!(
///     Problem::new(chain).unwrap_err(),
///     Refusal::OutOfReach { span_m: 3.5, total_length_m: 3.0 }
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Problem(Chain);

/// Why a chain is no equilibrium problem.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// Occurs when the chain is one bar that fits between the anchors: it cannot move, and the
    /// anchors share the force along it in any way they like.
    #[error(
        "a single bar between two fixed points cannot move, and the force along it is indeterminate \
         (length {} m, span {} m)", Readable(*length_m), Computed::of(*span_m)
    )]
    SingleBar {
        /// Length of the bar.
        length_m: f64,
        /// Distance of the anchors.
        span_m: f64,
    },
    /// Occurs when the anchors are further apart than the bars reach.
    #[error(
        "the anchors are {} m apart and the bars reach only {} m: {} m are missing",
        Computed::of(*span_m), Computed::of(*total_length_m), Computed::difference(*span_m, *total_length_m)
    )]
    OutOfReach {
        /// Distance of the anchors.
        span_m: f64,
        /// Sum of the lengths.
        total_length_m: f64,
    },
    /// Occurs when the chain is straight and taut: it cannot move, and the force along it is
    /// indeterminate.
    #[error(
        "the bars reach from anchor to anchor and no further (total length {} m, span \
         {} m): the chain is straight and taut, and the force along it is indeterminate",
        Computed::of(*total_length_m), Computed::of(*span_m)
    )]
    Taut {
        /// Distance of the anchors.
        span_m: f64,
        /// Sum of the lengths.
        total_length_m: f64,
    },
    /// Occurs when one bar is longer than the other bars and the span together can close.
    #[error(
        "bar {bar} is {} m long, longer than the other bars ({} m) and the span ({} m) together: \
         the chain cannot close",
        Readable(*length_m), Computed::of(*rest_m), Computed::of(*span_m)
    )]
    BarTooLong {
        /// Number of the bar, from 1.
        bar: usize,
        /// Its length.
        length_m: f64,
        /// Sum of the other lengths.
        rest_m: f64,
        /// Distance of the anchors.
        span_m: f64,
    },
    /// Occurs when one bar is exactly as long as the other bars and the span together: the chain
    /// closes only folded on one straight line, and the force along it is indeterminate.
    #[error(
        "bar {bar} is {} m long, exactly as long as the other bars ({} m) and the span ({} m) \
         together: the chain closes only folded on one line, and the force along it is indeterminate",
        Readable(*length_m), Computed::of(*rest_m), Computed::of(*span_m)
    )]
    Folded {
        /// Number of the bar, from 1.
        bar: usize,
        /// Its length.
        length_m: f64,
        /// Sum of the other lengths.
        rest_m: f64,
        /// Distance of the anchors.
        span_m: f64,
    },
    /// Occurs when the anchors are so far from the origin that the rounding of their coordinates
    /// decides whether the chain can hang, or cannot close, or is straight.
    #[error(
        "the coordinates of the anchors reach {} m, where doubles place the anchors only to \
         {rounding_m:e} m, and the bars are only {margin_m:e} m away from being straight",
        Readable(*coordinate_m)
    )]
    Unresolved {
        /// The largest coordinate.
        coordinate_m: f64,
        /// What its rounding can change the span by.
        rounding_m: f64,
        /// What is left when the bars are stretched out or folded on one line; negative if they do
        /// not reach.
        margin_m: f64,
    },
    /// Occurs when no bar has mass: nothing hangs.
    #[error("no bar has mass: without weight every position is an equilibrium")]
    NoMass,
    /// Occurs when all mass is at the anchors, which carry its weight: nothing hangs between them.
    #[error(
        "all the weight of this chain rests on its two anchors: the energy is the same in every \
         position, and every position is an equilibrium"
    )]
    WeightOnAnchors,
}

impl Problem {
    /// Accept a chain, or say why it has no answer.
    ///
    /// # Errors
    ///
    /// [`Refusal`], with the numbers it rests on.
    pub fn new(chain: Chain) -> Result<Self, Refusal> {
        if chain.bars().len() > 1 && chain.bars().iter().all(|bar| bar.mass_kg() <= 0.0) {
            return Err(Refusal::NoMass);
        }
        if chain.bars().len() > 1
            && (1..chain.bars().len()).all(|joint| carries_nothing(&chain, joint))
        {
            return Err(Refusal::WeightOnAnchors);
        }
        let span_m = chain.anchors().span_m();
        let total_length_m = chain.total_length_m();
        match margin(&chain, total_length_m, total_length_m - span_m)? {
            Margin::Negative => return Err(Refusal::OutOfReach { span_m, total_length_m }),
            Margin::Zero => {
                return Err(match chain.bars() {
                    [bar] => Refusal::SingleBar { length_m: bar.length_m(), span_m },
                    _ => Refusal::Taut { span_m, total_length_m },
                });
            }
            Margin::Positive => {}
        }
        let (index, length_m) = longest(chain.bars());
        let bar = index + 1;
        let others = chain.bars().iter().enumerate().filter(|(k, _)| *k != index);
        let rest_m = crate::sum(others.map(|(_, other)| other.length_m()));
        match margin(&chain, total_length_m, span_m - length_m + rest_m)? {
            Margin::Negative => Err(Refusal::BarTooLong { bar, length_m, rest_m, span_m }),
            Margin::Zero => Err(Refusal::Folded { bar, length_m, rest_m, span_m }),
            Margin::Positive => Ok(Self(chain)),
        }
    }

    /// The chain.
    #[must_use]
    pub fn chain(&self) -> &Chain {
        &self.0
    }

    /// Give the chain back.
    #[must_use]
    pub fn into_chain(self) -> Chain {
        self.0
    }
}

/// Whether a joint between the anchors carries no weight at all: a question about the data as they
/// stand, without rounding.
fn carries_nothing(chain: &Chain, joint: usize) -> bool {
    let (before, after) = (&chain.bars()[joint - 1], &chain.bars()[joint]);
    (before.mass_kg() <= 0.0 || before.centre_m() <= 0.0)
        && (after.mass_kg() <= 0.0 || after.centre_m() >= after.length_m())
}

/// Whether there is room between the bars and a straight line.
enum Margin {
    Negative,
    /// As near to zero as the numbers can tell.
    Zero,
    Positive,
}

/// The sign of a sum or difference of the total length, the span and lengths of bars.
fn margin(chain: &Chain, total_length_m: f64, margin_m: f64) -> Result<Margin, Refusal> {
    let Anchors { start_m, end_m } = chain.anchors();
    let coordinate_m = start_m.iter().chain(end_m).fold(0.0_f64, |a, x| a.max(x.abs()));
    let rounding_m = ANCHOR_ROUNDING * coordinate_m;
    if margin_m.abs() <= STRAIGHT_TOLERANCE * total_length_m {
        Ok(Margin::Zero)
    } else if margin_m.abs() <= rounding_m {
        Err(Refusal::Unresolved { coordinate_m, rounding_m, margin_m })
    } else if margin_m < 0.0 {
        Ok(Margin::Negative)
    } else {
        Ok(Margin::Positive)
    }
}

/// Index and length of the first longest bar.
fn longest(bars: &[Bar]) -> (usize, f64) {
    bars.iter().enumerate().fold((0, 0.0), |(best, length), (k, bar)| {
        if bar.length_m() > length { (k, bar.length_m()) } else { (best, length) }
    })
}
