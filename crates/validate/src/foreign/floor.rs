//! Answers of others above a floor.

use model::system::{Joint, Support, System, SystemEquilibrium};
use model::{Place, Vector};

use super::best_forces::{PARALLEL, free_part, meeting};
use super::bounds::Bounds;
use super::violation::{Law, Measured, balances};
use numerics::vector::{dot, norm};

/// Upwards.
const UP: Vector = [0.0, 0.0, 1.0];

/// The system with every joint that lies on the floor held in its level too, and no floor: the
/// balances are those of this one, whichever way the floor pushes.
pub(super) fn laid(system: &System, joints_m: &[Vector], bounds: &Bounds) -> System {
    let Some(floor_m) = system.floor_m() else { return system.clone() };
    let support = |k: usize, joint: &Joint| {
        let [x, y, z] = joints_m[k];
        let lies = (z - floor_m).abs() <= bounds.position_m;
        let level = Support::Plane { at_m: [x, y, floor_m], normal: UP };
        if lies { meeting(joint.support, level) } else { joint.support }
    };
    // Of what was accepted only supports have changed, to good ones.
    let laid = system.on_supports(support, system.members().to_vec());
    laid.unwrap_or_else(|_| system.clone())
}

/// No joint is below the floor, and none is pulled by it.
pub(super) fn above_floor(
    system: &System,
    answer: &SystemEquilibrium,
    bounds: &Bounds,
    found: &mut Measured,
) {
    let Some(floor_m) = system.floor_m() else { return };
    let explained = balances(system, answer, None, bounds);
    for (k, joint) in system.joints().iter().enumerate() {
        if joint.support.is_fixed() {
            continue;
        }
        let below_m = floor_m - answer.joints_m[k][2];
        found.note(Place::Joint(k), Law::BelowFloor, below_m, bounds.position_m);
        // Along the way up that its support leaves free nothing but the floor holds a joint.
        let way = free_part(&joint.support, UP);
        let steep = norm(way);
        if steep > PARALLEL {
            let force_n = -dot(answer.reactions_n[k], way) / (steep * steep);
            let allowed = explained[k].1 / steep;
            found.note(Place::Joint(k), Law::FloorPulls { force_n }, force_n, allowed);
        }
    }
}

#[cfg(test)]
mod tests;
