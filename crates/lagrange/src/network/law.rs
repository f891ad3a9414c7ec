//! The laws of the members: elongation from force.
//!
//! A member that its ends pull with the force $F$ spans $d = E(F)$. For a bar in tension, or a taut
//! cable, $E(F) = (l + c\,|F|)\,F/|F|$ with the compliance $c = l/EA$: the gradient of the
//! complementary energy $l\,|F| + c\,|F|^2/2$, which is convex. It has a corner at $F = 0$, where a
//! cable is slack and $d$ is anything shorter than $l$. With $|F|$ rounded off to
//! $R = \sqrt{|F|^2 + \mu^2}$ it is smooth, and the limit $\mu \to 0$ is the cable.

use nalgebra::{Matrix3, Vector3};

use super::framework::Link;

/// The smooth law of a member in tension at one force.
pub(super) struct Tension {
    /// Span $E(F)$ that goes with the force.
    pub span: Vector3<f64>,
    /// The inverse of $\partial E/\partial F$: what the force gains with the span.
    pub stiffness: Matrix3<f64>,
}

impl Tension {
    /// The law rounded off by `mu`.
    pub fn new(link: &Link, force: &Vector3<f64>, mu: f64) -> Self {
        let rounded = force.norm_squared() + mu * mu;
        let root = rounded.sqrt();
        // Across the force, and along it.
        let across = link.length / root + link.compliance;
        let along = link.length * mu * mu / (rounded * root) + link.compliance;
        Self { span: force * across, stiffness: by_direction(force, across.recip(), along.recip()) }
    }

    /// The span alone.
    pub fn span(link: &Link, force: &Vector3<f64>, mu: f64) -> Vector3<f64> {
        force * (link.length / (force.norm_squared() + mu * mu).sqrt() + link.compliance)
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
