//! Joints and their supports.

use std::ops::{Deref, DerefMut};
use std::sync::{Arc, LazyLock};

use super::share::{Shares, share};
use super::{JointTolerances, Name};
use crate::Vector;

/// A spherical joint without friction.
///
/// All but its name are its [`JointProperties`], which are read and changed as fields of the joint. Joints
/// that are made as copies of one share them until they are changed, as do all that are free and without
/// load: of a million joints in a row the names alone take memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name, unique in the system.
    pub name: Name,
    properties: Arc<JointProperties>,
}

/// What a [`Joint`] is but for its name; as [`Default`], of one that is free and without load.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointProperties {
    /// What holds it.
    pub support: Support,
    /// A point mass at the joint, kg.
    pub mass_kg: f64,
    /// A constant force at the joint besides the weight of its mass, world frame, N.
    pub force_n: Vector,
    /// Where the structure is drawn with it, m: the equilibrium that is wanted is next to the
    /// drawing. `None` for a joint that is held, or where nothing is drawn.
    pub near_m: Option<Vector>,
    /// How far its numbers may be off: see [`Joint::with_tolerances`].
    pub tolerances: Option<Box<JointTolerances>>,
}

impl Deref for Joint {
    type Target = JointProperties;

    fn deref(&self) -> &JointProperties {
        &self.properties
    }
}

impl Shares for Joint {
    fn share(&mut self, before: &Self) {
        share(&mut self.properties, &before.properties);
    }
}

impl DerefMut for Joint {
    fn deref_mut(&mut self) -> &mut JointProperties {
        Arc::make_mut(&mut self.properties)
    }
}

/// Those of a joint that is free and without load.
static FREE: LazyLock<Arc<JointProperties>> = LazyLock::new(Arc::default);

/// What leans by less than this part of its length is level or upright.
const LEVEL: f64 = 1e-12;

const UP: Vector = AXES[2];

const AXES: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// What holds a joint. The force of a support is normal to the motion that it leaves free.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Support {
    /// Nothing but the members that meet in it.
    #[default]
    Free,
    /// An anchor: it cannot move.
    Fixed {
        /// Where it is, m.
        at_m: Vector,
    },
    /// It slides without friction on a straight line.
    Line {
        /// A point of the line, m.
        at_m: Vector,
        /// The direction of the line, of unit length.
        direction: Vector,
    },
    /// It slides without friction in a plane.
    Plane {
        /// A point of the plane, m.
        at_m: Vector,
        /// The normal of the plane, of unit length.
        normal: Vector,
    },
}

impl Support {
    /// A point of the support, m; nothing for a free joint.
    pub fn at_m(&self) -> Option<Vector> {
        match *self {
            Self::Free => None,
            Self::Fixed { at_m } | Self::Line { at_m, .. } | Self::Plane { at_m, .. } => Some(at_m),
        }
    }

    /// The part of a vector along the motions that it leaves.
    ///
    /// ```
    /// use model::system::Support;
    /// let rail = Support::Line { at_m: [0.0; 3], direction: [0.6, 0.0, 0.8] };
    /// assert_eq!(rail.free_part([0.0, 5.0, 10.0]), [4.8, 0.0, 6.4]);
    /// ```
    pub fn free_part(&self, v: Vector) -> Vector {
        let along = |a: Vector| {
            let part = v.iter().zip(a).map(|(x, y)| x * y).sum::<f64>();
            a.map(|x| part * x)
        };
        match *self {
            Self::Free => v,
            Self::Fixed { .. } => [0.0; 3],
            Self::Line { direction, .. } => along(direction),
            Self::Plane { normal, .. } => {
                let off = along(normal);
                std::array::from_fn(|k| v[k] - off[k])
            }
        }
    }

    /// What holds the joint where it also lies on the level through a point, m; `None` where it cannot rise from there.
    ///
    /// ```
    /// use model::system::Support;
    /// let wall = Support::Plane { at_m: [0.0, 3.0, 0.0], normal: [0.0, 1.0, 0.0] };
    /// let Some(Support::Line { at_m, direction }) = wall.on_level([7.0, 3.0, -2.0]) else { panic!("a line") };
    /// assert_eq!((at_m, direction.map(f64::abs)), ([0.0, 3.0, -2.0], [1.0, 0.0, 0.0]));
    /// assert_eq!(wall.on_level([7.0, 3.0, -2.0]).and_then(|line| line.on_level([0.0; 3])), None);
    /// ```
    #[must_use]
    pub fn on_level(&self, at_m: Vector) -> Option<Self> {
        let rise = self.free_part(UP);
        if rise[2] <= LEVEL {
            return None;
        }
        let from = self.at_m().unwrap_or(at_m);
        let part = (at_m[2] - from[2]) / rise[2];
        let [x, y] = [0, 1].map(|k| from[k] + part * rise[k]);
        let at_m = [x, y, at_m[2]];
        Some(match *self {
            Self::Plane { normal: [x, y, _], .. } => {
                let level = x.hypot(y);
                Self::Line { at_m, direction: [-y / level, x / level, 0.0] }
            }
            Self::Line { .. } => Self::Fixed { at_m },
            _ => Self::Plane { at_m, normal: UP },
        })
    }

