//! Axial forces fitted to a shape, to begin with.
//!
//! Rigid members: the forces that leave the joints least out of balance, of these the least. With
//! elastic ones: the least complementary energy $\\sum c\\,(N - N_0)^2/2$ of forces in balance, where
//! $N_0$ is what a member bears at the length that it has in the shape; so a prestress stays what it
//! is, and what does not fit is relaxed. Both are one solve with $\\sum k\\, u u^T$, $k = 1/c$, and as many more as
//! it takes until cables pull and struts push.

use super::framework::{Framework, Link};
use super::signs::SIGN_CHANGES;
use super::state::State;
use super::stiffness::Stiffness;

/// Stiffness that stands for a rigid member, in units of the stiffest elastic one.
pub(super) const RIGID: f64 = 1e3;
/// Ridge of the least squares, in units of the stiffness.
const RIDGE: f64 = 1e-9;
/// Halvings of a step to where the dual energy is least.
const HALVINGS: usize = 40;
/// Stiffness of what is slack, over its own.
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
        let stretch = length - link.length;
        let own = stretch * along;
        (along, own)
    };
    let members: Vec<(f64, f64)> = framework.links.iter().enumerate().map(member).collect();
    let bears =
        |k: usize, force: f64| state.taut[k] && (force == 0.0 || framework.links[k].bears(force));
    let mut forces: Vec<f64> = members.iter().map(|(_, own)| *own).collect();
    let mut bearing: Vec<bool> = (0..members.len()).map(|k| bears(k, forces[k])).collect();
    for _ in 0..SIGN_CHANGES {
        // What is slack holds a little, or of all that is slack the first alone would come back.
        let along = |k: usize| members[k].0 * if bearing[k] { 1.0 } else { SLACK };
        stiffness.assemble_members(framework, |k| (directions[k].0, 0.0, along(k)));
        stiffness.shift(RIDGE * stiffest.max(rigid));
        stiffness.factorise_definite();
        let borne = |k: usize| if bearing[k] { forces[k] } else { 0.0 };
        let left =
            framework.unbalance(directions.iter().enumerate().map(|(k, (u, _))| u * borne(k)));
        let mut moves = stiffness.gather(framework, &left);
        stiffness.solve(&mut moves);
        let moves = stiffness.scatter(framework, &moves);
        let stretch = |span: usize| directions[span].0.dot(&framework.links[span].span(&moves));
        let change: Vec<f64> =
            (0..members.len()).map(|k| members[k].0 * framework.whole(k, stretch)).collect();
        // All signs at once may go round in circles: to where the dual energy, which is convex, is least on the way.
        let work: f64 = left.iter().zip(&moves).map(|(left, by)| left.dot(by)).sum();
        let slope = |part: f64| {
            let more = (0..members.len()).filter(|k| change[*k] != 0.0).map(|k| {
                let force = forces[k] + part * change[k];
                let there = if bears(k, force) { force } else { 0.0 };
                (there - borne(k)) * change[k] / members[k].0
            });
            more.sum::<f64>() - work
        };
        let (mut least, mut part) = (0.0, 1.0);
        if slope(part) > 0.0 {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (least + part);
                if slope(middle) > 0.0 { part = middle } else { least = middle }
            }
        }
        let before = bearing.clone();
        for k in 0..members.len() {
            forces[k] += part * change[k];
            bearing[k] = bears(k, forces[k]);
        }
        if bearing == before && part >= 1.0 {
            break;
        }
    }
    forces
}
