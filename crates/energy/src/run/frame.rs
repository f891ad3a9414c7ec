//! The frame in which the minimiser works.

use model::{Chain, Vector};

use crate::run::regime::Reach;
use crate::twofold::Twofold;
use crate::vector::{cross, dot, scaled, unit};

/// World up; gravity acts along its negative.
pub(crate) const WORLD_UP: Vector = [0.0, 0.0, 1.0];

/// An orthonormal frame whose second axis is normal to the vertical plane of the anchors.
///
/// Where all bars are nearly parallel, squares of small angles decide, and they keep their digits
/// only if the common line is an axis: the span of a chain that is nearly taut or nearly folded,
/// the vertical of a chain whose two strands hang side by side. In between any axes will do.
///
/// For anchors on one vertical the plane is *OYZ*, the paper's choice.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    /// The axes, in world coordinates; right-handed.
    axis: [Vector; 3],
    /// Whether the first axis is the line of the anchors.
    drawn_out: bool,
}

impl Frame {
    /// The frame of a chain; its first axis lies along the span if the reach asks for it.
    pub(crate) fn new(chain: &Chain, reach: Reach) -> Self {
        let horizontal = Self::horizontal(chain);
        let normal = cross(WORLD_UP, horizontal);
        match unit(chain.anchors().difference_m()) {
            Some(first) if reach == Reach::DrawnOut => {
                Self { axis: [first, normal, cross(first, normal)], drawn_out: true }
            }
            _ => Self { axis: [horizontal, normal, WORLD_UP], drawn_out: false },
        }
    }

    /// Horizontal unit vector in the vertical plane of the anchors, towards the end anchor; *Y*
    /// when the anchors lie on one vertical.
    pub(crate) fn horizontal(chain: &Chain) -> Vector {
        if chain.anchors_on_one_vertical() {
            return [0.0, 1.0, 0.0];
        }
        let difference_m = chain.anchors().difference_m();
        // Scaled first: squares of metres may leave the range of a double.
        let scale = 1.0 / chain.total_length_m();
        let flat = scaled(scale, [difference_m[0], difference_m[1], 0.0]);
        unit(flat).unwrap_or([0.0, 1.0, 0.0])
    }

    /// The way between the anchors in the frame, as a sum to twice the digits; it has no part along
    /// the second axis, by the choice of the frame.
    pub(crate) fn span(&self, difference: Vector) -> [Vector; 2] {
        if self.drawn_out {
            let [x, y, z] = difference.map(Twofold::from);
            let parts = (x * x + y * y + z * z).sqrt().parts();
            return parts.map(|length| [length, 0.0, 0.0]);
        }
        let [across, _, up] = self.into_frame(difference);
        [[across, 0.0, up], [0.0; 3]]
    }

    /// The frame with these axes, given in this one.
    pub(crate) fn turned(&self, axes: [Vector; 3]) -> Self {
        Self { axis: axes.map(|axis| self.into_world(axis)), ..*self }
    }

    pub(crate) fn into_frame(self, v: Vector) -> Vector {
        self.axis.map(|axis| dot(axis, v))
    }

    pub(crate) fn into_world(self, v: Vector) -> Vector {
        std::array::from_fn(|k| {
            self.axis[0][k] * v[0] + self.axis[1][k] * v[1] + self.axis[2][k] * v[2]
        })
    }
}

#[cfg(test)]
mod tests {
    use model::{Anchors, Bar};

    use super::*;

    /// Three bars of 1 m that are drawn out along the span.
    fn frame(end_m: Vector) -> Frame {
        let anchors = Anchors { start_m: [0.0; 3], end_m };
        let bars = vec![Bar::homogeneous(1.0, 1.0).unwrap(); 3];
        Frame::new(&Chain::new("frame", 9.81, anchors, bars).unwrap(), Reach::DrawnOut)
    }

    #[test]
    fn frames_are_orthonormal_and_turn_back() {
        for end_m in [[0.0, 0.0, -2.0], [1.0, -2.0, 0.5], [1e-3, 0.0, 0.0], [0.0; 3]] {
            let frame = frame(end_m);
            for i in 0..3 {
                for k in 0..3 {
                    let expected = if i == k { 1.0 } else { 0.0 };
                    assert!((dot(frame.axis[i], frame.axis[k]) - expected).abs() < 1e-15);
                }
            }
            let v = [0.3, -0.4, 1.2];
            let back = frame.into_world(frame.into_frame(v));
            assert!((0..3).all(|k| (back[k] - v[k]).abs() < 1e-15));
            // Up and the span have no part along the normal.
            assert!(frame.into_frame(WORLD_UP)[1].abs() < 1e-16);
            assert!(frame.into_frame(end_m)[1].abs() < 1e-16);
        }
    }

    #[test]
    fn the_papers_example_moves_in_oyz_and_nothing_is_rounded() {
        let frame = frame([0.0, 0.0, -2.0]);
        let bits = |v: Vector| v.map(|x| x.abs().to_bits());
        assert_eq!(bits(frame.into_frame([0.0, 0.0, -2.0])), bits([2.0, 0.0, 0.0]));
        assert_eq!(frame.into_frame([5.0, 0.0, 0.0])[1].abs().to_bits(), 5.0_f64.to_bits());
    }

    /// The root of two to 32 digits: 1.414213562373095048801688724209698 (OEIS A002193).
    #[test]
    fn the_way_between_the_anchors_is_known_to_twice_the_digits() {
        for scale in [1.0, 4.0, 0.25] {
            let drawn_out = Frame { axis: [[1.0, 0.0, 0.0]; 3], drawn_out: true };
            let [first, rest] = drawn_out.span([scale, 0.0, -scale]);
            assert_eq!(first[0].to_bits(), (scale * std::f64::consts::SQRT_2).to_bits());
            assert!((rest[0] / scale + 9.667_293_313_452_913e-17).abs() < 1e-31);
            assert!([first[1], first[2], rest[1], rest[2]].iter().all(|x| x.abs() <= 0.0));
        }
    }

    #[test]
    fn a_frame_is_turned_by_axes_given_in_it() {
        let frame = frame([1.0, -2.0, 0.5]);
        let axes = [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]];
        let turned = frame.turned(axes);
        let v = [0.3, -0.4, 1.2];
        let inside = frame.into_frame(v);
        let expected = axes.map(|axis| dot(axis, inside));
        let found = turned.into_frame(v);
        assert!((0..3).all(|k| (found[k] - expected[k]).abs() < 1e-15), "{found:?}");
    }
}
