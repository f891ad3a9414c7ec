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

#[cfg(test)]
mod tests {
    use super::*;

    /// A bar along (-3/5, -4/5) between anchors (3, -1) apart: its force is along (3/5, 4/5), on which they are 1
    /// apart, of which the other bars reach 2; across it they are -3 apart.
    #[test]
    fn frames_stand_along_the_force_of_a_bar() {
        let folded =
            Folded { slack: 0.0, excess: DoubleDouble::sum(2.0, 0.0), across: 3.0, rise: -1.0 };
        let Frame::Aligned { up, slack, aside, .. } = folded.frame([-0.6, -0.8]) else { panic!() };
        for (found, wanted) in [(up[0], 0.8), (up[1], 0.6), (slack, 1.0), (aside, -3.0)] {
            assert!((found - wanted).abs() < 1e-15, "{found}, not {wanted}");
        }
    }
}
