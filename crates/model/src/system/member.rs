//! Members between joints.

use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use super::share::{Shares, share};
use super::{MemberTolerances, Prestress, Rope, Strength};
use crate::{Bar, Vector};

/// A straight member between two joints, or a [`Rope`] over others.
///
/// Its [`body`](MemberProperties::body) gives the unstretched length, the mass and where the mass is. Any
/// weight or constant force at a point of a straight member is linear in the places of its two
/// ends, so a member that stretches carries its loads at fixed *fractions* of its length.
///
/// All but its two ends are its [`MemberProperties`], which are read and changed as fields of the member.
/// Members that are made as copies of one share them until they are changed: a million equal bars in a row
/// have one length and one mass in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// The joint where it begins.
    pub from: usize,
    /// The joint where it ends.
    pub to: usize,
    properties: Arc<MemberProperties>,
}

/// What a [`Member`] is but for the joints at its ends.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberProperties {
    /// The joints between that it runs over; `None` where it is straight. See [`Member::over`].
    pub rope: Option<Box<Rope>>,
    /// Which changes of its length it resists.
    pub kind: Kind,
    /// Length (unstretched), mass, centre of weight from [`from`](Member::from), moments of inertia.
    pub body: Bar,
    /// Axial stiffness `EA`, N: the force that would double the length. `None` is inextensible.
    pub stiffness_n: Option<f64>,
    /// What was given in the place of the unstretched length: see
    /// [`Member::with_prestress`], which sets it together with the body.
    pub prestress: Option<Box<Prestress>>,
    /// What it bears before it breaks; nothing that a solver looks at.
    pub strength: Option<Box<Strength>>,
    /// How far its other numbers may be off: see [`Member::with_tolerances`].
    pub tolerances: Option<Box<MemberTolerances>>,
    /// Constant forces at points of the member, besides its weight.
    pub loads: Vec<PointLoad>,
    /// What of this follows the length that a file gives.
    pub by_length: ByLength,
}

/// What of a member follows the length that its file gives: where that length is another one, so are these.
#[derive(Debug, Clone, Copy)]
pub struct ByLength {
    /// How many times as long the member is, after a change of temperature.
    pub growth: f64,
    /// Whether its mass is given a metre.
    pub mass: bool,
    /// The force on each metre, N/m.
    pub force_n_per_m: Vector,
}

impl Default for ByLength {
    fn default() -> Self {
        Self { growth: 1.0, mass: false, force_n_per_m: [0.0; 3] }
    }
}

/// Members are equal by their numbers, whatever these were made of.
impl PartialEq for ByLength {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Deref for Member {
    type Target = MemberProperties;

    fn deref(&self) -> &MemberProperties {
        &self.properties
    }
}

impl Shares for Member {
    fn share(&mut self, before: &Self) {
        let made_of = |member: &Self| {
            let ByLength { growth, mass, force_n_per_m } = member.by_length;
            (growth.to_bits(), mass, force_n_per_m.map(f64::to_bits))
        };
        if made_of(self) == made_of(before) {
            share(&mut self.properties, &before.properties);
        }
    }
}

impl DerefMut for Member {
    fn deref_mut(&mut self) -> &mut MemberProperties {
        Arc::make_mut(&mut self.properties)
    }
}

/// How far a length may be off, as a part of it, where the file gives no tolerance. Bars of a frame
/// that are more than needed overdetermine its shape, and no lengths that are rounded fit it
/// exactly: digits written to nine places are meant to.
pub const LENGTH_ROUNDING: f64 = 1e-9;

/// The misfit of one length where the lengths of inextensible members overdetermine the shape.
///
/// Of the shape that meets all lengths best: least $\sum e^2/l$ over the differences $e$ between
/// distance and length, which is where equally stiff members would come to rest without loads.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Misfit {
    /// Number of the member, from 0.
    pub member: usize,
    /// Distance of its ends less its length, m.
    pub misfit_m: f64,
    /// What it may be: [`Member::within_m`].
    pub within_m: f64,
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

impl Kind {
    /// What of a force (tension positive) or an elongation it resists.
    ///
    /// ```
    /// use model::system::Kind;
    /// let pushed = [Kind::Bar, Kind::Cable, Kind::Strut].map(|kind| kind.borne(-2.0));
    /// assert_eq!((pushed, Kind::Strut.borne(2.0)), ([-2.0, 0.0, -2.0], 0.0));
    /// ```
    pub fn borne(self, x: f64) -> f64 {
        match self {
            Self::Bar => x,
            Self::Cable => x.max(0.0),
            Self::Strut => x.min(0.0),
        }
    }

    /// Its name in system files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bar => "bar",
            Self::Cable => "cable",
            Self::Strut => "strut",
        }
    }
}

/// A constant force at a point of a member, or spread over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLoad {
    /// Distance of the point from the joint where the member begins, on the unstretched member, m.
    pub at_m: f64,
    /// The force, world frame, N.
    pub force_n: Vector,
    /// Whether it is spread evenly over the member, so that `at_m` is its middle: the ends bear it as one there, and the axial
    /// force between them changes evenly.
    pub is_spread: bool,
}

