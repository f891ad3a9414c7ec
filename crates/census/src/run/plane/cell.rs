//! Where the pull can be: the half-space of all pulls, infinite ones included, as five squares.
//!
//! The pull of bar 1 on joint 0 is p = (H, V)/w with w ≥ 0, and `F_i` is parallel to (H, V + c_i
//! w). Only the direction of (H, V, w) matters, so the faces of half a cube hold every pull: the
//! face w = 1 those of the order of the weights, the faces H = ±1 and V = ±1 the large ones, and
//! their edge w = 0 the infinite ones. No bound on the zeros is needed: they cannot leave the cube.
//!
//! V is counted from an origin that centres the weights. Around the pull at which the force of a
//! bar vanishes its direction turns with the small difference of two numbers of order one, and
//! rounding would hide a zero close by; so cells near it move to a chart whose origin is that very
//! point.

use numerics::Interval;

use crate::branch_and_bound::halves;
use crate::run::plane::face::Face;
use crate::run::plane::system::System;

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
    pub(crate) fn roots(vertical: bool) -> Vec<Self> {
        let (full, half) = (Interval::new(-1.0, 1.0), Interval::new(0.0, 1.0));
        let horizontal = if vertical { half } else { full };
        let mut roots = vec![
            Self { face: Face::Near, at: [horizontal, full] },
            Self { face: Face::Right, at: [full, half] },
            Self { face: Face::Below, at: [horizontal, half] },
            Self { face: Face::Above, at: [horizontal, half] },
        ];
        if !vertical {
            roots.push(Self { face: Face::Left, at: [full, half] });
        }
        roots
    }

    /// (H, V, w).
    pub(crate) fn homogeneous(&self) -> [Interval; 3] {
        let [x, y] = self.at;
        match self.face {
            Face::Near | Face::Around(_) => [x, y, Interval::ONE],
            Face::Left => [MINUS_ONE, x, y],
            Face::Right => [Interval::ONE, x, y],
            Face::Below => [x, MINUS_ONE, y],
            Face::Above => [x, Interval::ONE, y],
        }
    }

    /// `(H, V + c w)` of a bar, its weight c counted from the origin of the chart. A rectangle
    /// exactly, because no two of the varying coordinates meet in one component and vary in the
    /// other.
    pub(crate) fn force(&self, weight: Interval) -> [Interval; 2] {
        let [h, v, w] = self.homogeneous();
        [
            h,
            if weight == Interval::ZERO {
                v
            } else {
                v + if self.flat() { weight } else { weight * w }
            },
        ]
    }

    /// Whether w = 1 on this face.
    fn flat(&self) -> bool {
        matches!(self.face, Face::Near | Face::Around(_))
    }

    /// The pull of bar 1 on joint 0 in the plane, in the system's units.
    pub(crate) fn pull(&self, system: &System) -> [Interval; 2] {
        let [h, v, w] = self.homogeneous();
        let origin = system.origin(self.face);
        if self.flat() { [h, v - origin] } else { [h / w, v / w - origin] }
    }

    /// The same pulls, or a few more, as a rectangle on another face; `None` if the pulls cannot
    /// all be written on it.
    pub(crate) fn on(&self, face: Face, system: &System) -> Option<Self> {
        if self.face == face {
            return Some(*self);
        }
        let [h, v, w] = self.seen_from(face, system);
        let [x, y] = match face {
            Face::Near | Face::Around(_) => [h, v],
            Face::Left | Face::Right => [v, w],
            Face::Below | Face::Above => [h, w],
        };
        let divisor = towards(face, [h, v, w]);
        if divisor == Interval::ONE {
            return Some(Self { face, at: [x, y] });
        }
        (divisor.lo() > 0.0).then(|| Self { face, at: [x / divisor, y / divisor] })
    }

    /// The same cell in the chart of the nearest pull without force, if it is that near.
    pub(crate) fn recentred(&self, system: &System) -> Self {
        /// So near that five bits of precision would be lost.
        const NEAR: f64 = f64::from_bits((1023 - 5) << 52);
        if !self.flat() {
            return *self;
        }
        let weights = system.weights(self.face);
        let distance = |group: usize| {
            let force = self.force(weights[system.groups[group].start]);
            force[0].mag().max(force[1].mag())
        };
        let here = match self.face {
            Face::Around(group) => NEAR * distance(usize::from(group)),
            _ => NEAR,
        };
        (0..system.groups.len())
            .filter(|group| distance(*group) < here)
            .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
            .and_then(|group| self.on(Face::Around(u8::try_from(group).ok()?), system))
            .unwrap_or(*self)
    }

    /// (H, V, w), V counted from the origin of another face.
    fn seen_from(&self, face: Face, system: &System) -> [Interval; 3] {
        let [h, v, w] = self.homogeneous();
        let v = match (self.face, face) {
            (Face::Around(from), Face::Around(to)) => v + system.group_distance(from, to),
            (Face::Around(from), _) => v - system.group_weight(from),
            (_, Face::Around(to)) => v + system.group_weight(to) * w,
            _ => v,
        };
        [h, v, w]
    }

    /// Whether none of these pulls can be written on a face.
    pub(crate) fn behind(&self, face: Face, system: &System) -> bool {
        towards(face, self.seen_from(face, system)).hi() <= 0.0
    }

    /// The mirror image: H changes its sign.
    pub(crate) fn mirrored(&self) -> Self {
        let [x, y] = self.at;
        match self.face {
            Face::Left => Self { face: Face::Right, ..*self },
            Face::Right => Self { face: Face::Left, ..*self },
            Face::Near | Face::Around(_) | Face::Below | Face::Above => {
                Self { at: [-x, y], ..*self }
            }
        }
    }

    /// Whether it holds the pull at which the force of the bars of its chart vanishes.
    pub(crate) fn is_at_unloaded_bar(&self) -> bool {
        matches!(self.face, Face::Around(_)) && self.at.iter().all(|part| part.contains(0.0))
    }

    /// Whether it is so near the pull at which the force of a group vanishes that not even the data
    /// are known.
    pub(crate) fn is_lost_around(&self, group: usize) -> bool {
        matches!(self.face, Face::Around(own) if usize::from(own) == group)
            && self.at[0].mag().max(self.at[1].mag()) < f64::EPSILON
    }

    /// The size against which a width is small: around a pull without force the distance from it,
    /// and so near that not even the data are known any width at all.
    pub(crate) fn unit(&self) -> f64 {
        let size = self.at[0].mag().max(self.at[1].mag());
        match self.face {
            Face::Around(_) if size < f64::EPSILON => f64::INFINITY,
            Face::Around(_) => size,
            _ => 1.0,
        }
    }

    /// The size against which a point of a face is known to the last place.
    pub(crate) fn size(face: Face, at: [f64; 2]) -> f64 {
        match face {
            Face::Around(_) => at[0].abs().max(at[1].abs()),
            _ => 1.0,
        }
    }

    pub(crate) fn middle(&self) -> [f64; 2] {
        self.at.map(Interval::mid)
    }

    pub(crate) fn half(&self) -> [f64; 2] {
        self.at.map(Interval::rad)
    }

    pub(crate) fn point(face: Face, at: [f64; 2]) -> Self {
        Self { face, at: at.map(Interval::point) }
    }

    /// The coordinate of the larger width.
    pub(crate) fn wider(&self) -> usize {
        usize::from(self.at[1].width() > self.at[0].width())
    }

    pub(crate) fn area(&self) -> f64 {
        self.at[0].width() * self.at[1].width()
    }

    /// Cut in two halves across one coordinate.
    pub(crate) fn cut(&self, across: usize) -> [Self; 2] {
        halves(self.at, across).map(|at| Self { at, ..*self })
    }

    /// Whether the cells have no pull in common; they must be on the same face.
    pub(crate) fn disjoint(&self, other: &Self) -> bool {
        self.at[0].disjoint(other.at[0]) || self.at[1].disjoint(other.at[1])
    }

    /// Whether all of `other`, on the same face, is in this cell.
    pub(crate) fn encloses(&self, other: &Self) -> bool {
        self.face == other.face
            && self.at[0].encloses(other.at[0])
            && self.at[1].encloses(other.at[1])
    }
}

