//! Joints and their supports.

use super::JointTolerances;
use crate::Vector;

/// A spherical joint without friction.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name, unique in the system.
    pub name: String,
    /// What holds it.
    pub support: Support,
    /// A point mass at the joint, kg.
    pub mass_kg: f64,
    /// A constant force at the joint besides the weight of its mass, world frame, N.
    pub force_n: Vector,
    /// Where the structure is drawn with it, m: the equilibrium that is wanted is next to the
    /// drawing. `None` for a joint that is held, or where nothing is drawn.
    pub near_m: Option<Vector>,
    /// How far its numbers may be off: see [`with_tolerances`](Self::with_tolerances).
    pub tolerances: Option<Box<JointTolerances>>,
}

/// What holds a joint. The force of a support is normal to the motion that it leaves free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Support {
    /// Nothing but the members that meet in it.
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
    #[must_use]
    pub fn at_m(&self) -> Option<Vector> {
        match *self {
            Self::Free => None,
            Self::Fixed { at_m } | Self::Line { at_m, .. } | Self::Plane { at_m, .. } => Some(at_m),
        }
    }

    /// The same to change; of unit vectors nothing changes.
    pub(super) fn at_m_mut(&mut self) -> Option<&mut Vector> {
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
    #[must_use]
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

    /// Whether it takes all of a force: none of it is along a way that the joint can move. No rounding is
    /// allowed for.
    ///
    /// ```
    /// use model::system::Support;
    /// let along_x = Support::Line { at_m: [0.0; 3], direction: [1.0, 0.0, 0.0] };
    /// assert!(along_x.bears([0.0, 2.0, -3.0]) && !along_x.bears([1e-9, 0.0, 0.0]));
    /// ```
    #[must_use]
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
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        matches!(self, Self::Fixed { .. })
    }
}

impl Joint {
    /// A joint that only its members hold.
    #[must_use]
    pub fn free(name: impl Into<String>) -> Self {
        let support = Support::Free;
        let (mass_kg, force_n) = (0.0, [0.0; 3]);
        Self { name: name.into(), support, mass_kg, force_n, near_m: None, tolerances: None }
    }

    /// A joint that cannot move.
    ///
    /// ```
    /// use model::system::Joint;
    /// let anchor = Joint::anchor("A", [1.0, 0.0, 2.0]);
    /// assert!(anchor.support.is_fixed());
    /// assert_eq!(anchor.support.at_m(), Some([1.0, 0.0, 2.0]));
    /// ```
    #[must_use]
    pub fn anchor(name: impl Into<String>, at_m: Vector) -> Self {
        Self { support: Support::Fixed { at_m }, ..Self::free(name) }
    }

    /// The same joint with a point mass, kg.
    #[must_use]
    pub fn with_mass(self, mass_kg: f64) -> Self {
        Self { mass_kg, ..self }
    }

    /// The same joint with a constant force, N.
    ///
    /// ```
    /// use model::system::Joint;
    /// let buoy = Joint::free("buoy").with_mass(2.0).with_force([0.0, 0.0, 30.0]);
    /// assert_eq!((buoy.mass_kg, buoy.force_n[2], buoy.support.at_m()), (2.0, 30.0, None));
    /// ```
    #[must_use]
    pub fn with_force(self, force_n: Vector) -> Self {
        Self { force_n, ..self }
    }

    /// The same joint, drawn at this place, m.
    #[must_use]
    pub fn near(self, near_m: Vector) -> Self {
        Self { near_m: Some(near_m), ..self }
    }

    /// Where it is drawn, m: its place in the drawing, or else that of its support.
    ///
    /// ```
    /// use model::system::Joint;
    /// assert_eq!(Joint::free("P").near([1.0, 0.0, 2.0]).drawn_m(), Some([1.0, 0.0, 2.0]));
    /// assert_eq!(Joint::anchor("A", [0.0; 3]).drawn_m(), Some([0.0; 3]));
    /// assert_eq!(Joint::free("Q").drawn_m(), None);
    /// ```
    #[must_use]
    pub fn drawn_m(&self) -> Option<Vector> {
        self.near_m.or_else(|| self.support.at_m())
    }
}
