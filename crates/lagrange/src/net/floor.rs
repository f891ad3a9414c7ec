//! A flat floor without friction, by the set of joints that lie on it.
//!
//! The floor pushes a joint up and lets it slide: $z_j \ge h$, $N_j \ge 0$ and $N_j (z_j - h) = 0$.
//! Joints that are known to lie on it have one freedom less each, and the system is solved as any
//! other. Then joints below the floor are laid down, those that it would have to pull are lifted,
//! until no sign is wrong: a primal-dual active set method. What pulls a joint off the floor lifts
//! its neighbours with it, as many as it can bear; a joint at the edge of what lies tells how many
//! that are, so that a line of many members takes few rounds.
//!
//! M. Hintermueller, K. Ito and K. Kunisch, SIAM J. Optim. 13 (2002) 865-888,
//! doi:10.1137/S1052623401383558

use std::collections::VecDeque;

use model::system::{System, SystemEquilibrium};
use nalgebra::Vector3;

use super::decided::{Decided, SHARP};
use super::framework::{Framework, Lying, Node, across};
use super::residual::Residual;
use super::second_order::{SecondOrder, self_stresses};
use super::seed::Seed;
use super::settings::Settings;
use super::solution::{Found, NO_FORCE, Solution};
use super::state::State;
use super::stiffness::Stiffness;
use crate::error::Error;
use crate::thresholds::{CLOSURE_ROUNDING, LOOSE, MISDRAWN, ZERO};

/// Rounds in all, and those in which neighbours are lifted as well: then joints one by one, which
/// ends where the estimate of how many are lifted goes to and fro.
const ROUNDS: usize = 200;
const TOGETHER: usize = 30;

/// What of a push straight up moves a joint: its free part; nothing where it moves level alone.
pub(super) fn lift(node: &Node) -> Option<Vector3<f64>> {
    let free = node.free.part(&Vector3::z());
    (free.norm() > ZERO).then_some(free)
}

/// A joint that lies on a floor at this height.
fn laid(node: &Node, floor: f64) -> Node {
    let Some(free) = lift(node) else { return node.clone() };
    let base = raised(node, &node.base, floor);
    // What is left of the free directions normal to the rising one.
    Node { base, free: node.free.within(across(&free.normalize())), load: node.load }
}

/// Force of the floor on a joint, N.
fn push_n(node: &Node, reaction_n: [f64; 3]) -> f64 {
    lift(node).map_or(0.0, |rise| Lying { joint: 0, rise }.push(&reaction_n.into()))
}

impl Framework {
    /// Height of the floor in units, if there is one.
    pub fn floor(&self, system: &System) -> Option<f64> {
        system.floor_m().map(|floor_m| (floor_m - self.units.origin_m.z) / self.units.length_m)
    }

    /// The framework with these joints on the floor.
    pub fn with_laid(&self, floor: f64, lies: &[bool]) -> Self {
        let mut framework = self.clone();
        for (joint, node) in framework.nodes.iter_mut().enumerate().filter(|(k, _)| lies[*k]) {
            framework.lying.extend(lift(node).map(|rise| Lying { joint, rise }));
            *node = laid(node, floor);
        }
        framework
    }

    /// The framework of an answer: the joints that the floor pushes, or may push, lie on it.
    pub fn of(system: &System, solution: &Solution) -> Self {
        let framework = Self::new(system);
        let Some(floor) = framework.floor(system) else { return framework };
        let answer = &solution.equilibrium;
        let least = NO_FORCE * largest_n(&framework, answer);
        let nodes = framework.nodes.iter().zip(&answer.reactions_n);
        let lies: Vec<bool> = nodes.map(|(node, force)| push_n(node, *force) > least).collect();
        let open = open_pushes(system, &framework, floor, &lies, solution);
        framework.with_laid(floor, &open.unwrap_or(lies))
    }
}