    /// The part of a force that an upright push takes where the support takes the rest: all of it but for what is normal to its
    /// motions. `None` where the joint cannot rise.
    pub fn upright_part(&self, force_n: Vector) -> Option<f64> {
        let rise = self.free_part(UP);
        let along: f64 = force_n.iter().zip(rise).map(|(f, r)| f * r).sum();
        (rise[2] > LEVEL).then(|| along / rise[2])
    }

    /// Whether it takes an upright force.
    pub fn holds_height(&self) -> bool {
        match *self {
            Self::Free => false,
            Self::Fixed { .. } => true,
            Self::Line { direction, .. } => direction[2].abs() < 1.0 - LEVEL,
            Self::Plane { normal, .. } => normal[2].abs() > LEVEL,
        }
    }

    /// The same to change; of unit vectors nothing changes.
    pub fn at_m_mut(&mut self) -> Option<&mut Vector> {
        match self {
            Self::Free => None,
            Self::Fixed { at_m } | Self::Line { at_m, .. } | Self::Plane { at_m, .. } => Some(at_m),
        }
    }

    /// The place nearest to a point at which the support lets the joint be, m.
    ///
    /// ```
    /// use model::system::Support;
    /// let along_x = Support::Line { at_m: [0.0, 0.0, 2.0], direction: [1.0, 0.0, 0.0] };
    /// assert_eq!(along_x.nearest_m([3.0, 4.0, 5.0]), [3.0, 0.0, 2.0]);
    /// let level = Support::Plane { at_m: [0.0, 0.0, 2.0], normal: [0.0, 0.0, 1.0] };
    /// assert_eq!(level.nearest_m([3.0, 4.0, 5.0]), [3.0, 4.0, 2.0]);
    /// ```
    pub fn nearest_m(&self, point_m: Vector) -> Vector {
        let part = |at_m: Vector, along: Vector| -> f64 {
            (0..3).map(|k| (point_m[k] - at_m[k]) * along[k]).sum()
        };
        match *self {
            Self::Free => point_m,
            Self::Fixed { at_m } => at_m,
            Self::Line { at_m, direction } => {
                std::array::from_fn(|k| at_m[k] + part(at_m, direction) * direction[k])
            }
            Self::Plane { at_m, normal } => {
                std::array::from_fn(|k| point_m[k] - part(at_m, normal) * normal[k])
            }
        }
    }

    /// What holds a joint that both supports hold; nothing where they have no place in common.
    #[must_use]
    pub fn meeting(&self, other: &Self) -> Option<Self> {
        /// Rounding of directions, and of places over the largest coordinate.
        const ROUNDING: f64 = 1e-12;
        let dot = |a: Vector, b: Vector| -> f64 { (0..3).map(|k| a[k] * b[k]).sum() };
        let mut at_m = other.at_m().or(self.at_m()).unwrap_or_default();
        let far_m = [self, other].map(|support| support.at_m().unwrap_or_default());
        let far_m = far_m.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let mut held: Vec<Vector> = vec![];
        for support in [self, other] {
            for normal in support.normals() {
                let mut rest = normal;
                for axis in &held {
                    let part = dot(rest, *axis);
                    rest = std::array::from_fn(|k| rest[k] - part * axis[k]);
                }
                let size = dot(rest, rest).sqrt();
                if size > ROUNDING.sqrt() {
                    let axis = rest.map(|x| x / size);
                    let off_m =
                        support.at_m().map_or(0.0, |to_m| dot(normal, to_m) - dot(normal, at_m));
                    at_m = std::array::from_fn(|k| at_m[k] + off_m / dot(normal, axis) * axis[k]);
                    held.push(axis);
                }
            }
        }
        let fixed = [self, other].into_iter().find(|support| support.is_fixed());
        let meeting = match held[..] {
            [] => Self::Free,
            [normal] => Self::Plane { at_m, normal },
            [[a, b, c], [x, y, z]] => {
                Self::Line { at_m, direction: [b * z - c * y, c * x - a * z, a * y - b * x] }
            }
            _ => *fixed.unwrap_or(&Self::Fixed { at_m }),
        };
        let at_m = meeting.at_m().unwrap_or_default();
        let off_m = |support: &Self| {
            let away: Vector = std::array::from_fn(|k| support.nearest_m(at_m)[k] - at_m[k]);
            dot(away, away).sqrt()
        };
        (off_m(self).max(off_m(other)) <= ROUNDING * far_m).then_some(meeting)
    }

