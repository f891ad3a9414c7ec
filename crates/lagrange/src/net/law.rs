//! The laws of the members: elongation from force.
//!
//! A member that its ends pull with the force $F$ spans $d = (l + c\\,|F|)\\,F/|F|$ with the
//! compliance $c = l/EA$, if it is a bar in tension or a taut cable: the gradient of the
//! complementary energy $l\\,|F| + c\\,|F|^2/2$, which is convex. That has a corner at $F = 0$, where
//! a cable is slack and $d$ is anything shorter than $l$.

use nalgebra::{Matrix3, Vector3};

use super::framework::Link;

impl Link {
    /// Its length under a force of this size.
    pub fn stretched(&self, size: f64) -> f64 {
        self.length + self.compliance * size
    }
}

/// The symmetric matrix with the value `along` in a direction and `across` normal to it.
pub(super) fn by_direction(direction: &Vector3<f64>, across: f64, along: f64) -> Matrix3<f64> {
    let square = direction.norm_squared();
    let isotropic = Matrix3::identity() * across;
    if square == 0.0 {
        return isotropic;
    }
    isotropic + direction * direction.transpose() * ((along - across) / square)
}
