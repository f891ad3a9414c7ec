//! Joints and forces as arrays, for programs that go on computing with a million bars.

use std::ops::Range;

use model::{Reactions, Vector};

use super::bar_data::resize;
use super::chain::Condensed;
use super::parallel::split;
use super::pull::Pull;
use super::reconstruction::reconstruct;

/// A shape in its vertical plane, one array per quantity; SI units.
///
/// Joint k is at `start_m` + `along_m[k]` × level + `height_m[k]` × up; the horizontal part of
/// every multiplier but the first is `horizontal_n` × level.
///
/// ```
/// use lagrange::condensed::{Condensed, Settings};
/// let chain = Condensed::new(&model::cases::paper());
/// let shape = chain.reconstruct(&chain.pull(&Settings::default())?);
/// // E1: V counts from 6 mgl lower in the paper.
/// assert!((shape.energy_j / 9.80665 + 6.0 - 2.335468651999305).abs() < 1e-14);
/// assert!(shape.closure < 1e-15);
/// # Ok::<(), lagrange::condensed::CondensedError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Joint 0, m.
    pub start_m: Vector,
    /// Horizontal unit vector of the plane, X and Y.
    pub level: [f64; 2],
    /// Horizontal position of each joint 0..=n from joint 0, m.
    pub along_m: Vec<f64>,
    /// Height of each joint above joint 0, m.
    pub height_m: Vec<f64>,
    /// Axial force of each bar with its weight lumped to its joints, tension positive, N.
    pub axial_n: Vec<f64>,
    /// Vertical part of the multipliers: entry 0 of the force of the ground on bar 1, the others of
    /// the force of bar k+1 (at the end: of the ground) on bar k at joint k, N.
    pub vertical_n: Vec<f64>,
    /// Horizontal part of the multipliers but the first, which has the opposite, N.
    pub horizontal_n: f64,
    /// Potential energy from the height of joint 0, J.
    pub energy_j: f64,
    /// Distance of the last joint from its anchor, relative to the total length.
    pub closure: f64,
}

impl Shape {
    /// Position of a joint, world frame, m; `None` beyond the last.
    ///
    /// ```
    /// use lagrange::condensed::{Condensed, Settings};
    /// let chain = Condensed::new(&model::cases::paper());
    /// let shape = chain.reconstruct(&chain.pull(&Settings::default())?);
    /// // Joint 1 is cos 19.69° below the first anchor; there is no joint 4.
    /// let [_, _, z] = shape.joint_m(1).unwrap();
    /// assert!((z + 19.694867976133019_f64.to_radians().cos()).abs() < 1e-14);
    /// assert_eq!(shape.joint_m(4), None);
    /// # Ok::<(), lagrange::condensed::CondensedError>(())
    /// ```
    #[must_use]
    pub fn joint_m(&self, k: usize) -> Option<Vector> {
        let (s, z) = (*self.along_m.get(k)?, *self.height_m.get(k)?);
        let [x0, y0, z0] = self.start_m;
        Some([x0 + self.level[0] * s, y0 + self.level[1] * s, z0 + z])
    }

    /// A multiplier, world frame, N, in the meaning of
    /// [`multipliers_n`](model::Equilibrium::multipliers_n); `None` beyond the last.
    ///
    /// ```
    /// use lagrange::condensed::{Condensed, Settings};
    /// let chain = Condensed::new(&model::cases::paper());
    /// let shape = chain.reconstruct(&chain.pull(&Settings::default())?);
    /// // The paper's lambda_6: the vertical force of bar 2 on bar 1.
    /// let [_, _, lambda_6] = shape.multiplier_n(1).unwrap();
    /// assert!((lambda_6 / 9.80665 + 1.312944292241838).abs() < 1e-14);
    /// # Ok::<(), lagrange::condensed::CondensedError>(())
    /// ```
    #[must_use]
    pub fn multiplier_n(&self, k: usize) -> Option<Vector> {
        let h = if k == 0 { -self.horizontal_n } else { self.horizontal_n };
        Some([h * self.level[0], h * self.level[1], *self.vertical_n.get(k)?])
    }
}

impl Condensed {
    /// All joints and forces that belong to a pull of this chain, as arrays.
    ///
    /// ```
    /// use lagrange::condensed::{Condensed, Settings};
    /// let chain = Condensed::new(&model::cases::paper());
    /// let shape = chain.reconstruct(&chain.pull(&Settings::default())?);
    /// // Back at the last anchor, 2 m below the first.
    /// assert!((shape.height_m[3] + 2.0).abs() < 1e-15 && shape.along_m[3].abs() < 1e-15);
    /// # Ok::<(), lagrange::condensed::CondensedError>(())
    /// ```
    #[must_use]
    pub fn reconstruct(&self, pull: &Pull) -> Shape {
        let mut shape = Shape {
            start_m: self.start_m,
            level: pull.level,
            along_m: Vec::new(),
            height_m: Vec::new(),
            axial_n: Vec::new(),
            vertical_n: Vec::new(),
            horizontal_n: 0.0,
            energy_j: 0.0,
            closure: 0.0,
        };
        self.reconstruct_into(pull, &mut shape);
        shape
    }

