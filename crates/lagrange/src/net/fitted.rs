//! Axial forces fitted to a shape, to begin with.
//!
//! Rigid members: the forces that leave the joints least out of balance, of these the least. With
//! elastic ones: the least complementary energy $\\sum c\\,(N - N_0)^2/2$ of forces in balance, where
//! $N_0$ is what a member bears at the length that it has in the shape; so a prestress stays what it
//! is, and what does not fit is relaxed. Both are one solve with $\\sum k\\, u u^T$, $k = 1/c$, and as many more as
//! it takes until cables pull and struts push.

use nalgebra::Vector3;

use super::framework::{Framework, Link};
use super::signs::SIGN_CHANGES;
use super::state::State;
use super::stiffness::Stiffness;
use crate::thresholds::{HALVINGS, ZERO};

/// Stiffness that stands for a rigid member, in units of the stiffest elastic one.
pub(super) const RIGID: f64 = 1e3;
/// Ridge of the least squares, in units of the stiffness.
const RIDGE: f64 = 1e-9;
/// Stiffness of what is slack, over its own, until the signs are found: far more than the ridge.
const SLACK: f64 = 1e-5;

/// Forces fitted to the places of a state, of its taut members.
pub(super) fn fitted_forces(
    framework: &Framework,
    stiffness: &mut Stiffness,
    state: &State,
) -> Vec<f64> {
    let directions = state.directions(framework);
    let elastic = |link: &Link| (link.compliance > 0.0).then(|| link.compliance.recip());
    let stiffest = framework.links.iter().filter_map(elastic).fold(0.0, f64::max);
    let rigid = if stiffest > 0.0 { RIGID * stiffest } else { 1.0 };
    let member = |(k, link): (usize, &Link)| {
        if !state.taut[k] {
            return (0.0, 0.0);
        }
        let Some(along) = elastic(link) else { return (rigid, 0.0) };
        let length = framework.whole(k, |span| directions[span].1);
        (along, (length - link.length) * along)
    };
    let members: Vec<(f64, f64)> = framework.links.iter().enumerate().map(member).collect();
    let bears =
        |k: usize, force: f64| state.taut[k] && (force == 0.0 || framework.links[k].bears(force));
    let own: Vec<f64> = members.iter().map(|(_, own)| *own).collect();
    let (mut forces, mut bearing) = (own.clone(), state.taut.clone());
    let ridge = RIDGE * rigid;
    let still = vec![Vector3::zeros(); framework.nodes.len()];
    let (mut moved, mut slack) = (still.clone(), 0.0);
    for round in 0..2 * SIGN_CHANGES {
        // All signs at once, each time from the beginning, may go round in circles: then step by step.
        let is_circling = round >= SIGN_CHANGES;
        if round <= SIGN_CHANGES {
            (forces, moved) = (own.clone(), still.clone());
        }
        if round == SIGN_CHANGES {
            bearing = (0..members.len()).map(|k| bears(k, own[k])).collect();
        }
        let along = |k: usize| members[k].0 * if bearing[k] { 1.0 } else { slack };
        stiffness.assemble_members(framework, |k| (directions[k].0, 0.0, along(k)));
        stiffness.shift(ridge);
        stiffness.factorise_definite();
        let borne = |k: usize| if bearing[k] { forces[k] } else { 0.0 };
        let mut left =
            framework.unbalance(directions.iter().enumerate().map(|(k, (u, _))| u * borne(k)));
        left.iter_mut().zip(&moved).for_each(|(left, by)| *left -= by * ridge);
        let moves = stiffness.moves(framework, &left);
        let stretch = |span: usize| directions[span].0.dot(&framework.links[span].span(&moves));
        let change: Vec<f64> =
            (0..members.len()).map(|k| members[k].0 * framework.whole(k, stretch)).collect();
        // As far as the dual energy, which is convex, falls.
        let work: f64 = left.iter().zip(&moves).map(|(left, by)| left.dot(by)).sum();
        let held: f64 = moves.iter().map(|by| ridge * by.dot(by)).sum();
        let slope = |part: f64| {
            let more = (0..members.len()).filter(|k| change[*k] != 0.0).map(|k| {
                let force = forces[k] + part * change[k];
                let there = if bears(k, force) { force } else { 0.0 };
                (there - borne(k)) * change[k] / members[k].0
            });
            more.sum::<f64>() + part * held - work
        };
        let (mut least, mut part) = (0.0, 1.0);
        if is_circling && slope(part) > ZERO * work {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (least + part);
                if slope(middle) > 0.0 { part = middle } else { least = middle }
            }
        }
        moved.iter_mut().zip(&moves).for_each(|(moved, by)| *moved += by * part);
        let before = bearing.clone();
        for k in 0..members.len() {
            forces[k] += part * change[k];
            bearing[k] = bears(k, forces[k]);
        }
        let found = bearing == before && part >= 1.0;
        if found && slack <= 0.0 {
            break;
        }
        // What is slack holds a little until the signs are found, or of all that is slack the first alone would come back.
        slack = if is_circling && !found { SLACK } else { 0.0 };
    }
    forces
}
