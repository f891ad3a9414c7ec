//! Whether an equilibrium has derivatives by its parameters.
//!
//! The equations of module `derivatives` are smooth where every cable is either slack or bears a
//! force, and every joint is either above the floor or pushed by it; and they fix the change where
//! no motion is without stiffness and no self-stress is open. A span of a rope without length is a corner of
//! the sum of its spans. Elsewhere numbers that a
//! factorisation may give all the same are one of many, or those of one side.

use model::system::{Kind, RunTogether, System};

use super::floor::lift;
use super::framework::Framework;
use super::residual::Residual;
use super::solution::{NO_FORCE, Solution, limp};
use super::state::State;
use crate::error::Error;

/// Refuse an equilibrium without derivatives.
pub(super) fn check(
    system: &System,
    framework: &Framework,
    state: &State,
    residual: &Residual,
    solution: &Solution,
) -> Result<(), Error> {
    if let Some(jam) = solution.equilibrium.evidence.jams.first() {
        let mut spans = system.members()[jam.member].spans().skip(jam.span);
        let joints = spans.next().unwrap_or_default();
        let [from, to] = joints.map(|joint| system.joints()[joint].name.to_string());
        return Err(RunTogether { member: jam.member + 1, from, to }.into());
    }
    let motions = solution.equilibrium.stability.neutral;
    if motions > 0 {
        return Err(Error::FreeMotion { motions });
    }
    let stresses = solution.self_stresses.iter().flatten();
    let dimension = stresses.filter(|stress| moves(framework, stress)).count();
    if dimension > 0 {
        return Err(Error::OpenForces { dimension });
    }
    let largest = state.largest_force(framework);
    let mut limp = limp(framework, state, &residual.directions);
    if let Some(member) = limp.find(|member| framework.links[*member].kind != Kind::Bar) {
        return Err(Error::JustTaut { member: member + 1 });
    }
    let just_touches = touching(framework, state, residual, largest)
        .or_else(|| above(system, framework, solution));
    match just_touches.map(|joint| system.joints()[joint].name.to_string()) {
        Some(joint) => Err(Error::JustTouches { joint }),
        None => Ok(()),
    }
}

/// Whether a self-stress is in members whose ends can move.
fn moves(framework: &Framework, stress: &[f64]) -> bool {
    let borne = framework.links.iter().zip(stress);
    borne.filter(|(_, force)| force.abs() > NO_FORCE).any(|(link, _)| framework.moves(link))
}

/// The first joint that lies on the floor, which does not push it.
fn touching(
    framework: &Framework,
    state: &State,
    residual: &Residual,
    largest: f64,
) -> Option<usize> {
    let pushes = framework.pushes(&residual.directions, &state.axial);
    let mut lying = framework.lying.iter().zip(pushes);
    lying.find(|(_, push)| push.abs() <= NO_FORCE * largest).map(|(lying, _)| lying.joint)
}

/// The first joint that can rise and is at the height of the floor, without lying on it.
fn above(system: &System, framework: &Framework, solution: &Solution) -> Option<usize> {
    let floor_m = system.floor_m()?;
    let near_m = NO_FORCE * framework.units.length_m;
    let heights = solution.equilibrium.joints_m.iter().map(|at_m| at_m[2] - floor_m);
    let mut free = heights.enumerate().filter(|(joint, _)| {
        lift(&framework.nodes[*joint]).is_some()
            && framework.lying.iter().all(|lying| lying.joint != *joint)
    });
    free.find(|(_, height_m)| height_m.abs() <= near_m).map(|(joint, _)| joint)
}
