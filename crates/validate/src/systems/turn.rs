//! Turns about verticals: parts of a system that turn freely are turned onto each other before
//! their places are compared.

use model::Vector;
use model::system::Part;

/// A turn about a vertical.
#[derive(Clone, Copy)]
pub(crate) struct Turn {
    axis_m: [f64; 2],
    cos: f64,
    sin: f64,
}

/// For every joint the turn of its part that brings the second places closest to the first.
pub(crate) fn turns(
    parts: &[Part],
    first_m: &[Vector],
    second_m: &[Vector],
    joints: usize,
) -> Vec<Turn> {
    let mut turns = vec![Turn::NONE; joints];
    for part in parts {
        let Some([x, y]) = part.axis_m else { continue };
        let (mut along, mut across) = (0.0, 0.0);
        for joint in &part.joints {
            let (Some(a), Some(b)) = (first_m.get(*joint), second_m.get(*joint)) else {
                continue;
            };
            let (ax, ay, bx, by) = (a[0] - x, a[1] - y, b[0] - x, b[1] - y);
            along += ax * bx + ay * by;
            across += bx * ay - by * ax;
        }
        let (sin, cos) = f64::atan2(across, along).sin_cos();
        for joint in &part.joints {
            turns[*joint] = Turn { axis_m: [x, y], cos, sin };
        }
    }
    turns
}

impl Turn {
    const NONE: Self = Self { axis_m: [0.0; 2], cos: 1.0, sin: 0.0 };

    pub(crate) fn vector(&self, [x, y, z]: Vector) -> Vector {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y, z]
    }

    pub(crate) fn place(&self, [x, y, z]: Vector) -> Vector {
        let [ox, oy] = self.axis_m;
        let [x, y, z] = self.vector([x - ox, y - oy, z]);
        [x + ox, y + oy, z]
    }
}
