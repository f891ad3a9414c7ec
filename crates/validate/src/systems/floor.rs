//! The floor under a system: how strongly it pushes the joints of an answer.

use model::Vector;
use model::system::{Support, System, SystemEquilibrium};

use super::family::motions;
use numerics::vector::{cross, dot, norm, plus, times};

/// A direction that rises less than this is level: the floor cannot push along it.
const LEVEL: f64 = 1e-9;

/// What of a push straight up a joint's support leaves to it.
pub(super) fn rising(system: &System, joint: usize) -> Vector {
    rise(&motions(&system.joints()[joint].support))
}

/// What of a push straight up is along some directions.
fn rise(free: &[Vector]) -> Vector {
    free.iter().fold([0.0; 3], |sum, axis| plus(sum, times(axis[2], *axis)))
}

/// Orthonormal directions in which a joint may move on the floor.
pub(super) fn sliding(support: &Support) -> Vec<Vector> {
    let free = motions(support);
    let rising = rise(&free);
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
    let rising = rising(system, joint);
    let rate = dot(rising, rising);
    if rate <= LEVEL * LEVEL {
        return 0.0;
    }
    dot(answer.reactions_n[joint], rising) / rate
}

#[cfg(test)]
mod tests;
