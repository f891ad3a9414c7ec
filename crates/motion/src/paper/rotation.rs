//! Rotation and angular velocity of a bar.

use nalgebra::{Matrix3, Vector3};

/// `[A] = [ψ] [θ] [φ]` (1)-(5): columns are the axes of the bar in the world frame.
#[must_use]
pub fn rotation(angles: &Vector3<f64>) -> Matrix3<f64> {
    let [(sp, cp), (st, ct), (sf, cf)] = [angles.x, angles.y, angles.z].map(f64::sin_cos);
    Matrix3::new(1.0, 0.0, 0.0, 0.0, cp, -sp, 0.0, sp, cp)
        * Matrix3::new(ct, 0.0, st, 0.0, 1.0, 0.0, -st, 0.0, ct)
        * Matrix3::new(cf, -sf, 0.0, sf, cf, 0.0, 0.0, 0.0, 1.0)
}

/// `[Q]` (23): angular velocity in the axes of the bar from the velocities of the angles.
#[must_use]
pub fn rates(angles: &Vector3<f64>) -> Matrix3<f64> {
    let [(st, ct), (sf, cf)] = [angles.y, angles.z].map(f64::sin_cos);
    Matrix3::new(ct * cf, sf, 0.0, -ct * sf, cf, 0.0, st, 0.0, 1.0)
}

/// `[Q̇]`: derivative of (23) by time, 1/s.
#[must_use]
pub fn rates_derivative(angles: &Vector3<f64>, velocities: &Vector3<f64>) -> Matrix3<f64> {
    let [(st, ct), (sf, cf)] = [angles.y, angles.z].map(f64::sin_cos);
    let (t, f) = (velocities.y, velocities.z);
    Matrix3::new(
        -st * cf * t - ct * sf * f,
        cf * f,
        0.0,
        st * sf * t - ct * cf * f,
        -sf * f,
        0.0,
        ct * t,
        0.0,
        0.0,
    )
}
