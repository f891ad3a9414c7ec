//! A nearly folded chain: all bars but the compressed one come back as far as it reaches.

use super::chain::Condensed;
use super::sums::DoubleDouble;
use super::system::Frame;
use crate::thresholds::NEARLY_STRAIGHT;

/// How far a nearly folded chain is from its fold. Its anchors may be too near to each other to say
/// along which line it folds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Folded {
    /// By how much the bottom bar is shorter than the span and all other bars.
    pub slack: f64,
    /// Length of all other bars minus that of the bottom bar.
    excess: DoubleDouble,
    across: f64,
    rise: f64,
}

impl Folded {
    /// `None` when the chain is not nearly folded.
    pub fn of(chain: &Condensed) -> Option<Self> {
        let (span, bottom) = (&chain.span, &chain.bottom);
        let total = chain.bars.total_length;
        let roughly = total - bottom.length - bottom.shortest_reach + span.distance;
        (roughly < NEARLY_STRAIGHT * total).then(|| {
            let excess = chain.length_in_tension(true).plus(-bottom.shortest_reach);
            let slack = excess.plus(span.distance).value();
            Self { slack, excess, across: span.across, rise: span.rise }
        })
    }

    /// The closure along the force of a bar that points in `direction`.
    pub fn frame(&self, direction: [f64; 2]) -> Frame {
        let [h, z] = direction.map(|x| -x);
        Frame::Aligned {
            up: [z, h],
            slack: self.excess.plus(-(h * self.across + z * self.rise)).value(),
            aside: h * self.rise - z * self.across,
            sides: [1.0; 2],
            strut_side: 1.0,
        }
    }
}
