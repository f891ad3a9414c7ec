//! One rigid bar.

use crate::readable::Readable;

/// One rigid bar, as the paper describes it: `l_i`, `m_i`, `r_i` and the principal central moments
/// of inertia.
///
/// The moments are data of the mechanism (paper, section II); no equilibrium depends on them.
#[derive(Debug, Clone, Copy)]
pub struct Bar {
    length_m: f64,
    mass_kg: f64,
    centre_m: f64,
    inertia_kg_m2: [f64; 3],
    /// Whether centre and moments were given; if not, they follow the length and the mass.
    is_given: [bool; 2],
}

/// Bars are equal by their numbers, given or not.
impl PartialEq for Bar {
    fn eq(&self, other: &Self) -> bool {
        let numbers = |bar: &Self| (bar.length_m, bar.mass_kg, bar.centre_m, bar.inertia_kg_m2);
        numbers(self) == numbers(other)
    }
}

/// Why a bar cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BarError {
    /// Occurs when the length, in m, is zero, negative, infinite or not a number.
    #[error("the length of a bar must be positive and finite, got {} m", Readable(*.0))]
    Length(f64),
    /// Occurs when the mass, in kg, is negative, infinite or not a number; zero is a massless link.
    #[error("the mass of a bar must be zero or positive, and finite, got {} kg", Readable(*.0))]
    Mass(f64),
    /// Occurs when the centre of weight does not lie on the bar.
    #[error(
        "the centre of weight must lie on the bar, between 0 and its length {} m, got {} m",
        Readable(*length_m), Readable(*centre_m)
    )]
    Centre {
        /// The distance from the first joint as given.
        centre_m: f64,
        /// The length of the bar.
        length_m: f64,
    },
    /// Occurs when a principal moment of inertia is negative, infinite or not a number: the first such, kg m².
    #[error("a moment of inertia must be zero or positive, and finite, got {} kg m^2", Readable(*.0))]
    Inertia(f64),
}

impl Bar {
    /// A bar with its centre of weight at `centre_m` from the first joint and the principal central
    /// moments of inertia `J_x, J_y, J_z` (x along the bar).
    ///
    /// # Errors
    /// [`BarError`] when a number is out of range; nothing is repaired.
    ///
    /// ```
    /// use model::{Bar, BarError};
    /// let bar = Bar::new(2.0, 3.0, 0.5, [0.0, 1.0, 1.0])?;
    /// assert_eq!((bar.length_m(), bar.mass_kg(), bar.centre_m()), (2.0, 3.0, 0.5));
    /// // The centre of weight lies on the bar.
    /// let error = Bar::new(2.0, 3.0, 2.5, [0.0; 3]).unwrap_err();
    /// assert_eq!(error, BarError::Centre { centre_m: 2.5, length_m: 2.0 });
    /// # Ok::<(), model::BarError>(())
    /// ```
    pub fn new(
        length_m: f64,
        mass_kg: f64,
        centre_m: f64,
        inertia_kg_m2: [f64; 3],
    ) -> Result<Self, BarError> {
        Self::given(length_m, mass_kg, Some(centre_m), Some(inertia_kg_m2))
    }

    /// A bar as a system file gives it: without a centre that is in the middle, without moments
    /// they are those of [`slender_inertia`](Self::slender_inertia), and follow when the length or
    /// the mass is changed.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    ///
    /// ```
    /// use model::Bar;
    /// let bar = Bar::given(2.0, 3.0, None, Some([0.0, 1.0, 2.0]))?;
    /// assert_eq!((bar.centre_m(), bar.given_centre_m()), (1.0, None));
    /// assert_eq!(bar.given_inertia_kg_m2(), Some([0.0, 1.0, 2.0]));
    /// # Ok::<(), model::BarError>(())
    /// ```
    pub fn given(
        length_m: f64,
        mass_kg: f64,
        given_centre_m: Option<f64>,
        given_inertia_kg_m2: Option<[f64; 3]>,
    ) -> Result<Self, BarError> {
        let centre_m = given_centre_m.unwrap_or(0.5 * length_m);
        let inertia_kg_m2 =
            given_inertia_kg_m2.unwrap_or_else(|| Self::slender_inertia(length_m, mass_kg));
        if !(length_m.is_finite() && length_m > 0.0) {
            return Err(BarError::Length(length_m));
        }
        if !(mass_kg.is_finite() && mass_kg >= 0.0) {
            return Err(BarError::Mass(mass_kg));
        }
        if !(0.0..=length_m).contains(&centre_m) {
            return Err(BarError::Centre { centre_m, length_m });
        }
        for moment_kg_m2 in inertia_kg_m2 {
            if !(moment_kg_m2.is_finite() && moment_kg_m2 >= 0.0) {
                return Err(BarError::Inertia(moment_kg_m2));
            }
        }
        let is_given = [given_centre_m.is_some(), given_inertia_kg_m2.is_some()];
        Ok(Self { length_m, mass_kg, centre_m, inertia_kg_m2, is_given })
    }

