//! Members between joints.

use crate::{Bar, Vector};

/// A straight member between two joints.
///
/// Its [`body`](Self::body) gives the unstretched length, the mass and where the mass is. Any
/// weight or constant force at a point of a straight member is linear in the places of its two
/// ends, so a member that stretches carries its loads at fixed *fractions* of its length.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// The joint where it begins.
    pub from: usize,
    /// The joint where it ends.
    pub to: usize,
    /// Which changes of its length it resists.
    pub kind: Kind,
    /// Length (unstretched), mass, centre of weight from [`from`](Self::from), moments of inertia.
    pub body: Bar,
    /// Axial stiffness `EA`, N: the force that would double the length. `None` is inextensible.
    pub stiffness_n: Option<f64>,
    /// Constant forces at points of the member, besides its weight.
    pub loads: Vec<PointLoad>,
}

/// Which changes of its length a member resists. With `l` the unstretched and `d` the present
/// length:
///
/// | kind | inextensible | with stiffness `EA`: axial force |
/// |---|---|---|
/// | bar | `d = l` | `EA (d − l)/l` |
/// | cable | `d ≤ l`, force ≥ 0, none where `d < l` | `max(0, EA (d − l)/l)` |
/// | strut | `d ≥ l`, force ≤ 0, none where `d > l` | `min(0, EA (d − l)/l)` |
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Tension and compression.
    Bar,
    /// Tension alone: shorter than its length it is slack.
    Cable,
    /// Compression alone.
    Strut,
}

/// A constant force at a point of a member.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLoad {
    /// Distance of the point from the joint where the member begins, on the unstretched member, m.
    pub at_m: f64,
    /// The force, world frame, N.
    pub force_n: Vector,
}

impl Member {
    /// A rigid bar.
    #[must_use]
    pub fn bar(from: usize, to: usize, body: Bar) -> Self {
        Self { from, to, kind: Kind::Bar, body, stiffness_n: None, loads: Vec::new() }
    }

    /// An inextensible cable.
    #[must_use]
    pub fn cable(from: usize, to: usize, body: Bar) -> Self {
        Self { kind: Kind::Cable, ..Self::bar(from, to, body) }
    }

    /// The same member with an axial stiffness `EA`, N.
    #[must_use]
    pub fn with_stiffness(self, stiffness_n: f64) -> Self {
        Self { stiffness_n: Some(stiffness_n), ..self }
    }

    /// The greatest distance of its ends that the member allows, m; infinite where it stretches or
    /// does not resist tension.
    ///
    /// ```
    /// use model::{Bar, system::Member};
    /// let rope = Member::cable(0, 1, Bar::homogeneous(5.0, 0.0)?);
    /// assert_eq!((rope.greatest_length_m(), rope.keeps_apart()), (5.0, false));
    /// assert_eq!(rope.with_stiffness(1e6).greatest_length_m(), f64::INFINITY);
    /// assert!(Member::bar(0, 1, Bar::homogeneous(5.0, 0.0)?).keeps_apart());
    /// # Ok::<(), model::BarError>(())
    /// ```
    #[must_use]
    pub fn greatest_length_m(&self) -> f64 {
        match (self.kind, self.stiffness_n) {
            (Kind::Bar | Kind::Cable, None) => self.body.length_m(),
            _ => f64::INFINITY,
        }
    }

    /// Whether the ends can come no nearer to each other than the length: a rigid bar or strut.
    #[must_use]
    pub fn keeps_apart(&self) -> bool {
        self.stiffness_n.is_none() && matches!(self.kind, Kind::Bar | Kind::Strut)
    }
}
