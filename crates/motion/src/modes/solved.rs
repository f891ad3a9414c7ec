//! What is found of the eigenproblem in a sector.

/// A mode whose energy is less than this part of what the members' parts amount to is rounding of a
/// zero.
pub(super) const ZERO: f64 = 1e-10;

/// Solutions of one sector, ascending: all of them, or the lowest.
#[derive(Default)]
pub(super) struct Solved {
    /// `ω²`, ascending, 1/s².
    pub omega2: Vec<f64>,
    /// Which of them are rounding of a zero.
    pub zero: Vec<bool>,
    /// Within this of each `ω²` there is one, but for rounding, 1/s².
    pub residual: Vec<f64>,
    /// Displacements of the coordinates, orthonormal in the metric of the inertia.
    pub shapes: Vec<Vec<f64>>,
    /// Number of all modes of the sector, found or not.
    pub total: usize,
    /// Number of all with `ω² < 0`.
    pub negative: usize,
}