/// The joints that lie on the floor and those that just touch it and may press on it: with these
/// laid down there are more self-stresses. Nothing where there are not.
fn open_pushes(
    system: &System,
    framework: &Framework,
    floor: f64,
    lies: &[bool],
    solution: &Solution,
) -> Option<Vec<bool>> {
    let floor_m = system.floor_m()?;
    // What iterations leave of lengths adds to the rounding.
    let depth_m = rounding_m(&solution.equilibrium.joints_m, floor_m)
        + solution.residual * framework.units.length_m;
    let joints = framework.nodes.iter().zip(&solution.equilibrium.joints_m);
    let touches = joints.zip(lies).map(|((node, at_m), lies)| {
        *lies || ((floor_m - at_m[2]).abs() <= depth_m && lift(node).is_some())
    });
    let touches: Vec<bool> = touches.collect();
    if touches == lies || solution.self_stresses.is_none() {
        return None;
    }
    let laid = framework.with_laid(floor, &touches);
    let state = State::of(&laid, solution);
    let directions = state.directions(&laid);
    let mut open = lies.to_vec();
    for stress in self_stresses(&laid, &state) {
        for (lying, push) in laid.lying.iter().zip(laid.pushes_of_stress(&directions, &stress)) {
            open[lying.joint] |= push.abs() > ZERO;
        }
    }
    (open != lies).then_some(open)
}

/// The answer with the forces that the floor leaves open where joints just touch it.
fn with_open_pushes(
    system: &System,
    framework: &Framework,
    floor: f64,
    lies: &[bool],
    settings: &Settings,
    solution: Solution,
) -> Result<Solution, Error> {
    let jams = !solution.equilibrium.evidence.jams.is_empty();
    let open = open_pushes(system, framework, floor, lies, &solution);
    let Some(open) = open.filter(|_| !jams) else { return Ok(solution) };
    let laid = framework.with_laid(floor, &open);
    let state = State::of(&laid, &solution);
    let mut stiffness = Stiffness::new(&laid, false)?;
    let second_order = SecondOrder::new(&laid, &mut stiffness, &state, settings.dense_freedoms);
    let mut decided = Decided::new(&laid, &state, SHARP)?;
    let found = Found {
        residual: Residual::within(&laid, &state, Some(&mut decided)),
        state,
        tolerance: settings.tolerance,
        factorisations: solution.factorisations,
        second_order,
        least: false,
        solve_s: solution.equilibrium.evidence.solve_s,
    };
    Ok(Solution::new(system, &laid, found))
}

/// How far, m, a joint on the floor may be from its height: some roundings of the largest coordinate.
fn rounding_m(joints_m: &[[f64; 3]], floor_m: f64) -> f64 {
    let most = joints_m.iter().flatten().fold(floor_m.abs(), |most, x| most.max(x.abs()));
    2.0 * CLOSURE_ROUNDING * most
}

/// Largest force of a member or load, N.
fn largest_n(framework: &Framework, answer: &SystemEquilibrium) -> f64 {
    let loads = framework.nodes.iter().map(|node| node.load.norm() * framework.units.force_n);
    answer.axial_n.iter().map(|axial| axial.abs()).chain(loads).fold(0.0, f64::max)
}

/// Solve above the floor, if there is one, by solving with joints that lie on it. `begin` are those
/// of the first round.
pub(super) fn above(
    system: &System,
    framework: Framework,
    begin: Option<Vec<bool>>,
    settings: &Settings,
    mut solve: impl FnMut(Framework) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let Some(floor) = framework.floor(system) else { return solve(framework) };
    let mut lies = begin.unwrap_or_else(|| vec![false; framework.nodes.len()]);
    let mut factorisations = 0;
    for round in 0..ROUNDS {
        let mut solution = solve(framework.with_laid(floor, &lies))?;
        factorisations += solution.factorisations;
        let next = mended(system, &framework, &solution.equilibrium, &lies, round < TOGETHER);
        if next == lies {
            solution.factorisations = factorisations;
            return with_open_pushes(system, &framework, floor, &lies, settings, solution);
        }
        lies = next;
    }
    Err(Error::Floor { rounds: ROUNDS })
}

