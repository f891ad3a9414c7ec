//! Axes along which nearly straight strands lie.

use super::chain::Condensed;
use super::sums::DoubleDouble;
use super::system::Frame;

/// A direction in the plane along which nearly all forces point, and the closure written along it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    /// Horizontal and vertical component of the unit vector.
    direction: [f64; 2],
    /// Whether a compressed bar points along the axis (+1) or against it (-1).
    pub side: f64,
    /// The closure in these axes.
    pub frame: Frame,
    /// What the bars are longer than the way they have to go.
    pub slack: f64,
    /// A guess of the angle between the axis and a compressed bar.
    pub tilt: f64,
}

impl Axis {
    /// The vertical, for two strands that hang side by side, all bars in tension; and the first bar
    /// of the strand that goes up. The bottom bars, steep too, belong to either.
    pub fn down_and_up(chain: &Condensed) -> (Self, usize) {
        let (span, bottom) = (&chain.span, &chain.bottom);
        let split = if bottom.gap > 0.0 { bottom.group.start } else { bottom.group.end };
        let (before, after) = chain.bars.lengths.split_at(split);
        let [before, after] =
            [before, after].map(|lengths| DoubleDouble::total(lengths.iter().copied()));
        let slack = after.add(before.negate()).plus(-span.rise).value();
        let frame = Frame::Aligned {
            up: [1.0, 0.0],
            slack,
            aside: -span.across,
            sides: [-1.0, 1.0],
            strut_side: 1.0,
        };
        let tilt = span.across / chain.bars.total_length;
        (Self { direction: [0.0, 1.0], side: 1.0, frame, slack: slack.abs(), tilt }, split)
    }

    /// The vertical, with the bars before the bottom hanging down and those after it up, and a
    /// compressed bar between them.
    pub fn of_vertical_strands(chain: &Condensed) -> Self {
        let bottom = &chain.bottom;
        let up = bottom.gap > 0.0;
        let (side, strut) =
            if up { (1.0, bottom.shortest_reach) } else { (-1.0, -bottom.shortest_reach) };
        let [before, after] = chain.strands();
        let gap = before.negate().add(after).plus(strut).plus(-chain.span.rise);
        let frame = Frame::Aligned {
            up: [1.0, 0.0],
            slack: gap.value(),
            aside: -chain.span.across,
            sides: [-1.0, 1.0],
            strut_side: -side,
        };
        // The bar fills the gap between straight strands at this angle.
        let slack = gap.value().abs();
        let tilt = 2.0 * (slack / (2.0 * bottom.shortest_reach)).sqrt().min(1.0).asin();
        Self { direction: [0.0, 1.0], side, frame, slack, tilt }
    }

    /// Along the line of the anchors (`side` +1) or against it (-1), for a chain whose bar in
    /// compression, if there is one, has the length `strut`. What the bars reach along the axis, r,
    /// and the anchors' distance d along it are nearly equal: r - d is (r² - d²)/(r + d), with the
    /// squares to twice the digits.
    pub fn through_the_anchors(chain: &Condensed, strut: f64, side: f64) -> Self {
        let span = &chain.span;
        let reach = chain.length_in_tension(strut > 0.0).plus(side * strut);
        let squares = reach.square().add(span.distance_squared.negate());
        let slack = squares.value() / (reach.value() + side * span.distance);
        let direction = span.direction().map(|x| side * x);
        let up = [direction[1], direction[0]];
        let frame = Frame::Aligned { up, slack, aside: 0.0, sides: [1.0; 2], strut_side: -side };
        // The angle of all bars if all bent alike.
        let tilt = (2.0 * slack.max(0.0) / chain.bars.total_length).sqrt();
        Self { direction, side, frame, slack, tilt }
    }

    /// Where a compressed bar points, in upright axes.
    pub fn bar(&self) -> [f64; 2] {
        // A negative zero would turn a bar between vertical anchors around.
        let [h, z] = self.direction;
        [h.abs(), self.side * z]
    }

    /// From horizontal and vertical components to those along and across the axis.
    pub fn enter(&self, force: [f64; 2]) -> [f64; 2] {
        let ([x, y], [h, z]) = (self.direction, force);
        [h * x + z * y, z * x - h * y]
    }

    /// Back to horizontal and vertical components.
    pub fn leave(&self, force: [f64; 2]) -> [f64; 2] {
        let ([x, y], [p, q]) = (self.direction, force);
        [p * x - q * y, p * y + q * x]
    }
}

impl Condensed {
    /// Length of all bars in tension, to twice the digits.
    pub(super) fn length_in_tension(&self, compressed: bool) -> DoubleDouble {
        if compressed {
            let [before, after] = self.strands();
            before.add(after)
        } else {
            DoubleDouble::total(self.bars.lengths.iter().copied())
        }
    }

    /// Lengths of the bars before and after the bottom, to twice the digits.
    fn strands(&self) -> [DoubleDouble; 2] {
        let group = &self.bottom.group;
        [&self.bars.lengths[..group.start], &self.bars.lengths[group.end..]]
            .map(|lengths| DoubleDouble::total(lengths.iter().copied()))
    }
}
