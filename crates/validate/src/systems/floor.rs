//! The floor under a system: how strongly it pushes the joints of an answer.

use model::Vector;
use model::system::{Support, System, SystemEquilibrium};

use numerics::vector::{cross, dot, norm, times};

/// What a push straight up is along.
pub(super) const UP: Vector = [0.0, 0.0, 1.0];

/// A direction that rises less than this is level: the floor cannot push along it.
const LEVEL: f64 = 1e-9;

/// Orthonormal directions in which a joint may move on the floor.
pub(super) fn sliding(support: &Support) -> Vec<Vector> {
    let free = support.motions();
    let rising = support.free_part(UP);
    match free[..] {
        _ if norm(rising) <= LEVEL => free,
        [a, b, _] => vec![a, b],
        [a, b] => vec![cross(cross(a, b), times(1.0 / norm(rising), rising))],
        _ => vec![],
    }
}

/// Force of the floor on a joint of an answer, up positive, N. Of the force of the ground there the
/// support can bear only what is normal to the motions that it leaves free, and the floor only what
/// is straight up.
pub(super) fn push_n(system: &System, answer: &SystemEquilibrium, joint: usize) -> f64 {
    if system.floor_m().is_none() {
        return 0.0;
    }
    let rising = system.joints()[joint].support.free_part(UP);
    let rate = dot(rising, rising);
    if rate <= LEVEL * LEVEL {
        return 0.0;
    }
    dot(answer.reactions_n[joint], rising) / rate
}

#[cfg(test)]
mod tests;