/// Whether there may be an equilibrium with other joints on the floor.
pub(super) fn catches(error: &Error) -> bool {
    use Error::{Escapes, Floor, HeldMisfit, Jammed, Misfit, NotConverged, Unstable};
    matches!(
        error,
        Escapes { .. }
            | Floor { .. }
            | HeldMisfit { .. }
            | Jammed(_)
            | Misfit { .. }
            | NotConverged { .. }
            | Unstable { .. }
    )
}

/// The place raised to this height, as far as its support lets it rise.
pub(super) fn raised(node: &Node, place: &Vector3<f64>, floor: f64) -> Vector3<f64> {
    lift(node).map_or(*place, |free| place + free * ((floor - place.z) / free.norm_squared()))
}

/// Which joints of a drawing lie below the floor or on it: a drawing is as close to the floor as it is to the lengths of the
/// members. At rest it is close to rounding.
pub(super) fn below(system: &System, framework: &Framework, seed: &Seed) -> Vec<bool> {
    let (Some(floor), Some(floor_m)) = (framework.floor(system), system.floor_m()) else {
        return vec![false; framework.nodes.len()];
    };
    let places: Vec<Vector3<f64>> =
        seed.joints_m.iter().map(|at_m| framework.units.place(*at_m)).collect();
    let span = |span: usize| framework.links[span].span(&places).norm();
    let misfit = |k: usize| (framework.whole(k, span) / framework.links[k].length - 1.0).abs();
    let misfits = (0..framework.members()).map(misfit).filter(|part| *part <= LOOSE);
    let misdrawn = if seed.at_rest { 0.0 } else { misfits.fold(MISDRAWN, f64::max) };
    let mut shortest = vec![f64::INFINITY; places.len()];
    for (k, link) in framework.links.iter().enumerate() {
        for joint in [link.from, link.to] {
            shortest[joint] = span(k).min(shortest[joint]);
        }
    }
    let least = rounding_m(&seed.joints_m, floor_m) / framework.units.length_m;
    let joints = framework.nodes.iter().zip(&places).zip(shortest);
    let lies = joints.map(|((node, place), shortest)| {
        place.z <= floor + least.max(misdrawn * shortest) && lift(node).is_some()
    });
    lies.collect()
}

/// The joints that lie on the floor in the next round.
fn mended(
    system: &System,
    framework: &Framework,
    answer: &SystemEquilibrium,
    lies: &[bool],
    together: bool,
) -> Vec<bool> {
    let floor_m = system.floor_m().unwrap_or(f64::NEG_INFINITY);
    let depth_m = rounding_m(&answer.joints_m, floor_m);
    let least_n = NO_FORCE * largest_n(framework, answer);
    let mut next = lies.to_vec();
    let mut pulled = Vec::new();
    for (k, node) in framework.nodes.iter().enumerate() {
        if lies[k] {
            let push_n = push_n(node, answer.reactions_n[k]);
            if push_n < -least_n {
                pulled.push((k, -push_n));
            }
        } else if floor_m - answer.joints_m[k][2] > depth_m && lift(node).is_some() {
            next[k] = true;
        }
    }
    let mut neighbours = vec![Vec::new(); if together { lies.len() } else { 0 }];
    if together && !pulled.is_empty() {
        for link in &framework.links {
            neighbours[link.from].push(link.to);
            neighbours[link.to].push(link.from);
        }
    }
    for (joint, force_n) in pulled {
        next[joint] = false;
        if together {
            lift_neighbours(framework, &neighbours, &mut next, joint, force_n);
        }
    }
    next
}

/// Lift what lies next to a joint, until its weight comes to this force.
fn lift_neighbours(
    framework: &Framework,
    neighbours: &[Vec<usize>],
    lies: &mut [bool],
    joint: usize,
    force_n: f64,
) {
    let mut left = force_n / framework.units.force_n;
    let mut queue = VecDeque::from([joint]);
    while let Some(joint) = queue.pop_front() {
        for &next in &neighbours[joint] {
            let weight = -framework.nodes[next].load.z;
            if lies[next] && weight > 0.0 && left >= weight {
                left -= weight;
                lies[next] = false;
                queue.push_back(next);
            }
        }
    }
}

#[cfg(test)]
mod tests;
