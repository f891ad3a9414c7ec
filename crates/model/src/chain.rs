//! Bars in a row between two anchors.

use std::sync::Arc;

use crate::system::{SystemError, check_range};
use crate::{Bar, Vector, sum};

/// Standard acceleration of gravity, m/s² (exact by definition: 3rd CGPM, 1901).
pub const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// The two fixed points, world frame, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchors {
    /// Joint 0, the paper's *O*.
    pub start_m: Vector,
    /// Joint *n*, the paper's *A₃* (*D* in the example).
    pub end_m: Vector,
}

impl Anchors {
    /// Vector from the start to the end anchor, m.
    ///
    /// ```
    /// let anchors = model::Anchors { start_m: [1.0, 2.0, 3.0], end_m: [2.0, 2.0, 1.0] };
    /// assert_eq!(anchors.difference_m(), [1.0, 0.0, -2.0]);
    /// ```
    pub fn difference_m(&self) -> Vector {
        std::array::from_fn(|k| self.end_m[k] - self.start_m[k])
    }

    /// Distance of the anchors, m; free of overflow and underflow in between.
    ///
    /// It is the distance of the coordinates as the doubles they are, to about one unit in its last
    /// place: the difference of two doubles close to each other is exact. What decimal coordinates
    /// far from the origin lost when they became doubles is not in it; see
    /// [`Refusal::Unresolved`](crate::system::Refusal::Unresolved).
    ///
    /// ```
    /// let anchors = model::Anchors { start_m: [0.0; 3], end_m: [3e200, 0.0, 4e200] };
    /// assert!((anchors.span_m() / 5e200 - 1.0).abs() <= f64::EPSILON);
    /// ```
    pub fn span_m(&self) -> f64 {
        let [x, y, z] = self.difference_m();
        x.hypot(y).hypot(z)
    }
}

/// A chain of n ≥ 1 rigid bars: bar *i* from joint *i*−1 to joint *i*, spherical joints without
/// friction, ends at the anchors, gravity along −Z.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    name: String,
    gravity_m_s2: f64,
    anchors: Anchors,
    /// Shared by clones: of a long chain they are most of what it takes.
    bars: Arc<Vec<Bar>>,
    // Asked for by every part of a solver: a pass over a million bars costs as much as reading
    // them.
    total_length_m: f64,
    total_mass_kg: f64,
}

/// Least total length (m), weight (N), and weight times length (J) of a chain.
///
/// Results carry relative errors of about one [`f64::EPSILON`]; below this total such an error
/// would be less than the smallest normal number, digits would be lost without notice, and products
/// would vanish.
pub const SMALLEST_TOTAL: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// Largest level distance of anchors on one vertical, relative to the total length.
///
/// The two differences of coordinates and the total length carry a rounding error of about one unit
/// in the last place each, decimal coordinates half a unit each; sixteen units leave room for them
/// and for coordinates that were computed in a few steps. The turn of a chain about anchors that
/// are really so far apart level changes its energy by less than the rounding of the energy.
pub const VERTICAL_TOLERANCE: f64 = 16.0 * f64::EPSILON;

impl Chain {
    /// A chain of the given bars, from the start anchor to the end anchor.
    ///
    /// Whether it can hang at all is the question of [`Problem::new`](crate::Problem::new).
    ///
    /// # Errors
    /// [`SystemError`] when there is no bar, a number is out of range, or a total overflows or
    /// vanishes.
    pub fn new(
        name: impl Into<String>,
        gravity_m_s2: f64,
        anchors: Anchors,
        bars: Vec<Bar>,
    ) -> Result<Self, SystemError> {
        if bars.is_empty() {
            return Err(SystemError::NoMembers);
        }
        if !(gravity_m_s2.is_finite() && gravity_m_s2 > 0.0) {
            return Err(SystemError::Gravity(gravity_m_s2));
        }
        for (joint, at_m) in [(0, anchors.start_m), (bars.len(), anchors.end_m)] {
            if let Some(&coordinate_m) = at_m.iter().find(|x| !x.is_finite()) {
                let name = joint.to_string();
                return Err(SystemError::Coordinate { name, joint, coordinate_m });
            }
        }
        let length_m = sum(bars.iter().map(Bar::length_m));
        let mass_kg = sum(bars.iter().map(Bar::mass_kg));
        let weight_n = mass_kg * gravity_m_s2;
        let weighs = mass_kg > 0.0;
        let totals = [
            // Anchors may be in one place, and a chain without mass is refused as a problem.
            ("span", anchors.span_m(), true),
            ("total length", length_m, false),
            ("total weight", weight_n, !weighs),
            ("total weight times total length", weight_n * length_m, !weighs),
        ];
        check_range(totals, bars.iter().map(Bar::mass_kg))?;
        let name = name.into();
        let (total_length_m, total_mass_kg) = (length_m, mass_kg);
        let bars = Arc::new(bars);
        Ok(Self { name, gravity_m_s2, anchors, bars, total_length_m, total_mass_kg })
    }

    /// The name, for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Gravity `g` along −Z, m/s².
    pub fn gravity_m_s2(&self) -> f64 {
        self.gravity_m_s2
    }

    /// The anchors.
    pub fn anchors(&self) -> &Anchors {
        &self.anchors
    }

    /// The bars, from the start anchor to the end anchor.
    pub fn bars(&self) -> &[Bar] {
        &self.bars
    }

    /// Sum of the lengths, m.
    pub fn total_length_m(&self) -> f64 {
        self.total_length_m
    }

    /// Sum of the masses, kg.
    pub fn total_mass_kg(&self) -> f64 {
        self.total_mass_kg
    }

    /// Whether both anchors stand on one vertical, to rounding ([`VERTICAL_TOLERANCE`]): the chain
    /// then turns about it freely, and any vertical plane through the anchors is its plane.
    ///
    /// Everything that computes in doubles asks here. The census, which takes the coordinates as
    /// exact numbers, asks for a level distance of exactly zero: next to it equilibria are proved
    /// to be isolated where on it there are circles of them.
    ///
    /// ```
    /// let paper = model::cases::paper();
    /// assert!(paper.chain().anchors_on_one_vertical());
    /// ```
    pub fn anchors_on_one_vertical(&self) -> bool {
        let [x, y, _] = self.anchors.difference_m();
        x.hypot(y) <= VERTICAL_TOLERANCE * self.total_length_m()
    }
}
