//! The inertia of a member in the places of its two ends.

use model::Bar;

/// Mass matrix of a member for one axis, kg: kinetic energy `½ (a v_a² + 2 b v_a v_b + c v_b²)`,
/// summed over the three axes.
///
/// A point at the fraction `s` of a straight member moves with `(1 − s) v_a + s v_b`. Its mass `m`
/// with the centre at the fraction `r/l`, and the moment `J` about the centre across the member,
/// therefore give
///
/// $$ a = \frac{m (l-r)^2 + J}{l^2}, \qquad b = \frac{m r (l-r) - J}{l^2}, \qquad
///    c = \frac{m r^2 + J}{l^2}. $$
///
/// The matrix is constant: no rotation, no angle, no velocity-dependent force enters. For a rigid
/// bar the relative velocity of the ends is across the bar, so that `J` counts once for each axis
/// across it; for a member that stretches, `J = ∫ (s − r)² dm` is what the same formula asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndInertia {
    /// `a`: first end with itself, kg.
    pub from: f64,
    /// `b`: first end with second end, kg; negative where the ends are heavy.
    pub between: f64,
    /// `c`: second end with itself, kg.
    pub to: f64,
}

impl EndInertia {
    /// The matrix of a bar whose two moments across are equal (`J_y = J_z`; `J_y` is taken).
    ///
    /// ```
    /// // A homogeneous bar: m/6 [[2, 1], [1, 2]].
    /// let m = motion::EndInertia::new(&model::Bar::homogeneous(2.0, 6.0)?);
    /// assert!((m.from - 2.0).abs() < 1e-15 && (m.between - 1.0).abs() < 1e-15);
    /// assert!((m.to - 2.0).abs() < 1e-15);
    /// # Ok::<(), model::BarError>(())
    /// ```
    pub fn new(bar: &Bar) -> Self {
        Self::with_moment(bar, bar.inertia_kg_m2()[1])
    }

    /// The matrix with another moment across, kg m².
    pub(crate) fn with_moment(bar: &Bar, moment_kg_m2: f64) -> Self {
        let (l, m) = (bar.length_m(), bar.mass_kg());
        let to_centre = bar.centre_m() / l;
        let from_centre = (l - bar.centre_m()) / l;
        let j = moment_kg_m2 / l / l;
        Self {
            from: m * from_centre * from_centre + j,
            between: m * to_centre * from_centre - j,
            to: m * to_centre * to_centre + j,
        }
    }
}
