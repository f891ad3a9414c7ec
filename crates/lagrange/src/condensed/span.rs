//! The vertical plane of the anchors.

use model::Anchors;

use super::sums::DoubleDouble;

/// The way from anchor to anchor, in the plane, in units of the chain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// Horizontal unit vector of the plane, from the start towards the end anchor.
    pub level: [f64; 2],
    /// Horizontal distance of the anchors.
    pub across: f64,
    /// Height of the end anchor above the start.
    pub rise: f64,
    /// Distance of the anchors.
    pub distance: f64,
    /// The way in the world's axes, to twice the digits.
    pub steps: [DoubleDouble; 3],
    /// Its square, to twice the digits.
    pub distance_squared: DoubleDouble,
}

impl Span {
    /// With lengths multiplied by `scale`, a power of two.
    pub fn new(anchors: &Anchors, scale: f64) -> Self {
        let difference: [DoubleDouble; 3] = std::array::from_fn(|k| {
            DoubleDouble::sum(anchors.end_m[k] * scale, -anchors.start_m[k] * scale)
        });
        let [x, y, rise] = difference.map(DoubleDouble::value);
        let across = x.hypot(y);
        // On one vertical any plane will do: the paper's, OYZ, and of its two mirror images the one of the paper's
        // Fig. 3, whose stretched bars lean towards +Y. (A compressed bar has them lean against this direction.)
        let level = if across > 0.0 { [x / across, y / across] } else { [0.0, -1.0] };
        Self {
            level,
            across,
            rise,
            distance: across.hypot(rise),
            steps: difference,
            distance_squared: difference
                .into_iter()
                .fold(DoubleDouble::default(), |sum, part| sum.add(part.square())),
        }
    }

    /// Unit vector from the start towards the end anchor, horizontal and vertical; they must be
    /// apart.
    pub fn direction(&self) -> [f64; 2] {
        [self.across / self.distance, self.rise / self.distance]
    }
}
