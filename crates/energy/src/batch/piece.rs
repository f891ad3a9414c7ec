//! The chain without dimensions, and the start of a seed.

use std::f64::consts::{FRAC_PI_2, TAU};

use model::Problem;

use crate::lever;

/// A bar, in units of the total length and the total weight.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Piece {
    pub(crate) length: f64,
    /// The weight that rises with its last joint: of all bars after it, and its own by the lever
    /// rule.
    pub(crate) lifted: f64,
}

/// All pieces, the vector they bridge, and the units.
#[derive(Debug, Clone)]
pub(crate) struct Pieces {
    pub(crate) list: Vec<Piece>,
    /// Horizontal distance and rise of the anchors.
    pub(crate) span: [f64; 2],
    pub(crate) unit_j: f64,
}

impl Pieces {
    pub(crate) fn of(problem: &Problem) -> Self {
        let chain = problem.chain();
        let (length_m, mass_kg) = (chain.total_length_m(), chain.total_mass_kg());
        let mut after = 0.0;
        let mut list: Vec<Piece> = chain
            .bars()
            .iter()
            .rev()
            .map(|bar| {
                let own = bar.mass_kg() / mass_kg;
                let lifted = after + own * lever::at_last(bar);
                after += own;
                Piece { length: bar.length_m() / length_m, lifted }
            })
            .collect();
        list.reverse();
        let [x, y, z] = chain.anchors().difference_m();
        let span = [(x / length_m).hypot(y / length_m), z / length_m];
        Self { list, span, unit_j: mass_kg * chain.gravity_m_s2() * length_m }
    }
}

/// The direction (horizontal, up) of a bar at an angle from the descending vertical: a quarter of
/// the angle by Taylor's polynomials, squared twice as a complex number.
pub(crate) fn direction(angle_rad: f64) -> [f64; 2] {
    let turns = angle_rad / TAU;
    let quarter = (turns - turns.round()) * FRAC_PI_2;
    let square = quarter * quarter;
    // 1/(2k)! and 1/(2k+1)!, up to the first that is below a rounding at pi/4.
    let (mut cos, mut sin) = (1.0, 1.0);
    for k in (1..=9).rev() {
        let even = f64::from(2 * k);
        cos = 1.0 - square / (even * (even - 1.0)) * cos;
        sin = 1.0 - square / (even * (even + 1.0)) * sin;
    }
    let mut z = [cos, sin * quarter];
    for _ in 0..2 {
        z = [(z[0] - z[1]) * (z[0] + z[1]), 2.0 * z[0] * z[1]];
    }
    let size = (z[0] * z[0] + z[1] * z[1]).sqrt();
    [z[1] / size, -z[0] / size]
}
