//! Answers of others above a floor.

use model::Place;
use model::system::{Joint, Support, System, SystemEquilibrium};

use super::bounds::Bounds;
use super::violation::{Law, Measured, balances};

/// The system with every free joint that lies on the floor held in its level, and no floor: the
/// laws of lengths and balances are those of this one, whichever way the floor pushes.
pub(super) fn laid(system: &System, joints_m: &[[f64; 3]], bounds: &Bounds) -> System {
    let Some(floor_m) = system.floor_m() else { return system.clone() };
    let joint = |(joint, at_m): (&Joint, &[f64; 3])| {
        let lies = (at_m[2] - floor_m).abs() <= bounds.position_m;
        let support = match joint.support {
            Support::Free if lies => {
                Support::Plane { at_m: [at_m[0], at_m[1], floor_m], normal: [0.0, 0.0, 1.0] }
            }
            other => other,
        };
        Joint { support, ..joint.clone() }
    };
    let joints = system.joints().iter().zip(joints_m).map(joint).collect();
    let members = system.members().to_vec();
    // Of what was accepted only supports have changed, to good ones.
    System::new(system.name(), system.gravity_m_s2(), joints, members)
        .unwrap_or_else(|_| system.clone())
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
        if joint.support == Support::Free {
            let push_n = answer.reactions_n[k][2];
            found.note(
                Place::Joint(k),
                Law::FloorPulls { force_n: -push_n },
                -push_n,
                explained[k].1,
            );
        }
    }
}

#[cfg(test)]
mod tests;