    /// A homogeneous slender bar: centre in the middle, moments `[0, m l²/12, m l²/12]`.
    ///
    /// # Errors
    /// [`BarError`] when the length or the mass is out of range, or so large that `m l²` is
    /// infinite.
    ///
    /// ```
    /// let bar = model::Bar::homogeneous(2.0, 3.0)?;
    /// assert_eq!(bar.centre_m(), 1.0);
    /// assert_eq!(bar.inertia_kg_m2(), [0.0, 1.0, 1.0]);
    /// # Ok::<(), model::BarError>(())
    /// ```
    pub fn homogeneous(length_m: f64, mass_kg: f64) -> Result<Self, BarError> {
        Self::given(length_m, mass_kg, None, None)
    }

    /// Principal central moments `[0, m l²/12, m l²/12]` of a homogeneous slender bar, kg m²: mass
    /// on a line has none about that line, and `∫ (s − l/2)² m/l ds` over `0 ≤ s ≤ l` about the
    /// others.
    ///
    /// This is also what a system file means that gives no moments, wherever it puts the centre of
    /// weight: a stand-in, since no equilibrium depends on them.
    ///
    /// ```
    /// assert_eq!(model::Bar::slender_inertia(2.0, 3.0), [0.0, 1.0, 1.0]);
    /// ```
    pub fn slender_inertia(length_m: f64, mass_kg: f64) -> [f64; 3] {
        let moment = mass_kg * length_m * length_m / 12.0;
        [0.0, moment, moment]
    }

    /// Length `l_i` between the joints, m.
    pub fn length_m(&self) -> f64 {
        self.length_m
    }

    /// Mass `m_i`, kg.
    pub fn mass_kg(&self) -> f64 {
        self.mass_kg
    }

    /// Distance `r_i` of the centre of weight from the first joint of the bar, m.
    pub fn centre_m(&self) -> f64 {
        self.centre_m
    }

    /// Principal central moments `J_x, J_y, J_z`, kg m²; x along the bar.
    pub fn inertia_kg_m2(&self) -> [f64; 3] {
        self.inertia_kg_m2
    }

    /// The centre of weight where it was given, and not left out for the middle, m.
    pub fn given_centre_m(&self) -> Option<f64> {
        self.is_given[0].then_some(self.centre_m)
    }

    /// The moments where they were given, and not left out for those of a slender bar, kg m².
    pub fn given_inertia_kg_m2(&self) -> Option<[f64; 3]> {
        self.is_given[1].then_some(self.inertia_kg_m2)
    }

    /// The same body longer or shorter, by the same factor for all lengths: every point stays at the same part of the length, so
    /// that the moments across, `∫ (s − r)² dm`, go with its square. The moment about the bar stays.
    pub(crate) fn scaled(&self, scale: impl Fn(f64) -> f64) -> Result<Self, BarError> {
        let length_m = scale(self.length_m);
        // The last place of it may be past the end by rounding.
        let centre_m = self.given_centre_m().map(|centre_m| scale(centre_m).min(length_m));
        let across = |moment: f64| scale(scale(moment));
        let inertia = self.given_inertia_kg_m2().map(|[x, y, z]| [x, across(y), across(z)]);
        Self::given(length_m, self.mass_kg, centre_m, inertia)
    }
}
