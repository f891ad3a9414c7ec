//! Where the pull can be: the half-space of all pulls, infinite ones included, as five squares.
//!
//! The pull is p = (H, V)/w with w ≥ 0, and `F_i` is parallel to (H, V + c_i w). Only the direction of
//! (H, V, w) matters, so the faces of half a cube hold every pull: the face w = 1 those of the order of
//! the weights, the faces H = ±1 and V = ±1 the large ones, and their edge w = 0 the infinite ones.
//! No bound on the zeros is needed: they cannot leave the cube.

use crate::Interval;
use crate::system::System;

/// A face of the half cube; the named coordinate is the constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Face {
    /// w = 1, coordinates (H, V).
    Near,
    /// H = −1, coordinates (V, w).
    Left,
    /// H = 1, coordinates (V, w).
    Right,
    /// V = −1, coordinates (H, w).
    Below,
    /// V = 1, coordinates (H, w).
    Above,
}

const MINUS_ONE: Interval = Interval::ONE.negated();

/// A rectangle on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    pub(crate) face: Face,
    pub(crate) at: [Interval; 2],
}

impl Cell {
    /// The rectangles that hold every pull, each once: whole faces. With vertical anchors the
    /// mirror image of an equilibrium has the opposite H, so H ≥ 0 is enough.
    pub(crate) fn roots(system: &System) -> Vec<Self> {
        let (full, half) = (Interval::new(-1.0, 1.0), Interval::new(0.0, 1.0));
        let horizontal = if system.vertical { half } else { full };
        let mut roots = vec![
            Self { face: Face::Near, at: [horizontal, full] },
            Self { face: Face::Right, at: [full, half] },
            Self { face: Face::Below, at: [horizontal, half] },
            Self { face: Face::Above, at: [horizontal, half] },
        ];
        if !system.vertical {
            roots.push(Self { face: Face::Left, at: [full, half] });
        }
        roots
    }

    /// (H, V, w).
    pub(crate) fn homogeneous(&self) -> [Interval; 3] {
        let [x, y] = self.at;
        match self.face {
            Face::Near => [x, y, Interval::ONE],
            Face::Left => [MINUS_ONE, x, y],
            Face::Right => [Interval::ONE, x, y],
            Face::Below => [x, MINUS_ONE, y],
            Face::Above => [x, Interval::ONE, y],
        }
    }

    /// `(H, V + c w)` of a bar. A rectangle exactly, because no two of the varying coordinates
    /// meet in one component and vary in the other.
    pub(crate) fn force(&self, weight: Interval) -> [Interval; 2] {
        let [h, v, w] = self.homogeneous();
        [h, if self.face == Face::Near { v + weight } else { v + weight * w }]
    }

    /// The pull (H, V)/w in the plane, in the system's units, weights centred.
    pub(crate) fn pull(&self) -> [Interval; 2] {
        let [h, v, w] = self.homogeneous();
        if self.face == Face::Near { [h, v] } else { [h / w, v / w] }
    }

    /// The same set of pulls, or a little more, as a rectangle on the face through its middle.
    pub(crate) fn of_pull(pull: [Interval; 2]) -> Self {
        let [h, v] = pull;
        let (x, y) = (h.mid(), v.mid());
        if x.abs() <= 1.0 && y.abs() <= 1.0 {
            Self { face: Face::Near, at: [h, v] }
        } else if x.abs() >= y.abs() {
            let face = if x < 0.0 { Face::Left } else { Face::Right };
            Self { face, at: [v / h.abs(), Interval::ONE / h.abs()] }
        } else {
            let face = if y < 0.0 { Face::Below } else { Face::Above };
            Self { face, at: [h / v.abs(), Interval::ONE / v.abs()] }
        }
    }

    /// The same pulls, or a few more, as a rectangle on another face; `None` if the pulls cannot
    /// all be written on it.
    pub(crate) fn on(&self, face: Face) -> Option<Self> {
        if self.face == face {
            return Some(*self);
        }
        let [h, v, w] = self.homogeneous();
        let [x, y] = match face {
            Face::Near => [h, v],
            Face::Left | Face::Right => [v, w],
            Face::Below | Face::Above => [h, w],
        };
        let divisor = self.towards(face);
        (divisor.lo() > 0.0).then(|| Self { face, at: [x / divisor, y / divisor] })
    }

    /// Whether none of these pulls can be written on a face.
    pub(crate) fn behind(&self, face: Face) -> bool {
        self.towards(face).hi() <= 0.0
    }

    /// The coordinate that is constant on a face, with the sign of the face.
    fn towards(&self, face: Face) -> Interval {
        let [h, v, w] = self.homogeneous();
        match face {
            Face::Near => w,
            Face::Left => -h,
            Face::Right => h,
            Face::Below => -v,
            Face::Above => v,
        }
    }

    /// The mirror image: H changes its sign.
    pub(crate) fn mirrored(&self) -> Self {
        let [x, y] = self.at;
        match self.face {
            Face::Left => Self { face: Face::Right, ..*self },
            Face::Right => Self { face: Face::Left, ..*self },
            Face::Near | Face::Below | Face::Above => Self { at: [-x, y], ..*self },
        }
    }

    /// Middle.
    pub(crate) fn middle(&self) -> [f64; 2] {
        self.at.map(Interval::mid)
    }

    /// Half widths.
    pub(crate) fn half(&self) -> [f64; 2] {
        self.at.map(Interval::rad)
    }

    /// The point at these coordinates of the face.
    pub(crate) fn point(face: Face, at: [f64; 2]) -> Self {
        Self { face, at: at.map(Interval::point) }
    }

    /// Cut in two halves across one coordinate.
    pub(crate) fn cut(&self, across: usize) -> [Self; 2] {
        let whole = self.at[across];
        let middle = whole.mid();
        let (mut first, mut second) = (*self, *self);
        first.at[across] = Interval::new(whole.lo(), middle);
        second.at[across] = Interval::new(middle, whole.hi());
        [first, second]
    }

    /// Whether both cells share no pull; they must be on the same face.
    pub(crate) fn misses(&self, other: &Self) -> bool {
        self.at[0].misses(other.at[0]) || self.at[1].misses(other.at[1])
    }

    /// Whether all of `other`, on the same face, is in this cell.
    pub(crate) fn encloses(&self, other: &Self) -> bool {
        self.face == other.face
            && self.at[0].encloses(other.at[0])
            && self.at[1].encloses(other.at[1])
    }
}
