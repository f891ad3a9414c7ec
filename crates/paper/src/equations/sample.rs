//! Random states and numeric derivatives.

use std::f64::consts::PI;

use nalgebra::{DMatrix, Dim, Matrix, Matrix3, RawStorage, Rotation3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Random states per equation.
const STATES: usize = 1000;

/// Any fixed number: the audit is to be the same each time.
const SEED: u64 = 41;

/// Step of the stencils, in units of the time in which an angle changes by at most 1 rad.
/// Truncation (its sixth power) and rounding (its inverse square, in the second derivative) are
/// both near 1e-11.
const STEP: f64 = 1e-2;

/// Largest residual, by magnitude, over the random states; NaN if one is.
pub(super) fn worst(mut residual: impl FnMut(&mut ChaCha8Rng) -> f64) -> f64 {
    let mut rng = ChaCha8Rng::seed_from_u64(SEED);
    largest((0..STATES).map(|_| residual(&mut rng)))
}

/// Largest magnitude; NaN if one is (`f64::max` would lose it).
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| {
        if most.is_nan() || value.is_nan() { f64::NAN } else { most.max(value.abs()) }
    })
}

/// Largest entry of a matrix.
pub(super) trait LargestEntry {
    /// Largest magnitude; NaN if one is (nalgebra's `amax` would lose it).
    fn largest_entry(&self) -> f64;
}

impl<R: Dim, C: Dim, S: RawStorage<f64, R, C>> LargestEntry for Matrix<f64, R, C, S> {
    fn largest_entry(&self) -> f64 {
        largest(self.iter().copied())
    }
}

/// Three angles psi, theta, phi anywhere.
pub(super) fn angles(rng: &mut ChaCha8Rng) -> [f64; 3] {
    std::array::from_fn(|_| rng.random_range(-PI..PI))
}

/// Three positive numbers of order 1, for lengths or moments.
pub(super) fn positive(rng: &mut ChaCha8Rng) -> [f64; 3] {
    std::array::from_fn(|_| rng.random_range(0.5..1.5))
}

/// Three numbers of either sign, of order 1, for velocities.
pub(super) fn signed(rng: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0))
}

/// Rotation by psi about x, then theta about the turned y, then phi about the turned z: nalgebra's
/// own, for none of the formulas of the paper.
pub(super) fn rotation([psi, theta, phi]: [f64; 3]) -> Matrix3<f64> {
    let turn = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
    (turn(Vector3::x_axis(), psi) * turn(Vector3::y_axis(), theta) * turn(Vector3::z_axis(), phi))
        .into_inner()
}

/// The angles at time `t` of a motion with constant rates.
pub(super) fn at(angles: [f64; 3], rates: &Vector3<f64>, t: f64) -> [f64; 3] {
    std::array::from_fn(|k| angles[k] + rates[k] * t)
}

/// First derivative at 0, central differences of sixth order.
pub(super) fn derivative(f: &dyn Fn(f64) -> DMatrix<f64>) -> DMatrix<f64> {
    let odd = |k: f64| f(k * STEP) - f(-k * STEP);
    (odd(1.0) * (3.0 / 4.0) - odd(2.0) * (3.0 / 20.0) + odd(3.0) / 60.0) / STEP
}

/// Second derivative at 0, central differences of sixth order.
pub(super) fn second_derivative(f: &dyn Fn(f64) -> DMatrix<f64>) -> DMatrix<f64> {
    let even = |k: f64| f(k * STEP) + f(-k * STEP);
    (even(1.0) * 1.5 - even(2.0) * (3.0 / 20.0) + even(3.0) / 90.0 - f(0.0) * (49.0 / 18.0))
        / (STEP * STEP)
}

/// A 3 × 3 matrix of any size, as the stencils want it.
pub(super) fn dynamic(matrix: &Matrix3<f64>) -> DMatrix<f64> {
    DMatrix::from_column_slice(3, 3, matrix.as_slice())
}

/// Back to a 3 × 3 matrix.
pub(super) fn three_by_three(matrix: &DMatrix<f64>) -> Matrix3<f64> {
    matrix.fixed_view::<3, 3>(0, 0).into_owned()
}
