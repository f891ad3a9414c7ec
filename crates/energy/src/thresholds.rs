/// Rounding of a few sums and products: what is less than this part of its terms is nothing.
pub(crate) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Rounding that a step of Newton's method does not improve.
pub(crate) const STEP_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Rounding of an energy, or of a force, beside the largest.
pub(crate) const FORCE_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Least part of the predicted fall that counts as success.
pub(crate) const FAIR_PART: f64 = 0.1;

/// Part of the first-order fall of the energy that a step must bring (Armijo's rule).
pub(crate) const ARMIJO: f64 = 1e-4;

/// Where differences are near rounding, and with the factorisation of an earlier shape, a step must leave at most this part.
pub(crate) const PROGRESS: f64 = 0.5;

/// Smallest shift worth trying when none failed, in units of the mean gradient: it holds the mean
/// turn of the bars to a few radians.
pub(crate) const GRADIENT_PART: f64 = 0.25;

/// Turns, rad, and forces, lengths, energies, eigenvalues, singular values and components of unit vectors, over the largest:
/// what is known to this needs no word, and less is none.
pub(crate) const ZERO: f64 = 1e-9;

/// Diagonal added, over the size of the matrix, where a motion may meet no stiffness: far below what a
/// mechanism of a real structure has, far above rounding.
pub(crate) const RIDGE: f64 = 1e-9;

/// A strain, or a load over all of them, that is rounding.
pub(crate) const NO_STRAIN: f64 = 1e-12;

/// The golden section: its multiples are spread evenly, alike in every run.
pub(crate) const GOLDEN: f64 = 0.618_033_988_75;

/// Roundings of sums of some terms: below this part of its terms a number has lost all its digits. The gap of a chain of
/// many bars, each direction rounded, may not get below it.
pub(crate) const LOST: f64 = 16.0 * f64::EPSILON;

/// Closures, and forces over the largest, that are right to this need nothing more.
pub(crate) const SETTLED: f64 = 1e-13;

/// Corrections of the closure after a step, or steps of Newton's method for places and forces. Three to five are normal; a step
/// that needs more is too long.
pub(crate) const CORRECTIONS: usize = 12;

/// Bisections of an interval, or halvings of a step: all digits of a double; and trials of a shift, which grows by four.
pub(crate) const BISECTIONS: usize = 64;

/// Changes of the members that resist before it comes to no end, with the steps between them: some six in a tower of 500
/// members, as the energy of their springs falls with each.
pub(crate) const CHANGES: usize = 100;