    /// The same in the memory of another shape.
    ///
    /// ```
    /// use lagrange::condensed::{Condensed, Settings};
    /// let long = Condensed::new(&model::cases::get("thirty-bars").unwrap().problem());
    /// let mut shape = long.reconstruct(&long.pull(&Settings::default())?);
    /// let chain = Condensed::new(&model::cases::paper());
    /// chain.reconstruct_into(&chain.pull(&Settings::default())?, &mut shape);
    /// assert_eq!(shape.axial_n.len(), 3);
    /// # Ok::<(), lagrange::condensed::CondensedError>(())
    /// ```
    pub fn reconstruct_into(&self, pull: &Pull, shape: &mut Shape) {
        let n = self.bars();
        let (length, force) = (self.units.length, self.units.force());
        let Shape { along_m, height_m, axial_n, vertical_n, .. } = shape;
        for (array, count) in [
            (&mut *along_m, n + 1),
            (&mut *height_m, n + 1),
            (&mut *axial_n, n),
            (&mut *vertical_n, n + 1),
        ] {
            resize(array, count);
        }
        let output =
            [&mut along_m[1..], &mut height_m[1..], &mut axial_n[..], &mut vertical_n[1..]];
        let ends = reconstruct(self, pull, output, split, |output, segment| {
            let [along_m, height_m, axial_n, vertical_n] = output;
            let bars = segment.first..segment.first + segment.axial.len();
            scale(&mut along_m[bars.clone()], segment.along, length);
            scale(&mut height_m[bars.clone()], segment.height, length);
            scale(&mut axial_n[bars.clone()], segment.axial, force);
            scale(&mut vertical_n[bars], segment.vertical, force);
        });
        (along_m[0], height_m[0]) = (0.0, 0.0);
        vertical_n[0] = pull.ground_n()[2];
        shape.start_m = self.start_m;
        shape.level = pull.level;
        shape.horizontal_n = pull.force[0] * force;
        shape.energy_j = ends.energy * length * force;
        shape.closure = self.closure_of(pull, ends.last);
    }

    /// All joints and forces that belong to a pull of this chain, as vectors in the world frame.
    pub(super) fn vectors(&self, pull: &Pull, to: &mut Vectors) -> Totals {
        let n = self.bars();
        let (length, force) = (self.units.length, self.units.force());
        let ([x0, y0, z0], [ex, ey]) = (self.start_m, pull.level);
        let h = pull.force[0] * force;
        let (hx, hy) = (h * ex, h * ey);
        let Vectors { joints_m, multipliers_n, axial_n } = to;
        resize(joints_m, n + 1);
        resize(multipliers_n, n + 1);
        resize(axial_n, n);
        let output = ([&mut joints_m[1..], &mut multipliers_n[1..]], [&mut axial_n[..]]);
        let split = |(vectors, numbers), ranges: &[Range<usize>]| {
            split(vectors, ranges).into_iter().zip(split(numbers, ranges)).collect()
        };
        let ends = reconstruct(self, pull, output, split, |output, segment| {
            let ([joints_m, multipliers_n], [axial_n]) = output;
            let bars = segment.first..segment.first + segment.axial.len();
            let positions = segment.along.iter().zip(segment.height);
            for (joint, (s, z)) in joints_m[bars.clone()].iter_mut().zip(positions) {
                let s = s * length;
                *joint = [x0 + ex * s, y0 + ey * s, z0 + z * length];
            }
            for (lambda, v) in multipliers_n[bars.clone()].iter_mut().zip(segment.vertical) {
                *lambda = [hx, hy, v * force];
            }
            scale(&mut axial_n[bars], segment.axial, force);
        });
        joints_m[0] = self.start_m;
        multipliers_n[0] = pull.ground_n();
        Totals {
            reactions_n: Reactions { start: pull.ground_n(), end: multipliers_n[n] },
            energy_j: ends.energy * length * force,
            closure: self.closure_of(pull, ends.last),
        }
    }

    /// Distance of the last joint from its anchor, relative to the total length.
    fn closure_of(&self, pull: &Pull, [along, height]: [f64; 2]) -> f64 {
        // The plane of a pull that was given need not be that of the anchors.
        let [ex, ey] = self.span.level.map(|e| e * self.span.across);
        let [x, y] = pull.level.map(|e| e * along);
        let off = (x - ex).hypot(y - ey).hypot(height - self.span.rise);
        off / self.bars.total_length
    }
}

/// Memory for the answer.
#[derive(Debug, Clone, Default)]
pub(super) struct Vectors {
    pub joints_m: Vec<Vector>,
    pub multipliers_n: Vec<Vector>,
    pub axial_n: Vec<f64>,
}

/// What belongs to all bars in_parallel.
pub(super) struct Totals {
    pub reactions_n: Reactions,
    pub energy_j: f64,
    /// Distance of the last joint from its anchor, relative to the total length.
    pub closure: f64,
}

fn scale(to: &mut [f64], from: &[f64], by: f64) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = from * by;
    }
}
