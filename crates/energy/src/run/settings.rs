//! What the caller may choose.

use crate::error::Error;

/// The motions among which the energy is minimised.
///
/// ```
/// use energy::{Motion, Seed, Settings, minimise_from};
/// let problem = model::cases::paper();
/// // In the plane the mirror image of the hanging shape is a minimum of its own.
/// let seed = Seed::angles(&problem, &[-0.3, -0.7, 1.3])?;
/// let plane = Settings { motion: Motion::Plane, ..Settings::default() };
/// let [x, y, _] = minimise_from(&problem, &seed, &plane)?.directions[0];
/// assert!(x.abs() < 1e-15);
/// assert!((y - (-19.694_867_976_133_f64).to_radians().sin()).abs() < 1e-12);
/// # Ok::<(), energy::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Motion {
    /// All motions. Every local minimum of a chain in space is its global one.
    #[default]
    Space,
    /// Motions in the vertical plane of the anchors (with anchors on one vertical: in the plane
    /// *OYZ*, the paper's choice). Here a chain may have several local minima,
    /// and one that can also close on a straight line may get stuck there, which is an error.
    Plane,
}

/// How to minimise. Valid settings come from [`Default`] and pass [`Settings::validate`].
///
/// ```
/// let settings = energy::Settings { max_iterations: 50, ..Default::default() };
/// assert!(settings.validate().is_ok());
/// assert!(energy::Settings { max_iterations: 0, ..settings }.validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Largest force across a bar that counts as none: the largest over the bars of
    /// `|(I - u uᵀ) a_i|`, `a_i` being the gradient of the Lagrangian by the direction of bar *i*
    /// over its length, in units of the total weight or, where the chain pulls harder than it
    /// weighs, of the largest `|a_i|`. Where rounding leaves more, the run ends at the rounding and
    /// says so in the residual: bars at an angle `a` to one common line hold the closure no better
    /// than a rounding over `a`. Default 1e-12; from 1e-15 to 1e-3.
    pub gradient_tolerance: f64,
    /// Largest distance of the last joint from the end anchor, in units of the total length, or of
    /// the power of two below it in metres, in which the solver works. Default 1e-13; from 1e-15 to
    /// 1e-6.
    pub closure_tolerance: f64,
    /// Iterations of one run of the minimiser. Default 500; at least 1.
    pub max_iterations: u64,
    /// The motions to minimise over. Default: in space.
    pub motion: Motion,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            gradient_tolerance: 1e-12,
            closure_tolerance: 1e-13,
            max_iterations: 500,
            motion: Motion::Space,
        }
    }
}

impl Settings {
    /// Check every range once.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with the first field that is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        let check = Error::unless_within;
        check("gradient_tolerance", self.gradient_tolerance, 1e-15, 1e-3)?;
        check("closure_tolerance", self.closure_tolerance, 1e-15, 1e-6)?;
        check("max_iterations", self.max_iterations as f64, 1.0, u64::MAX as f64)
    }
}
