//! The multipliers: a first estimate of three of them, and all of them from these three.

use matrices::dense::solve_three;
use nalgebra::{DVector, Matrix3, Vector3};

use crate::full::mechanism::Mechanism;
use crate::full::point::Point;

/// Weight of the preference for equal reactions in the estimate: small against the lengths (their
/// sum is 1), large against rounding. It decides only when all bars are parallel.
pub(crate) const REGULARISATION: f64 = 1e-10;

/// The pull of the first anchor for which the moments are least,
/// $\sum l_i |(1 - u_i u_i^T)(p_0 + c_i e_z)|^2 \to \min$: linear in three unknowns, and in the
/// world frame, so that it does not depend on the angles that describe a direction.
pub(crate) fn estimate_pull(mechanism: &Mechanism, carried: &[f64], point: &Point) -> Vector3<f64> {
    let half = Vector3::new(0.0, 0.0, -0.5);
    let mut matrix = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for ((bar, length), weight) in point.bars.iter().zip(&mechanism.lengths).zip(carried) {
        let across = (Matrix3::identity() - bar.u * bar.u.transpose()) * *length;
        matrix += across;
        right -= across.column(2) * *weight;
    }
    let closed = (matrix + Matrix3::identity() * REGULARISATION).into();
    let solve = |right: Vector3<f64>| solve_three(&closed, right.into()).map(Vector3::from);
    let Some(first) = solve(right + half * REGULARISATION) else { return half };
    // One refinement takes the preference out again wherever the bars have a say.
    first + solve(right - matrix * first).unwrap_or_default()
}

/// All 3(n+1) multipliers from the first three, by the rows of the centres in (40): the force of
/// the rest of the chain on the bars up to joint k is the pull plus their weight. Only the sign of
/// the first differs, because the paper writes (7)-(9) the other way round.
pub(crate) fn all_multipliers(mechanism: &Mechanism, pull: &Vector3<f64>) -> DVector<f64> {
    let mut lambda = DVector::zeros(mechanism.constraints());
    lambda.fixed_rows_mut::<3>(0).copy_from(&-pull);
    let mut force = *pull;
    for (bar, weight) in mechanism.weights.iter().enumerate() {
        force.z += weight;
        lambda.fixed_rows_mut::<3>(3 * (bar + 1)).copy_from(&force);
    }
    lambda
}
