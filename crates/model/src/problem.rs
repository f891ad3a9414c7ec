//! Chains that have an answer, and the refusal of those that have none.

use crate::system::{Refusal, shortened};
use crate::{Anchors, Bar, Chain};

/// How near to straight is straight, relative to the total length.
///
/// The span, the total length and their difference each carry a rounding error of about one unit in
/// the last place of the total; sixteen units leave room for them and for the roundings in the
/// decimal numbers of a file. A chain this straight cannot be told from a taut one.
pub const STRAIGHT_TOLERANCE: f64 = 16.0 * f64::EPSILON;

/// What the rounding of the anchors' coordinates can change the span by, relative to the largest of
/// them: six coordinates, half a unit in the last place each.
pub(crate) const ANCHOR_ROUNDING: f64 = 3.0 * f64::EPSILON;

/// A chain for which the question "where does it come to rest, with which forces?" has an answer.
///
/// ```
/// use model::system::Refusal;
/// use model::{Anchors, Bar, Chain, Problem};
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [3.5, 0.0, 0.0] };
/// let chain = Chain::new("too short", 9.81, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 3])?;
/// assert!(matches!(
///     Problem::new(chain),
///     Err(Refusal::OutOfReach { distance_m: 3.5, reach_m: 3.0, .. })
/// ));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Problem(Chain);

impl Problem {
    /// Accept a chain, or say why it has no answer.
    ///
    /// # Errors
    /// [`Refusal`], with the numbers it rests on.
    pub fn new(chain: Chain) -> Result<Self, Refusal> {
        let bars = chain.bars();
        if bars.len() > 1 && bars.iter().all(|bar| bar.mass_kg() <= 0.0) {
            return Err(Refusal::NoLoad);
        }
        if bars.len() > 1 && (1..bars.len()).all(|joint| carries_nothing(&chain, joint)) {
            return Err(Refusal::LoadOnAnchors);
        }
        let distance_m = chain.anchors().span_m();
        let reach_m = chain.total_length_m();
        let joint = bars.len();
        let named = |from: usize, to: usize| (from.to_string(), to.to_string());
        match margin(&chain, reach_m, reach_m - distance_m)? {
            Margin::Negative => {
                let (from, to) = named(0, joint);
                return Err(Refusal::OutOfReach { from, to, joint, distance_m, reach_m });
            }
            Margin::Zero if joint == 1 => return Err(Refusal::NothingMoves),
            Margin::Zero => {
                let (from, to) = named(0, joint);
                return Err(Refusal::Taut { from, to, joint, distance_m, reach_m });
            }
            Margin::Positive => {}
        }
        let (k, length_m) = longest(bars);
        let others = bars.iter().enumerate().filter(|(other, _)| *other != k);
        let rest_m = crate::sum(others.map(|(_, other)| other.length_m()).chain([distance_m]));
        let found = margin(&chain, reach_m, rest_m - length_m)?;
        if matches!(found, Margin::Positive) {
            return Ok(Self(chain));
        }
        let ((from, to), member) = (named(k, k + 1), k + 1);
        // The loop over the anchors, the other way round.
        let joints = (0..=k).rev().chain((k + 1..=joint).rev());
        let way = shortened(joints.map(|joint| joint.to_string()).collect());
        Err(match found {
            Margin::Negative => Refusal::TooLong { member, from, to, length_m, rest_m, way },
            _ => Refusal::Folded { member, from, to, length_m, way },
        })
    }

    /// The chain.
    pub fn chain(&self) -> &Chain {
        &self.0
    }

    /// Give the chain back.
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
