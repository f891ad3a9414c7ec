//! Answers of others above a floor.

use model::system::{Joint, System};
use model::{Place, Vector};

use super::bounds::Bounds;
use super::violation::{Held, Law, Measured};
use numerics::vector::norm;

/// Upwards.
const UP: Vector = [0.0, 0.0, 1.0];

/// The system with every joint that lies on the floor held in its level too, and no floor: the
/// balances are those of this one, whichever way the floor pushes.
pub(super) fn laid(system: &System, joints_m: &[Vector], bounds: &Bounds) -> System {
    let Some(floor_m) = system.floor_m() else { return system.clone() };
    let lies = |k: usize, _: &Joint| (joints_m[k][2] - floor_m).abs() <= bounds.position_m;
    // Of what was accepted only supports have changed, to good ones.
    let laid = system.laid(joints_m, lies, system.members().to_vec());
    laid.unwrap_or_else(|_| system.clone())
}

impl Held<'_> {
    /// No joint is below the floor, and none is pulled by it.
    pub(super) fn above_floor(&self, found: &mut Measured) {
        let Self { system, answer, bounds } = *self;
        let Some(floor_m) = system.floor_m() else { return };
        let explained = self.balances(None);
        for (k, joint) in system.joints().iter().enumerate() {
            if joint.support.is_fixed() {
                continue;
            }
            let below_m = floor_m - answer.joints_m[k][2];
            found.note(Place::Joint(k), Law::BelowFloor, below_m, bounds.position_m);
            // Along the way up that its support leaves free nothing but the floor holds a joint.
            if let Some(up_n) = joint.support.upright_part(answer.reactions_n[k]) {
                let (force_n, steep) = (-up_n, norm(joint.support.free_part(UP)));
                let allowed = explained[k].1 / steep;
                found.note(Place::Joint(k), Law::FloorPulls { force_n }, force_n, allowed);
            }
        }
    }
}

#[cfg(test)]
mod tests;