    /// Orthonormal directions in which the joint may move.
    ///
    /// ```
    /// use model::system::Support;
    /// let level = Support::Plane { at_m: [0.0, 0.0, 2.0], normal: [0.0, 0.0, 1.0] };
    /// assert_eq!(level.motions(), [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    /// ```
    pub fn motions(&self) -> Vec<Vector> {
        let unit = |v: Vector| v.map(|x| x / v.iter().map(|x| x * x).sum::<f64>().sqrt());
        match *self {
            Self::Free => AXES.to_vec(),
            Self::Fixed { .. } => vec![],
            Self::Line { direction, .. } => vec![unit(direction)],
            Self::Plane { normal: n, .. } => {
                let across = |[x, y, z]: Vector| {
                    unit([n[1] * z - n[2] * y, n[2] * x - n[0] * z, n[0] * y - n[1] * x])
                };
                let least = (0..3).min_by(|i, j| n[*i].abs().total_cmp(&n[*j].abs()));
                let first = across(AXES[least.unwrap_or(0)]);
                vec![first, across(first)]
            }
        }
    }

    /// Orthonormal directions in which it cannot.
    pub fn normals(&self) -> Vec<Vector> {
        match *self {
            Self::Free => vec![],
            Self::Fixed { .. } => AXES.to_vec(),
            Self::Plane { normal, .. } => vec![normal],
            Self::Line { at_m, direction } => Self::Plane { at_m, normal: direction }.motions(),
        }
    }

    /// Whether it takes all of a force: none of it is along a way that the joint can move. No rounding is
    /// allowed for.
    ///
    /// ```
    /// use model::system::Support;
    /// let along_x = Support::Line { at_m: [0.0; 3], direction: [1.0, 0.0, 0.0] };
    /// assert!(along_x.bears([0.0, 2.0, -3.0]) && !along_x.bears([1e-9, 0.0, 0.0]));
    /// ```
    pub fn bears(&self, force_n: Vector) -> bool {
        let [x, y, z] = force_n;
        let left: f64 = match *self {
            Self::Free => x.abs() + y.abs() + z.abs(),
            Self::Fixed { .. } => 0.0,
            Self::Line { direction: [a, b, c], .. } => (a * x + b * y + c * z).abs(),
            Self::Plane { normal: [a, b, c], .. } => {
                (b * z - c * y).abs() + (c * x - a * z).abs() + (a * y - b * x).abs()
            }
        };
        left <= 0.0
    }

    /// Whether the joint can move at all.
    pub fn is_fixed(&self) -> bool {
        matches!(self, Self::Fixed { .. })
    }
}

impl Joint {
    /// A joint that only its members hold.
    pub fn free(name: impl Into<Name>) -> Self {
        Self { name: name.into(), properties: Arc::clone(&FREE) }
    }

    /// A joint that cannot move.
    ///
    /// ```
    /// use model::system::Joint;
    /// let anchor = Joint::anchor("A", [1.0, 0.0, 2.0]);
    /// assert!(anchor.support.is_fixed());
    /// assert_eq!(anchor.support.at_m(), Some([1.0, 0.0, 2.0]));
    /// ```
    pub fn anchor(name: impl Into<Name>, at_m: Vector) -> Self {
        Self::free(name).held_by(Support::Fixed { at_m })
    }

    /// The same joint by another name.
    #[must_use]
    pub fn named(self, name: impl Into<Name>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same joint on a support.
    ///
    /// ```
    /// use model::system::{Joint, Support};
    /// let rail = Support::Line { at_m: [0.0, 0.0, 2.0], direction: [1.0, 0.0, 0.0] };
    /// assert_eq!(Joint::free("S").held_by(rail).support, rail);
    /// ```
    #[must_use]
    pub fn held_by(mut self, support: Support) -> Self {
        self.support = support;
        self
    }

    /// The same joint with a point mass, kg.
    #[must_use]
    pub fn with_mass(mut self, mass_kg: f64) -> Self {
        self.mass_kg = mass_kg;
        self
    }

    /// The same joint with a constant force, N.
    ///
    /// ```
    /// use model::system::Joint;
    /// let buoy = Joint::free("buoy").with_mass(2.0).with_force([0.0, 0.0, 30.0]);
    /// assert_eq!((buoy.mass_kg, buoy.force_n[2], buoy.support.at_m()), (2.0, 30.0, None));
    /// ```
    #[must_use]
    pub fn with_force(mut self, force_n: Vector) -> Self {
        self.force_n = force_n;
        self
    }

    /// The same joint, drawn at this place, m; with `None` not drawn.
    #[must_use]
    pub fn near(mut self, near_m: impl Into<Option<Vector>>) -> Self {
        self.near_m = near_m.into();
        self
    }

    /// Where it is drawn, m: its place in the drawing, or else that of its support.
    ///
    /// ```
    /// use model::system::Joint;
    /// assert_eq!(Joint::free("P").near([1.0, 0.0, 2.0]).drawn_m(), Some([1.0, 0.0, 2.0]));
    /// assert_eq!(Joint::anchor("A", [0.0; 3]).drawn_m(), Some([0.0; 3]));
    /// assert_eq!(Joint::free("Q").drawn_m(), None);
    /// ```
    pub fn drawn_m(&self) -> Option<Vector> {
        self.near_m.or_else(|| self.support.at_m())
    }
}