impl Member {
    /// A rigid bar.
    pub fn bar(from: usize, to: usize, body: Bar) -> Self {
        let properties = MemberProperties {
            rope: None,
            kind: Kind::Bar,
            body,
            stiffness_n: None,
            prestress: None,
            strength: None,
            tolerances: None,
            loads: Vec::new(),
            by_length: ByLength::default(),
        };
        Self { from, to, properties: Arc::new(properties) }
    }

    /// An inextensible cable.
    pub fn cable(from: usize, to: usize, body: Bar) -> Self {
        Self::bar(from, to, body).of_kind(Kind::Cable)
    }

    /// The same member between two other joints.
    #[must_use]
    pub fn between(self, from: usize, to: usize) -> Self {
        Self { from, to, ..self }
    }

    /// The same member, of a kind.
    #[must_use]
    pub fn of_kind(mut self, kind: Kind) -> Self {
        self.kind = kind;
        self
    }

    /// The same member with another body.
    #[must_use]
    pub fn with_body(mut self, body: Bar) -> Self {
        self.body = body;
        self
    }

    /// The same member with an axial stiffness `EA`, N; with `None` inextensible.
    #[must_use]
    pub fn with_stiffness(mut self, stiffness_n: impl Into<Option<f64>>) -> Self {
        self.stiffness_n = stiffness_n.into();
        self
    }

    /// The same member with constant forces at points of it.
    ///
    /// ```
    /// use model::{Bar, system::{Kind, Member, PointLoad}};
    /// let load = PointLoad { at_m: 0.5, force_n: [0.0, 2.0, 0.0], is_spread: false };
    /// let strut = Member::bar(0, 1, Bar::homogeneous(2.0, 1.0)?).of_kind(Kind::Strut);
    /// let strut = strut.with_loads(vec![load]).between(3, 4);
    /// assert_eq!((strut.from, strut.kind, strut.loads[0]), (3, Kind::Strut, load));
    /// # Ok::<(), model::BarError>(())
    /// ```
    #[must_use]
    pub fn with_loads(mut self, loads: Vec<PointLoad>) -> Self {
        self.loads = loads;
        self
    }

    /// The same member with a length known to within this, m; with `None` nothing is known of it.
    #[must_use]
    pub fn with_length_tolerance(mut self, length_tolerance_m: impl Into<Option<f64>>) -> Self {
        self.set_length_tolerance(length_tolerance_m.into());
        self
    }

    /// The same member with what it bears before it breaks, if that is known.
    #[must_use]
    pub fn bearing(mut self, strength: Option<Strength>) -> Self {
        self.strength = strength.map(Box::new);
        self
    }

    /// How far the length may be off where lengths of inextensible members overdetermine a shape, m: the tolerance given, or
    /// [`LENGTH_ROUNDING`] of the length.
    ///
    /// ```
    /// use model::{Bar, system::Member};
    /// let bar = Member::bar(0, 1, Bar::homogeneous(5.0, 0.0)?);
    /// assert_eq!((bar.within_m(), bar.with_length_tolerance(1e-3).within_m()), (5e-9, 1e-3));
    /// # Ok::<(), model::BarError>(())
    /// ```
    pub fn within_m(&self) -> f64 {
        self.length_tolerance_m().unwrap_or(LENGTH_ROUNDING * self.body.length_m())
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
    pub fn greatest_length_m(&self) -> f64 {
        match (self.kind, self.stiffness_n) {
            (Kind::Bar | Kind::Cable, None) => self.body.length_m(),
            _ => f64::INFINITY,
        }
    }

    /// Weight and loads as forces at the two ends, by the lever rule, N: for checks and motion. Each solver derives its own.
    ///
    /// ```
    /// use model::{Bar, system::{Member, PointLoad}};
    /// let load = PointLoad { at_m: 1.0, force_n: [8.0, 0.0, 0.0], is_spread: false };
    /// let bar = Member::bar(0, 1, Bar::homogeneous(4.0, 2.0)?).with_loads(vec![load]);
    /// assert_eq!(bar.end_loads_n(10.0), [[6.0, 0.0, -10.0], [2.0, 0.0, -10.0]]);
    /// # Ok::<(), model::BarError>(())
    /// ```
    pub fn end_loads_n(&self, gravity_m_s2: f64) -> [Vector; 2] {
        let (length_m, centre_m) = (self.body.length_m(), self.body.centre_m());
        let weight = [0.0, 0.0, -self.body.mass_kg() * gravity_m_s2];
        let loads = self.loads.iter().map(|load| (load.at_m, load.force_n));
        let mut ends = [[0.0; 3]; 2];
        for (at_m, force_n) in loads.chain([(centre_m, weight)]) {
            let part = at_m / length_m;
            for (k, x) in force_n.iter().enumerate() {
                ends[0][k] += (1.0 - part) * x;
                ends[1][k] += part * x;
            }
        }
        ends
    }

    /// Whether the ends can come no nearer to each other than the length: a rigid bar or strut.
    pub fn keeps_apart(&self) -> bool {
        self.stiffness_n.is_none() && matches!(self.kind, Kind::Bar | Kind::Strut)
    }
}
