//! Chains that have an answer, and the refusal of those that have none.

use crate::{Bar, Chain};

/// How near to straight is straight, relative to the total length.
///
/// The span, the total length and their difference each carry a rounding error of about one unit in
/// the last place of the total; sixteen units leave room for them and for the roundings in the
/// decimal numbers of a file. A chain this straight cannot be told from a taut one.
pub const STRAIGHT_TOLERANCE: f64 = 16.0 * f64::EPSILON;

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
    /// Occurs when the chain has one bar: it cannot move, and the anchors share the force along it
    /// in any way they like.
    #[error(
        "a single bar between two fixed points cannot move, and the force along it is indeterminate \
         (length {length_m} m, span {span_m} m)"
    )]
    SingleBar {
        /// Length of the bar.
        length_m: f64,
        /// Distance of the anchors.
        span_m: f64,
    },
    /// Occurs when the anchors are further apart than the bars reach.
    #[error(
        "the anchors are {span_m} m apart and the bars reach only {total_length_m} m: \
         {} m are missing", span_m - total_length_m
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
        "the bars reach exactly from anchor to anchor (total length {total_length_m} m, span {span_m} m): \
         the chain is straight and taut, and the force along it is indeterminate"
    )]
    Taut {
        /// Distance of the anchors.
        span_m: f64,
        /// Sum of the lengths.
        total_length_m: f64,
    },
    /// Occurs when one bar is longer than the other bars and the span together can close.
    #[error(
        "bar {bar} is {length_m} m long, longer than the other bars ({rest_m} m) and the span \
         ({span_m} m) together: the chain cannot close"
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
        "bar {bar} is {length_m} m long, exactly as long as the other bars ({rest_m} m) and the span \
         ({span_m} m) together: the chain closes only folded on one line, and the force along it is \
         indeterminate"
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
    /// Occurs when no bar has mass: nothing hangs.
    #[error("no bar has mass: without weight every position is an equilibrium")]
    NoMass,
}

impl Problem {
    /// Accept a chain, or say why it has no answer.
    ///
    /// # Errors
    ///
    /// [`Refusal`], with the numbers it rests on.
    ///
    /// # Panics
    ///
    /// Never: a [`Chain`] has at least one bar.
    pub fn new(chain: Chain) -> Result<Self, Refusal> {
        let span_m = chain.anchors().span_m();
        let total_length_m = chain.total_length_m();
        let tolerance_m = STRAIGHT_TOLERANCE * total_length_m;
        if let [bar] = chain.bars() {
            return Err(Refusal::SingleBar { length_m: bar.length_m(), span_m });
        }
        if chain.bars().iter().all(|bar| bar.mass_kg() <= 0.0) {
            return Err(Refusal::NoMass);
        }
        let slack_m = total_length_m - span_m;
        if slack_m < -tolerance_m {
            return Err(Refusal::OutOfReach { span_m, total_length_m });
        }
        if slack_m <= tolerance_m {
            return Err(Refusal::Taut { span_m, total_length_m });
        }
        let (index, length_m) = longest(chain.bars());
        let bar = index + 1;
        let others = chain.bars().iter().enumerate().filter(|(k, _)| *k != index);
        let rest_m = crate::sum(others.map(|(_, other)| other.length_m()));
        let margin_m = rest_m + span_m - length_m;
        if margin_m < -tolerance_m {
            return Err(Refusal::BarTooLong { bar, length_m, rest_m, span_m });
        }
        if margin_m <= tolerance_m {
            return Err(Refusal::Folded { bar, length_m, rest_m, span_m });
        }
        Ok(Self(chain))
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

/// Index and length of the first longest bar.
fn longest(bars: &[Bar]) -> (usize, f64) {
    bars.iter().enumerate().fold((0, 0.0), |(best, length), (k, bar)| {
        if bar.length_m() > length { (k, bar.length_m()) } else { (best, length) }
    })
}
