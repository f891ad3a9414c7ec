//! Axes to which nearly straight strands are parallel.

use super::chain::Condensed;
use super::sums::Twofold;
use super::system::Frame;

/// Slack, in parts of the total length, below which the closure is balanced along an axis: upright
/// axes would lose more than three of sixteen digits of it.
const NEARLY_STRAIGHT: f64 = 1e-3;

/// Tilt of a bottom bar below which it counts as one of two strands that hang side by side.
const STEEP: f64 = 0.05;

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
    /// The line of the anchors for a chain that is nearly taut along it.
    pub fn taut(chain: &Condensed, compressed: bool) -> Option<Self> {
        let bottom = &chain.bottom;
        let (push, reach) = if compressed {
            let push = bottom.shortest_reach;
            (push, chain.read.total_length - bottom.length + push)
        } else {
            (0.0, chain.read.total_length)
        };
        let nearly = reach - chain.span.distance < NEARLY_STRAIGHT * chain.read.total_length;
        nearly.then(|| Self::through_the_anchors(chain, push, 1.0))
    }

    /// The vertical, for two strands that hang side by side and hold each other at the bottom, all bars in
    /// tension; and the first bar of the strand that goes up. The bottom bars, steep too, belong to either.
    pub fn double(chain: &Condensed) -> Option<(Self, usize)> {
        let (span, bottom) = (&chain.span, &chain.bottom);
        let nearly = span.across < NEARLY_STRAIGHT * chain.read.total_length
            && span.across < STEEP * bottom.length
            && bottom.over.abs() < NEARLY_STRAIGHT * bottom.length;
        nearly.then(|| {
            let split = if bottom.gap > 0.0 { bottom.group.start } else { bottom.group.end };
            let (before, after) = chain.read.lengths.split_at(split);
            let [before, after] =
                [before, after].map(|lengths| Twofold::total(lengths.iter().copied()));
            let slack = after.add(before.negate()).plus(-span.rise).value();
            let frame = Frame::Aligned {
                up: [1.0, 0.0],
                slack,
                aside: -span.across,
                sides: [-1.0, 1.0],
                push_side: 1.0,
            };
            let tilt = span.across / chain.read.total_length;
            (Self { direction: [0.0, 1.0], side: 1.0, frame, slack: slack.abs(), tilt }, split)
        })
    }

    /// The line of the anchors for a chain that is nearly folded along it, its compressed bar reaching
    /// as far as the span and all others together.
    pub fn folded(chain: &Condensed) -> Option<Self> {
        let nearly = Fold::of(chain).is_some_and(|fold| fold.slack < chain.span.distance);
        // The forces point against the bar.
        nearly.then(|| Self::through_the_anchors(chain, chain.bottom.shortest_reach, -1.0))
    }

    /// The vertical, with the bars before the bottom hanging down and those after it up, when the
    /// anchors lie on one vertical.
    pub fn hanging(chain: &Condensed) -> Option<Self> {
        if !chain.on_one_vertical() {
            return None;
        }
        let bottom = &chain.bottom;
        let up = bottom.gap > 0.0;
        let (side, push) =
            if up { (1.0, bottom.shortest_reach) } else { (-1.0, -bottom.shortest_reach) };
        let [before, after] = chain.strands();
        let gap = before.negate().add(after).plus(push).plus(-chain.span.rise);
        let frame = Frame::Aligned {
            up: [1.0, 0.0],
            slack: gap.value(),
            aside: -chain.span.across,
            sides: [-1.0, 1.0],
            push_side: -side,
        };
        // The bar fills the gap between straight strands at this angle.
        let slack = gap.value().abs();
        let tilt = 2.0 * (slack / (2.0 * bottom.shortest_reach)).sqrt().min(1.0).asin();
        Some(Self { direction: [0.0, 1.0], side, frame, slack, tilt })
    }

    /// Along the line of the anchors (`side` +1) or against it (-1). What the bars reach along the axis,
    /// r, and the anchors' distance d along it are nearly equal: r - d is (r² - d²)/(r + d), with the
    /// squares to twice the digits.
    fn through_the_anchors(chain: &Condensed, push: f64, side: f64) -> Self {
        let span = &chain.span;
        let reach = chain.stretched(push > 0.0).plus(side * push);
        let squares = reach.square().add(span.distance_squared.negate());
        let slack = squares.value() / (reach.value() + side * span.distance);
        let direction = span.direction().map(|x| side * x);
        let up = [direction[1], direction[0]];
        let frame = Frame::Aligned { up, slack, aside: 0.0, sides: [1.0; 2], push_side: -side };
        // The angle of all bars if all bent alike.
        let tilt = (2.0 * slack.max(0.0) / chain.read.total_length).sqrt();
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
        enter(self.direction, force)
    }

    /// Back to horizontal and vertical components.
    pub fn leave(&self, force: [f64; 2]) -> [f64; 2] {
        leave(self.direction, force)
    }
}

fn enter([x, y]: [f64; 2], [h, z]: [f64; 2]) -> [f64; 2] {
    [h * x + z * y, z * x - h * y]
}

fn leave([x, y]: [f64; 2], [p, q]: [f64; 2]) -> [f64; 2] {
    [p * x - q * y, p * y + q * x]
}

/// A nearly folded chain whose anchors may be too near to each other to say along which line: all bars
/// but the compressed one come back as far as it reaches, in whatever direction that is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fold {
    /// By how much the bottom bar is shorter than the span and all other bars.
    slack: f64,
    /// Length of all other bars minus that of the bottom bar.
    excess: Twofold,
    across: f64,
    rise: f64,
}

impl Fold {
    pub fn of(chain: &Condensed) -> Option<Self> {
        let (span, bottom) = (&chain.span, &chain.bottom);
        let roughly =
            chain.read.total_length - bottom.length - bottom.shortest_reach + span.distance;
        (roughly < NEARLY_STRAIGHT * chain.read.total_length).then(|| {
            let excess = chain.stretched(true).plus(-bottom.shortest_reach);
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
            push_side: 1.0,
        }
    }
}

impl Condensed {
    /// Length of all bars in tension, to twice the digits.
    fn stretched(&self, compressed: bool) -> Twofold {
        if compressed {
            let [before, after] = self.strands();
            before.add(after)
        } else {
            Twofold::total(self.read.lengths.iter().copied())
        }
    }

    /// Lengths of the bars before and after the bottom, to twice the digits.
    fn strands(&self) -> [Twofold; 2] {
        let group = &self.bottom.group;
        [&self.read.lengths[..group.start], &self.read.lengths[group.end..]]
            .map(|lengths| Twofold::total(lengths.iter().copied()))
    }
}