/// The coordinate that is constant on a face, with the sign of the face.
fn towards(face: Face, [h, v, w]: [Interval; 3]) -> Interval {
    match face {
        Face::Near | Face::Around(_) => w,
        Face::Left => -h,
        Face::Right => h,
        Face::Below => -v,
        Face::Above => v,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::plane::loads::JointLoads;

    /// Bars of 2, 4 and 2 kg, their centres in the middle: the weights before them are −3 kg, 0 and
    /// 3 kg about the middle of the chain, in the unit of 4 kg.
    fn system() -> System {
        let bars = [2.0, 4.0, 2.0].map(|mass| (1.0, mass));
        System::new(samples::homogeneous(10.0, &bars, [2.0, 0.0, 0.5]).chain(), JointLoads::NONE)
    }

    /// The pull (H, V) = (1/8, 1/2) in all charts: V is counted from −c of the bar of the chart.
    #[test]
    fn charts_count_the_same_pull_from_their_own_origins() {
        let system = system();
        let near = Cell::point(Face::Near, [0.125, 0.5]);
        let counted = [-0.25, 0.5, 1.25];
        for (from, own) in (0_u8..).zip(counted) {
            let own = Cell::point(Face::Around(from), [0.125, own]);
            let is = |cell: Option<Cell>, [x, y]: [f64; 2]| {
                let Cell { at, .. } = cell.unwrap();
                at[0].contains(x) && at[1].contains(y) && at[1].width() < 1e-14
            };
            assert!(is(near.on(own.face, &system), own.middle()), "{from}");
            assert!(is(own.on(Face::Near, &system), near.middle()), "{from}");
            for (to, there) in (0_u8..).zip(counted) {
                assert!(is(own.on(Face::Around(to), &system), [0.125, there]), "{from} {to}");
            }
            // (H, V, w) = (1, 4, 8)/8.
            assert!(is(own.on(Face::Right, &system), [4.0, 8.0]), "{from}");
            assert!(own.behind(Face::Left, &system) && !own.behind(Face::Above, &system));
        }
    }

    /// Twice is the cell itself: on the faces H = ±1 the face changes, on others H.
    #[test]
    fn mirror_images_have_the_opposite_pull_aside() {
        for face in [Face::Near, Face::Left, Face::Right, Face::Below, Face::Above] {
            let cell = Cell::point(face, [0.25, 0.5]);
            let ([h, v, w], image) = (cell.homogeneous(), cell.mirrored());
            assert_eq!(image.homogeneous(), [-h, v, w], "{face:?}");
            assert_eq!(image.mirrored(), cell);
        }
    }

    /// (H, V, w) = -(1, 4, -8)/8 lies to the left and below, and is told there by its other numbers.
    #[test]
    fn pulls_to_the_left_and_below_have_positive_divisors() {
        let system = system();
        let near = Cell::point(Face::Near, [-0.125, -0.5]);
        for (face, wanted) in [(Face::Left, [-4.0, 8.0]), (Face::Below, [-0.25, 2.0])] {
            let found = near.on(face, &system).unwrap();
            assert!((0..2).all(|k| found.at[k].contains(wanted[k])), "{face:?}: {found:?}");
            assert!(!near.behind(face, &system));
        }
        for face in [Face::Right, Face::Above] {
            assert!(near.on(face, &system).is_none() && near.behind(face, &system), "{face:?}");
        }
    }

    /// Only around a bar, and only where both coordinates may vanish.
    #[test]
    fn the_pull_without_force_is_the_origin_of_its_chart() {
        let of = |face: Face, at: [[f64; 2]; 2]| {
            Cell { face, at: at.map(|[low, high]| Interval::new(low, high)) }.is_at_unloaded_bar()
        };
        let (zero, beside) = ([-1.0, 1.0], [0.5, 1.0]);
        assert!(of(Face::Around(1), [zero, zero]));
        assert!(!of(Face::Around(1), [zero, beside]) && !of(Face::Around(1), [beside, zero]));
        assert!(!of(Face::Near, [zero, zero]));
    }

    #[test]
    fn sizes_are_those_of_the_chart() {
        let small = 0.5 * f64::EPSILON;
        let cell = |face: Face, x: f64, y: f64| Cell::point(face, [x, y]);
        assert_eq!(cell(Face::Near, 0.5, 0.25).unit().to_bits(), 1.0_f64.to_bits());
        assert_eq!(cell(Face::Around(0), 0.5, -0.75).unit().to_bits(), 0.75_f64.to_bits());
        assert!(cell(Face::Around(0), small, -small).unit().is_infinite());
        assert_eq!(Cell::size(Face::Around(0), [0.5, -0.75]).to_bits(), 0.75_f64.to_bits());
        assert_eq!(Cell::size(Face::Above, [0.5, -0.75]).to_bits(), 1.0_f64.to_bits());
        let lost = |face: Face, y: f64| cell(face, small, y).is_lost_around(1);
        assert!(lost(Face::Around(1), -small) && !lost(Face::Around(0), small));
        assert!(!lost(Face::Around(1), 0.5) && !lost(Face::Near, small));
    }

    #[test]
    fn halves_of_a_cell_meet_in_its_middle() {
        let at = [Interval::new(0.0, 2.0), Interval::new(1.0, 5.0)];
        let whole = Cell { face: Face::Near, at };
        let [left, right] = whole.cut(0);
        assert_eq!((left.at[0], right.at[0]), (Interval::new(0.0, 1.0), Interval::new(1.0, 2.0)));
        assert_eq!((left.at[1], right.at[1]), (at[1], at[1]));
        let [low, high] = whole.cut(1);
        assert_eq!((low.at[1], high.at[1]), (Interval::new(1.0, 3.0), Interval::new(3.0, 5.0)));
        assert!(whole.encloses(&left) && !left.encloses(&whole) && !left.disjoint(&right));
        assert!(!whole.encloses(&Cell { face: Face::Above, ..left }));
        for (k, [middle, half]) in [[1.0, 1.0], [3.0, 2.0]].into_iter().enumerate() {
            assert_eq!(whole.middle()[k].to_bits(), f64::to_bits(middle));
            assert!((whole.half()[k] - half).abs() < 1e-15);
        }
    }
}
